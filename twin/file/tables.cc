#include "twin/file/tables.h"

#include <algorithm>

#include "twin/file/document.h"

namespace thermotwin::twin {

std::vector<std::string> quoted(std::string const& message) {
  std::vector<std::string> words;
  for (std::size_t open = message.find('\''); open != std::string::npos;) {
    auto const close = message.find('\'', open + 1);
    if (close == std::string::npos) break;
    words.push_back(message.substr(open + 1, close - open - 1));
    open = message.find('\'', close + 1);
  }
  return words;
}

Location place_of(Value const& table, std::string const& message) {
  auto const words = quoted(message);
  auto const mentioned = [&](Value const& value) {
    if (!value.is_text()) return false;
    auto const& text = std::get<std::string>(value.content);
    return std::any_of(words.begin(), words.end(), [&](auto const& word) {
      return text == word || text.starts_with(word + "[") || text.starts_with(word + ".");
    });
  };
  for (auto const& entry : std::get<Value::Table>(table.content)) {
    if (entry.key == "name" || entry.key == "title" || entry.key == "component") continue;
    if (mentioned(entry.value)) return entry.value.where;
    if (entry.value.is_list())
      for (auto const& item : std::get<Value::List>(entry.value.content)) {
        if (mentioned(item)) return item.where;
        if (item.is_table())
          if (auto const inner = place_of(item, message);
              inner.line != item.where.line || inner.column != item.where.column)
            return inner;
      }
  }
  return table.where;
}

Value::List const& Tables::of(std::string const& kind) const {
  static Value::List const none;
  Value const* value = document_.find(kind);
  if (!value) return none;
  if (!value->is_list())
    throw FileError(value->where, fmt::format("'{}' is {}; write each one as [[{}]]", kind, value->kind(), kind));
  auto const& list = std::get<Value::List>(value->content);
  for (auto const& table : list)
    if (!table.is_table()) throw FileError(table.where, fmt::format("write each one as [[{}]]", kind));
  return list;
}

void Tables::claim(Value const& table, std::string const& kind, std::string const& name) {
  if (names_.insert({kind, name}).second) return;
  throw FileError(where_of(table, "name"), fmt::format("the name '{}' is taken by another [[{}]]", name, kind));
}

}  // namespace thermotwin::twin
