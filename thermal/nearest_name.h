#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace thermotwin::thermal {

/// Number of edits that turn one name into another: insert, delete, replace, or swap two neighbours; case is ignored.
/// (Optimal string alignment; Damerau 1964.)
int edit_distance(std::string_view a, std::string_view b);

/// The known name with the fewest edits; among equals the one whose length is nearest, then the first. Empty if none is
/// known.
std::string nearest_name(std::string_view name, std::span<std::string const> known);

/// The known name that was meant: the only one that begins so, or the nearest one if it is close; empty if there is
/// none.
std::string meant_name(std::string_view name, std::span<std::string const> known);

/// The end of an error message about an unknown name: "did you mean 'min'?" where that was meant, else "known: 'a',
/// 'b', …" (ten: those first that hold the name or whose meaning does, then the nearest), else "none is known". Beside
/// the listed ones stands what they mean, where `meaning` says it: "'GJL-250' (grey cast iron)".
std::string did_you_mean(std::string_view name, std::span<std::string const> known,
                         std::function<std::string(std::string const&)> const& meaning = {});

}  // namespace thermotwin::thermal
