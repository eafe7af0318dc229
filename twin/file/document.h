#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "thermal/dimension.h"
#include "twin/file/value.h"

/// Small questions to a document and changes to it, for the machines that are made of other machines.
namespace thermotwin::twin {

/// The tables of a kind; none if there are none.
[[nodiscard]] std::vector<Value*> tables_of(Value& document, std::string const& kind);

/// The value, or those of the list.
[[nodiscard]] std::vector<Value const*> items_of(Value const& value);

/// The text, or the texts of the list, under a key.
[[nodiscard]] std::vector<std::string> texts_of(Value const& table, std::string const& key);

/// The name of a table; empty without one.
[[nodiscard]] std::string name_in(Value const& table);

/// Where a key stands; without it, the table.
[[nodiscard]] Location where_of(Value const& table, std::string const& key);
/// Where an item of the list under a key stands; without it, the key.
[[nodiscard]] Location where_of_item(Value const& table, std::string const& key, std::size_t item);

/// FileError at `key` where the table has `other` as well, which says the same otherwise.
void refuse_both(Value const& table, std::string const& key, std::string const& other);
/// FileError at the last of these keys that is given, where what is shared out is more than the whole.
void refuse_more_than_whole(Value const& table, std::vector<std::pair<std::string, double>> const& shares);

/// The number under a key, in SI.
[[nodiscard]] std::optional<double> number_in(Value const& table, std::string const& key, thermal::Dimension dimension);

void set_key(Value& table, std::string const& key, Value::List list);
void set_key(Value& table, std::string const& key, std::string text);
void set_key(Value& table, std::string const& key, double number);
void set_key(Value& table, std::string const& key, std::int64_t number);
void erase_key(Value& table, std::string const& key);

/// A table with these keys, as if it stood at `where`.
[[nodiscard]] Value make_table(Location const& where, std::vector<std::pair<std::string, std::string>> const& keys);
void append_table(Value& document, std::string const& kind, Value table);

/// Texts as a list of a file.
[[nodiscard]] Value::List list_of(std::vector<std::string> const& texts);

}  // namespace thermotwin::twin
