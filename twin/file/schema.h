#pragma once

#include <Eigen/Core>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "thermal/machine_temperature.h"
#include "thermal/nearest_name.h"
#include "thermal/units.h"
#include "twin/file/value.h"

/// The schema of a file is the struct that it fills. A struct lists its fields once,
///
///   template <class Fields> static void fields(Fields& f) {
///     f("conductance", &FanCooling::conductance, dimension::conductance, "at full speed", Range{0.2, 5.0});
///   }
///
/// and that list serves the reading (FieldReader), the documentation (FieldLister) and the check of every key.
/// A number or vector whose default is NaN, and a text listed by `name`, must be given.
namespace thermotwin::twin {

/// What is plausible for a number, in SI; where `low` ≥ 0, a negative value is an error.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool without_zero = false;                              ///< and so is 0: others are divided by the number
  double most = std::numeric_limits<double>::infinity();  ///< more is an error: no efficiency is above 1

  [[nodiscard]] constexpr Range above_zero() const { return {low, high, true, most}; }
  [[nodiscard]] constexpr Range up_to(double limit) const { return {low, high, without_zero, limit}; }
};

/// Of what is allowed at most, by how much more is let pass: the step of a derivative, the last digit of a share.
inline constexpr double slack_of_limit = 5e-3;

/// Of a room, a coolant, a machine.
inline constexpr Range plausible_temperature{thermal::coldest_machine, thermal::hottest_machine};

/// One field as the documentation shows it.
struct FieldRecord {
  std::string key;
  std::string kind;     ///< "conductance [W/K]", "text", "list of block", …
  std::string initial;  ///< default as text; "required" if there is none
  std::string range;    ///< plausible range as text, or empty
  std::string description;
  std::vector<FieldRecord> nested;
  thermal::Dimension dimension;
  Range plausible;

  /// A point on the temperature scale, not a difference.
  [[nodiscard]] bool is_temperature() const { return kind.starts_with("temperature [degC]"); }
};

template <class T>
concept HasFields = requires {
  &T::template fields<struct AnyFields>;
}
|| requires(struct AnyFields& f) { T::fields(f); };

template <class T>
std::vector<FieldRecord> list_fields();

template <class T>
void read_fields(Value const& table, T& object);

/// Fills one object from one table.
template <class T>
class FieldReader {
 public:
  FieldReader(Value const& table, T& object) : table_(table), object_(object) {}

