#include "twin/file/value.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>

#include "thermal/nearest_name.h"
#include "thermal/units.h"

namespace thermotwin::twin {
namespace {

std::string name_of(Value const& table) {
  Value const* name = table.find("name");
  return name && name->is_text() ? std::get<std::string>(name->content) : std::string();
}

/// "2" for the third entry of a list of tables without names.
std::optional<std::size_t> index_in(Value::List const& list, std::string const& text) {
  std::size_t index = 0;
  auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
  if (error != std::errc{} || end != text.data() + text.size() || index >= list.size()) return std::nullopt;
  return list[index].is_table() ? std::optional(index) : std::nullopt;
}

std::vector<std::string> split(std::string_view path) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= path.size(); ++i)
    if (i == path.size() || path[i] == '.') {
      parts.emplace_back(path.substr(begin, i - begin));
      begin = i + 1;
    }
  return parts;
}

/// "blocks.0" of "blocks[0]", as messages call a table; any other part as it is.
std::string with_dot(std::string const& part) {
  auto const open = part.find('[');
  if (open == std::string::npos || part.back() != ']' || open + 2 >= part.size()) return part;
  auto const index = part.substr(open + 1, part.size() - open - 2);
  return index.find_first_not_of("0123456789") == std::string::npos ? part.substr(0, open) + "." + index : part;
}

/// The table that the parts from `first` on name, all but the last, and how many of them make up its name, which may
/// itself contain dots: as many as possible.
std::pair<Value*, std::size_t> named_table(Value::List& list, std::vector<std::string> const& parts,
                                           std::size_t first) {
  for (std::size_t count = parts.size() - 1 - first; count > 0; --count) {
    auto const begin = parts.begin() + std::ptrdiff_t(first);
    std::string const name = fmt::format("{}", fmt::join(begin, begin + std::ptrdiff_t(count), "."));
    for (auto& table : list)
      if (table.is_table() && name_of(table) == name) return {&table, count};
  }
  return {nullptr, 0};
}

constexpr double most_whole = 0x1p53;  ///< up to which a double counts

/// What a text on the command line means: true, false, a number, or text (a quantity, a name).
decltype(Value::content) interpret(std::string const& text) {
  if (text == "true" || text == "false") return text == "true";
  char* end = nullptr;
  double const number = std::strtod(text.c_str(), &end);
  if (!text.empty() && *end == '\0') {
    bool const whole = text.find_first_not_of("+-0123456789") == std::string::npos;
    if (whole && std::abs(number) < most_whole) return std::int64_t(number);
    return number;
  }
  return text;
}

}  // namespace

std::string Location::text() const { return fmt::format("{}:{}:{}", file, line, column); }

FileError::FileError(Location const& where, std::string_view what)
    : InputError(where.line > 0 ? fmt::format("{}: {}", where.text(), what) : fmt::format("{}: {}", where.file, what)) {
}

Value const* Value::find(std::string_view key) const {
  for (auto const& entry : std::get<Table>(content))
    if (entry.key == key) return &entry.value;
  return nullptr;
}

Value* Value::find(std::string_view key) { return const_cast<Value*>(std::as_const(*this).find(key)); }

std::vector<std::string> Value::keys() const {
  std::vector<std::string> keys;
  for (auto const& entry : std::get<Table>(content)) keys.push_back(entry.key);
  return keys;
}

std::string Value::kind() const {
  constexpr std::string_view kinds[] = {"a text", "a number", "a whole number", "true or false", "a list", "a table"};
  return std::string(kinds[content.index()]);
}

std::string Value::text() const {
  struct Visitor {
    std::string operator()(std::string const& s) const { return fmt::format("\"{}\"", s); }
    std::string operator()(double x) const { return thermal::format_number(x); }
    std::string operator()(std::int64_t i) const { return fmt::format("{}", i); }
    std::string operator()(bool b) const { return b ? "true" : "false"; }
    std::string operator()(List const& list) const {
      std::string text = "[";
      for (auto const& value : list) text += (text.size() > 1 ? ", " : "") + value.text();
      return text + "]";
    }
    std::string operator()(Table const& table) const {
      std::string text = "{";
      for (auto const& [key, where, value] : table)
        text += fmt::format("{} {} = {}", text.size() > 1 ? "," : "", key, value.text());
      return text + " }";
    }
  };
  return std::visit(Visitor{}, content);
}

std::pair<Value*, std::string> find_parameter(Value& document, std::string_view path, std::string_view prefix) {
  auto const parts = split(path);
  auto const fail = [&](std::string const& what, std::vector<std::string> const& known, std::string const& name) {
    throw thermal::InputError(
        fmt::format("parameter '{}{}': {}; {}", prefix, path, what, thermal::did_you_mean(name, known)));
  };
  Value* here = &document;
  std::size_t next = 0;
  for (; next + 1 < parts.size(); ++next) {
    Value* found = here->find(parts[next]);
    auto const dotted = with_dot(parts[next]);
    if (!found && dotted != parts[next] && here->find(dotted.substr(0, dotted.find('.')))) {
      std::vector<std::string> all(parts.size());
      std::transform(parts.begin(), parts.end(), all.begin(), with_dot);
      throw thermal::InputError(fmt::format("parameter '{0}{1}': there is no '{2}'; did you mean '{0}{3}'?", prefix,
                                            path, parts[next], fmt::join(all, ".")));
    }
    if (!found) fail(fmt::format("there is no '{}'", parts[next]), here->keys(), parts[next]);
    if (found->is_list()) {
      auto& list = std::get<Value::List>(found->content);
      if (next + 2 >= parts.size()) fail("the path ends before a key", {}, "");
      auto const [table, parts_of_name] = named_table(list, parts, next + 1);
      if (!table) {
        auto const& name = parts[++next];
        if (auto const index = index_in(list, name)) {
          here = &list[*index];
          continue;
        }
        std::vector<std::string> names;
        for (auto const& v : list)
          if (v.is_table()) names.push_back(name_of(v));
        std::size_t const tables = names.size();
        if (std::erase(names, "") == tables)
          throw thermal::InputError(
              fmt::format("parameter '{}{}': there is no table '{}' in '{}'; it has {}, counted from 0", prefix, path,
                          name, parts[next - 1], tables));
        fail(fmt::format("there is no {} named '{}'", parts[next - 1], name), names, name);
      }
      found = table;
      next += parts_of_name;
    }
    if (!found->is_table()) fail(fmt::format("'{}' is {}, not a table", parts[next], found->kind()), {}, "");
    here = found;
  }
  return {here, parts.back()};
}

void set_parameter(Value& document, std::string_view path, std::string const& text, std::string_view prefix) {
  auto const [table, key] = find_parameter(document, path, prefix);
  Location const where{fmt::format("parameter {}{}", prefix, path), 0, 0};
  if (Value* value = table->find(key)) {
    *value = {where, interpret(text)};
    return;
  }
  std::get<Value::Table>(table->content).push_back({key, where, {where, interpret(text)}});
}

}  // namespace thermotwin::twin
