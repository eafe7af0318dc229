// The only file that knows toml++.
#include <algorithm>
#include <toml++/toml.h>

#include "scenarios/csv.h"
#include "twin/file/text_file.h"
#include "twin/file/value.h"

namespace thermotwin::twin {
namespace {

Location location(toml::source_region const& source, std::string const& file) {
  return {file, int(source.begin.line), int(source.begin.column)};
}

Value convert(toml::node const& node, std::string const& file);

Value::Table convert_table(toml::table const& table, std::string const& file) {
  Value::Table entries;
  for (auto const& [key, node] : table)
    entries.push_back({std::string(key.str()), location(key.source(), file), convert(node, file)});
  auto const before = [](Value::Entry const& a, Value::Entry const& b) {
    return std::pair(a.where.line, a.where.column) < std::pair(b.where.line, b.where.column);
  };
  std::stable_sort(entries.begin(), entries.end(), before);
  return entries;
}

Value convert(toml::node const& node, std::string const& file) {
  Value value;
  value.where = location(node.source(), file);
  switch (node.type()) {
    case toml::node_type::table:
      value.content = convert_table(*node.as_table(), file);
      break;
    case toml::node_type::array: {
      Value::List list;
      for (auto const& element : *node.as_array()) list.push_back(convert(element, file));
      value.content = std::move(list);
      break;
    }
    case toml::node_type::string:
      value.content = node.as_string()->get();
      break;
    case toml::node_type::integer:
      value.content = std::int64_t(node.as_integer()->get());
      break;
    case toml::node_type::floating_point:
      value.content = node.as_floating_point()->get();
      break;
    case toml::node_type::boolean:
      value.content = node.as_boolean()->get();
      break;
    default:
      throw FileError(value.where, "dates and times are not used here; write a duration with its unit, \"30 min\"");
  }
  return value;
}

}  // namespace

Value parse_toml(std::string_view text, std::string const& file_name) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    throw FileError({file_name, 0, 0}, "is written in UTF-16; UTF-8 is due");
  try {
    toml::table const table = toml::parse(text, file_name);
    return {{file_name, 1, 1}, convert_table(table, file_name)};
  } catch (toml::parse_error const& error) {
    std::string what(error.description());
    if (what.find("utf-8") != std::string::npos)
      what = "is not written in UTF-8; " + scenarios::conversion_to_utf8(file_name);
    if (what.find("control characters") != std::string::npos) what += "; is a quote missing at the end of the line?";
    if (what.find("parsing boolean") != std::string::npos || what.find("determine value type") != std::string::npos)
      what += "; a text needs straight quotes, for example \"bed\"; a flag is true or false";
    throw FileError(location(error.source(), file_name), what);
  }
}

Value read_toml(std::filesystem::path const& path) {
  std::string const text = text_of_file(path);
  Location const where{path.string(), 0, 0};
  if (text.empty()) throw FileError(where, "the file is empty");
  if (text.starts_with("\x89HDF"))
    throw FileError(where, "is a data set (HDF5); a machine, experiment or other text file (TOML) is due");
  return parse_toml(text, path.string());
}

}  // namespace thermotwin::twin