  template <class M>
  void operator()(std::string_view key, double M::*member, thermal::Dimension dimension, std::string_view,
                  Range range = {}) {
    if (Value const* value = take(key))
      object_.*member = number(*value, key, dimension, range);
    else if (std::isnan(object_.*member))
      missing(key, in_quotes(thermal::example_of(dimension)));
  }
  template <class M>
  void operator()(std::string_view key, std::optional<double> M::*member, thermal::Dimension dimension,
                  std::string_view, Range range = {}) {
    if (Value const* value = take(key)) object_.*member = number(*value, key, dimension, range);
  }
  template <class M>
  void operator()(std::string_view key, std::vector<double> M::*member, thermal::Dimension dimension, std::string_view,
                  Range range = {}) {
    Value const* value = take(key);
    if (!value) return;
    (object_.*member).clear();
    for (auto const& item : list(*value, key)) (object_.*member).push_back(number(item, key, dimension, range));
  }
  template <class M>
  void operator()(std::string_view key, Eigen::Vector3d M::*member, thermal::Dimension dimension, std::string_view) {
    Value const* value = take(key);
    if (!value && (object_.*member).hasNaN())
      missing(key, fmt::format("[{0}, {0}, {0}]", in_quotes(thermal::example_of(dimension))));
    if (!value) return;
    auto const& items = list(*value, key);
    if (items.size() != 3)
      throw FileError(value->where, fmt::format("'{}' has {} entries; three are due", key, items.size()));
    for (int i = 0; i < 3; ++i) (object_.*member)[i] = number(items[std::size_t(i)], key, dimension, {});
  }
  template <class M>
  void operator()(std::string_view key, std::optional<Eigen::Vector3d> M::*member, thermal::Dimension dimension,
                  std::string_view) {
    Value const* value = take(key);
    if (!value) return;
    auto const& items = list(*value, key);
    if (items.size() != 3)
      throw FileError(value->where, fmt::format("'{}' has {} entries; three are due", key, items.size()));
    object_.*member = Eigen::Vector3d::Zero();
    for (int i = 0; i < 3; ++i) (*(object_.*member))[i] = number(items[std::size_t(i)], key, dimension, {});
  }
  template <class M>
  void operator()(std::string_view key, std::string M::*member, std::string_view) {
    if (Value const* value = take(key)) object_.*member = text(*value, key);
  }
  template <class M>
  void operator()(std::string_view key, std::vector<std::string> M::*member, std::string_view) {
    Value const* value = take(key);
    if (!value) return;
    (object_.*member).clear();
    if (value->is_text())
      (object_.*member).push_back(text(*value, key));
    else
      for (auto const& item : list(*value, key)) (object_.*member).push_back(text(item, key));
  }
  template <class M>
  void operator()(std::string_view key, bool M::*member, std::string_view) {
    Value const* value = take(key);
    if (!value) return;
    if (!std::holds_alternative<bool>(value->content)) wrong(*value, key, "true or false");
    object_.*member = std::get<bool>(value->content);
  }
  template <class M>
  void operator()(std::string_view key, std::optional<bool> M::*member, std::string_view) {
    Value const* value = take(key);
    if (!value) return;
    if (!std::holds_alternative<bool>(value->content)) wrong(*value, key, "true or false");
    object_.*member = std::get<bool>(value->content);
  }
  template <class M, std::integral I>
  requires(!std::same_as<I, bool>) void operator()(std::string_view key, I M::*member, std::string_view,
                                                   Range range = {}) {
    Value const* value = take(key);
    if (!value) return;
    if (!std::holds_alternative<std::int64_t>(value->content)) wrong(*value, key, "a whole number without unit");
    auto const given = std::get<std::int64_t>(value->content);
    double const low = std::max(range.low, double(std::numeric_limits<I>::min()));
    double const high = std::min(range.high, double(std::numeric_limits<I>::max()));
    if (double(given) < low || double(given) > high)
      throw FileError(value->where, fmt::format("'{}' is {}; allowed is {:g} to {:g}", key, given, low, high));
    object_.*member = I(given);
  }
  template <class M, class Nested>
  requires HasFields<Nested>
  void operator()(std::string_view key, Nested M::*member, std::string_view) {
    if (Value const* value = take(key)) read_fields(as_table(*value, key), object_.*member);
  }
  template <class M, class Nested>
  requires HasFields<Nested>
  void operator()(std::string_view key, std::optional<Nested> M::*member, std::string_view) {
    if (Value const* value = take(key)) read_fields(as_table(*value, key), (object_.*member).emplace());
  }
  template <class M, class Nested>
  requires HasFields<Nested>
  void operator()(std::string_view key, std::vector<Nested> M::*member, std::string_view) {
    Value const* value = take(key);
    if (!value) return;
    (object_.*member).clear();
    for (auto const& item : list(*value, key)) read_fields(as_table(item, key), (object_.*member).emplace_back());
  }

  /// A text that must be given: a name, a place.
  template <class M>
  void name(std::string_view key, std::string M::*member, std::string_view) {
    if (Value const* value = take(key))
      object_.*member = text(*value, key);
    else
      missing(key, in_quotes("name"));
  }
  /// A point on the temperature scale.
  template <class M>
  void temperature(std::string_view key, double M::*member, std::string_view, Range = {}) {
    if (Value const* value = take(key))
      object_.*member = absolute(*value, key);
    else if (std::isnan(object_.*member))
      missing(key, in_quotes("22 degC"));
  }
  template <class M>
  void temperature(std::string_view key, std::optional<double> M::*member, std::string_view, Range = {}) {
    if (Value const* value = take(key)) object_.*member = absolute(*value, key);
  }
  /// One of a few words.
  template <class M>
  void choice(std::string_view key, std::string M::*member, std::vector<std::string> const& allowed, std::string_view) {
    Value const* value = take(key);
    if (!value) return;
    auto const given = text(*value, key);
    if (std::find(allowed.begin(), allowed.end(), given) == allowed.end())
      throw FileError(value->where, fmt::format("'{}' is '{}'; {}", key, given, thermal::did_you_mean(given, allowed)));
    object_.*member = given;
  }

  /// Every key of the table must have been listed.
  void finish() const {
    for (auto const& entry : std::get<Value::Table>(table_.content))
      if (std::find(known_.begin(), known_.end(), entry.key) == known_.end())
        throw FileError(entry.where,
                        fmt::format("unknown key '{}'; {}", entry.key, thermal::did_you_mean(entry.key, known_)));
    if (!missing_.empty()) throw FileError(table_.where, missing_);
  }

