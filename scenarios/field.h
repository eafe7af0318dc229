#pragma once

#include <limits>

namespace thermotwin::scenarios {

/// Every struct of an experiment lists its fields once, in a static member template `fields`, for whoever reads or
/// describes it; `doc` is one line for people, the members' initial values are the defaults:
///
///     f("key", &S::member, dimension, "doc")          double, std::optional<double>
///     f("key", &S::member, dimension, "doc", {a, b})  the same with a plausible range; a ≥ 0 forbids negative values
///     f.temperature("key", &S::member, "doc")         double, std::optional<double>: a point on the scale [K]
///     f.temperature("key", &S::member, "doc", {a, b}) the same with a range of its own
///     f.name("key", &S::member, "doc")                std::string that must be given
///     f.choice("key", &S::member, {"x", "y"}, "doc")  std::string, one of the words
///     f("key", &S::member, "doc", {a, b})             int, no less and no more
///     f("key", &S::member, "doc")                     std::string, bool, int, a struct with fields,
///                                                     std::optional<struct>, std::vector<struct>
///
/// A double whose initial value is `required` must be given.
inline constexpr double required = std::numeric_limits<double>::quiet_NaN();

/// Upper end of a range that has none.
inline constexpr double unbounded = std::numeric_limits<double>::infinity();

}  // namespace thermotwin::scenarios
