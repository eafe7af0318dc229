#include "twin/file/document.h"

#include "thermal/units.h"
#include "twin/file/schema.h"

namespace thermotwin::twin {
namespace {

template <class Content>
void put(Value& table, std::string const& key, Content content) {
  if (Value* value = table.find(key)) {
    value->content = std::move(content);
    return;
  }
  std::get<Value::Table>(table.content).push_back({key, table.where, Value{table.where, std::move(content)}});
}

}  // namespace

std::vector<Value*> tables_of(Value& document, std::string const& kind) {
  std::vector<Value*> tables;
  Value* list = document.find(kind);
  if (list && list->is_list())
    for (auto& table : std::get<Value::List>(list->content))
      if (table.is_table()) tables.push_back(&table);
  return tables;
}

std::vector<Value const*> items_of(Value const& value) {
  if (!value.is_list()) return {&value};
  std::vector<Value const*> items;
  for (auto const& item : std::get<Value::List>(value.content)) items.push_back(&item);
  return items;
}

std::vector<std::string> texts_of(Value const& table, std::string const& key) {
  Value const* value = table.find(key);
  if (!value) return {};
  if (value->is_text()) return {std::get<std::string>(value->content)};
  std::vector<std::string> texts;
  if (value->is_list())
    for (auto const& item : std::get<Value::List>(value->content))
      if (item.is_text()) texts.push_back(std::get<std::string>(item.content));
  return texts;
}

std::string name_in(Value const& table) {
  auto const names = texts_of(table, "name");
  return names.empty() ? "" : names[0];
}

Location where_of(Value const& table, std::string const& key) {
  Value const* value = table.find(key);
  return value ? value->where : table.where;
}

Location where_of_item(Value const& table, std::string const& key, std::size_t item) {
  Value const* value = table.find(key);
  auto const* list = value && value->is_list() ? &std::get<Value::List>(value->content) : nullptr;
  return list && item < list->size() ? (*list)[item].where : where_of(table, key);
}

void refuse_both(Value const& table, std::string const& key, std::string const& other) {
  if (table.find(key) && table.find(other))
    throw FileError(where_of(table, key), fmt::format("give either '{}' or '{}', not both", other, key));
}

void refuse_more_than_whole(Value const& table, std::vector<std::pair<std::string, double>> const& shares) {
  double sum = 0.0;
  std::vector<std::string> terms;
  Location where = table.where;
  for (auto const& [key, share] : shares) {
    sum += share;
    terms.push_back(fmt::format("'{}' {:g}", key, share));
    if (table.find(key)) where = where_of(table, key);
  }
  if (sum > 1.0 + slack_of_limit)
    throw FileError(where, fmt::format("{} are {:g} of the heat; allowed is 1 in all", fmt::join(terms, " and "), sum));
}

std::optional<double> number_in(Value const& table, std::string const& key, thermal::Dimension dimension) {
  Value const* value = table.find(key);
  if (!value) return {};
  if (value->is_text()) return thermal::parse_value(std::get<std::string>(value->content), dimension);
  if (auto const* real = std::get_if<double>(&value->content)) return *real;
  if (auto const* whole = std::get_if<std::int64_t>(&value->content)) return double(*whole);
  return {};
}

void set_key(Value& table, std::string const& key, Value::List list) { put(table, key, std::move(list)); }
void set_key(Value& table, std::string const& key, std::string text) { put(table, key, std::move(text)); }
void set_key(Value& table, std::string const& key, double number) { put(table, key, number); }
void set_key(Value& table, std::string const& key, std::int64_t number) { put(table, key, number); }

void erase_key(Value& table, std::string const& key) {
  std::erase_if(std::get<Value::Table>(table.content), [&](auto const& entry) { return entry.key == key; });
}

Value make_table(Location const& where, std::vector<std::pair<std::string, std::string>> const& keys) {
  Value table{where, Value::Table{}};
  for (auto const& [key, text] : keys) set_key(table, key, text);
  return table;
}

void append_table(Value& document, std::string const& kind, Value table) {
  if (!document.find(kind)) set_key(document, kind, Value::List{});
  std::get<Value::List>(document.find(kind)->content).push_back(std::move(table));
}

Value::List list_of(std::vector<std::string> const& texts) {
  Value::List list;
  for (auto const& text : texts) list.push_back(Value{{}, text});
  return list;
}

}  // namespace thermotwin::twin