 private:
  Value const* take(std::string_view key) {
    known_.emplace_back(key);
    return table_.find(key);
  }
  /// Told at the end, after the unknown keys: a misspelt key is both, and the misspelling is what helps.
  void missing(std::string_view key, std::string_view example) {
    if (missing_.empty()) missing_ = fmt::format("'{}' is missing; write for example {} = {}", key, key, example);
  }
  [[noreturn]] static void wrong(Value const& value, std::string_view key, std::string_view due) {
    throw FileError(value.where, fmt::format("'{}' is {} ({}); {} is due", key, value.text(), value.kind(), due));
  }
  static Value::List const& list(Value const& value, std::string_view key) {
    if (!value.is_list()) wrong(value, key, "a list");
    return std::get<Value::List>(value.content);
  }
  static Value const& as_table(Value const& value, std::string_view key) {
    if (!value.is_table()) wrong(value, key, "a table");
    return value;
  }
  static std::string text(Value const& value, std::string_view key) {
    if (!value.is_text()) wrong(value, key, "a text");
    return std::get<std::string>(value.content);
  }
  /// Runs a parser of thermal/units.h and puts the place in front of its complaint.
  template <class Parse>
  static double located(Value const& value, std::string_view key, Parse parse) {
    try {
      return parse();
    } catch (thermal::InputError const& error) {
      throw FileError(value.where, fmt::format("'{}': {}", key, error.what()));
    }
  }
  static double absolute(Value const& value, std::string_view key) {
    if (!value.is_text()) wrong(value, key, "a temperature, for example \"22 degC\",");
    return located(value, key, [&] { return thermal::parse_temperature(std::get<std::string>(value.content)); });
  }
  static double number(Value const& value, std::string_view key, thermal::Dimension dimension, Range range) {
    double result = 0.0;
    if (value.is_text())
      result =
          located(value, key, [&] { return thermal::parse_value(std::get<std::string>(value.content), dimension); });
    else if (double const* x = std::get_if<double>(&value.content))
      result = *x;
    else if (std::int64_t const* i = std::get_if<std::int64_t>(&value.content))
      result = double(*i);
    else
      wrong(value, key, "a quantity, for example \"" + thermal::example_of(dimension) + "\",");
    if (!std::isfinite(result))
      throw FileError(value.where, fmt::format("'{}' is {}; it must be finite", key, value.text()));
    if (!value.is_text() && !(dimension == thermal::dimension::dimensionless))
      throw FileError(value.where, fmt::format("'{}': {}", key, thermal::missing_unit(value.text(), dimension)));
    auto const refuse = [&](std::string_view what) {
      throw FileError(value.where, fmt::format("'{}' is {}; it must {} (plausible: {})", key, value.text(), what,
                                               range_text(range, dimension)));
    };
    if (range.low >= 0.0 && (result < 0.0 || (range.without_zero && result == 0.0)))
      refuse(range.without_zero ? "be positive" : "not be negative");
    if (result > range.most * (1.0 + slack_of_limit))
      refuse("be at most " + thermal::format_quantity(range.most, dimension));
    return result;
  }

 public:
  static std::string in_quotes(std::string_view text) { return fmt::format("\"{}\"", text); }
  static std::string range_text(Range range, thermal::Dimension dimension) {
    auto const side = [&](double x) { return thermal::format_quantity(x, dimension); };
    std::string const above = range.without_zero && range.low == 0.0 ? "above " : "";
    if (std::isfinite(range.low) && std::isfinite(range.high))
      return above + side(range.low) + " to " + side(range.high);
    if (std::isfinite(range.low)) return (above.empty() ? "from " : above) + side(range.low);
    return std::isfinite(range.high) ? "up to " + side(range.high) : "any";
  }

 private:
  Value const& table_;
  T& object_;
  std::vector<std::string> known_;
  std::string missing_;
};

/// Lists the fields of a struct, with the defaults of a default-constructed object.
template <class T>
class FieldLister {
 public:
  std::vector<FieldRecord> records;

  template <class M>
  void operator()(std::string_view key, double M::*member, thermal::Dimension d, std::string_view doc, Range r = {}) {
    double const x = object_.*member;
    quantity(key, std::isnan(x) ? "required" : thermal::format_quantity(x, d), d, doc, r);
  }
  template <class M>
  void operator()(std::string_view key, std::optional<double> M::*, thermal::Dimension d, std::string_view doc,
                  Range r = {}) {
    quantity(key, "", d, doc, r);
  }
  template <class M>
  void operator()(std::string_view key, std::vector<double> M::*member, thermal::Dimension d, std::string_view doc,
                  Range r = {}) {
    quantity(key, written(object_.*member, d), d, doc, r);
    records.back().kind = "list of " + records.back().kind;
  }
  template <class M>
  void operator()(std::string_view key, Eigen::Vector3d M::*member, thermal::Dimension d, std::string_view doc) {
    Eigen::Vector3d const& x = object_.*member;
    quantity(key, x.hasNaN() ? "required" : written({x[0], x[1], x[2]}, d), d, doc, {});
    records.back().kind = "three times " + records.back().kind;
  }
  template <class M>
  void operator()(std::string_view key, std::optional<Eigen::Vector3d> M::*, thermal::Dimension d,
                  std::string_view doc) {
    quantity(key, "", d, doc, {});
    records.back().kind = "three times " + records.back().kind;
  }
  template <class M>
  void operator()(std::string_view key, std::string M::*member, std::string_view doc) {
    add(key, "text", fmt::format("\"{}\"", object_.*member), doc);
  }
  template <class M>
  void operator()(std::string_view key, std::vector<std::string> M::*member, std::string_view doc) {
    add(key, "list of text", written(object_.*member), doc);
  }
  template <class M>
  void operator()(std::string_view key, bool M::*member, std::string_view doc) {
    add(key, "true or false", object_.*member ? "true" : "false", doc);
  }
  template <class M>
  void operator()(std::string_view key, std::optional<bool> M::*, std::string_view doc) {
    add(key, "true or false", "", doc);
  }
  template <class M, std::integral I>
  requires(!std::same_as<I, bool>) void operator()(std::string_view key, I M::*member, std::string_view doc,
                                                   Range r = {}) {
    add(key, "whole number", fmt::format("{}", object_.*member), doc);
    if (std::isfinite(r.low)) records.back().range = FieldReader<T>::range_text(r, thermal::dimension::dimensionless);
    records.back().plausible = r;
  }
  template <class M, class Nested>
  requires HasFields<Nested>
  void operator()(std::string_view key, Nested M::*, std::string_view doc) { nested<Nested>(key, "table", doc); }
  template <class M, class Nested>
  requires HasFields<Nested>
  void operator()(std::string_view key, std::optional<Nested> M::*, std::string_view doc) {
    nested<Nested>(key, "table, may be absent", doc);
  }
  template <class M, class Nested>
  requires HasFields<Nested>
  void operator()(std::string_view key, std::vector<Nested> M::*, std::string_view doc) {
    nested<Nested>(key, "list of tables", doc);
  }
  template <class M>
  void name(std::string_view key, std::string M::*, std::string_view doc) {
    add(key, "text", "required", doc);
  }
  template <class M>
  void temperature(std::string_view key, double M::*member, std::string_view doc, Range r = plausible_temperature) {
    double const x = object_.*member;
    on_scale(key, std::isnan(x) ? "required" : thermal::format_temperature(x), doc, r);
  }
  template <class M>
  void temperature(std::string_view key, std::optional<double> M::*, std::string_view doc,
                   Range r = plausible_temperature) {
    on_scale(key, "", doc, r);
  }
  template <class M>
  void choice(std::string_view key, std::string M::*member, std::vector<std::string> const& allowed,
              std::string_view doc) {
    add(key, fmt::format("one of {}", fmt::join(allowed, ", ")), fmt::format("\"{}\"", object_.*member), doc);
  }

 private:
  /// A list as it stands in a file.
  static std::string written(std::vector<std::string> texts) {
    for (auto& text : texts) text = FieldReader<T>::in_quotes(text);
    return fmt::format("[{}]", fmt::join(texts, ", "));
  }
  static std::string written(std::vector<double> const& numbers, thermal::Dimension d) {
    std::vector<std::string> texts;
    for (double const x : numbers) texts.push_back(thermal::format_quantity(x, d));
    return d == thermal::dimension::dimensionless ? fmt::format("[{}]", fmt::join(texts, ", ")) : written(texts);
  }
  void add(std::string_view key, std::string kind, std::string initial, std::string_view doc) {
    records.push_back({std::string(key), std::move(kind), std::move(initial), "", std::string(doc), {}, {}, {}});
  }
  void quantity(std::string_view key, std::string initial, thermal::Dimension d, std::string_view doc, Range r) {
    bool const plain = d == thermal::dimension::dimensionless;
    add(key, plain ? "number" : fmt::format("{} [{}]", thermal::name_of(d), thermal::unit_of(d)), std::move(initial),
        doc);
    bool const bounded = std::isfinite(r.low) || std::isfinite(r.high);
    if (bounded) records.back().range = FieldReader<T>::range_text(r, d);
    records.back().dimension = d;
    records.back().plausible = r;
  }
  void on_scale(std::string_view key, std::string initial, std::string_view doc, Range r) {
    add(key, "temperature [degC]", std::move(initial), doc);
    records.back().range =
        fmt::format("{:g} degC to {:g} degC", r.low - thermal::zero_celsius, r.high - thermal::zero_celsius);
    records.back().plausible = r;
  }
  template <class Nested>
  void nested(std::string_view key, std::string kind, std::string_view doc) {
    add(key, std::move(kind), "", doc);
    records.back().nested = list_fields<Nested>();
  }

  T object_{};
};

template <class T>
std::vector<FieldRecord> list_fields() {
  FieldLister<T> lister;
  T::fields(lister);
  return std::move(lister.records);
}

template <class T>
void read_fields(Value const& table, T& object) {
  if (!table.is_table()) throw FileError(table.where, "here one table is due, as [name] begins it, not a list");
  FieldReader<T> reader(table, object);
  T::fields(reader);
  reader.finish();
}

}  // namespace thermotwin::twin
