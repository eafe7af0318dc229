#pragma once

#include <fmt/format.h>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "twin/file/schema.h"
#include "twin/file/value.h"

namespace thermotwin::twin {

/// A description and the table that it was read from.
template <class T>
struct Tabled {
  T description;
  Value const* table;
};

/// The tables of a document by kind, `[[bar]]` and the like; names are unique within a kind.
class Tables {
 public:
  explicit Tables(Value const& document) : document_(document) {}

  [[nodiscard]] Value const& document() const { return document_; }

  /// All tables of a kind; none if the key is absent.
  [[nodiscard]] Value::List const& of(std::string const& kind) const;

  /// All tables of a kind as descriptions with a name. To be called once per kind.
  template <class T>
  [[nodiscard]] std::vector<Tabled<T>> read(std::string const& kind) {
    std::vector<Tabled<T>> result;
    for (auto const& table : of(kind)) {
      T description;
      read_fields(table, description);
      claim(table, kind, description.name);
      result.push_back({std::move(description), &table});
    }
    return result;
  }

  /// FileError if the name is taken within the kind.
  void claim(Value const& table, std::string const& kind, std::string const& name);

 private:
  Value const& document_;
  std::set<std::pair<std::string, std::string>> names_;
};

/// The words that a message quotes.
[[nodiscard]] std::vector<std::string> quoted(std::string const& message);

/// Where in a table the text stands that a message is about: the value that holds a word it quotes, else the table.
[[nodiscard]] Location place_of(Value const& table, std::string const& message);

/// Runs what a table asks for; a complaint gets the table's place in front.
template <class Action>
void located(Value const& table, Action action) {
  try {
    action();
  } catch (FileError const&) {
    throw;
  } catch (thermal::InputError const& error) {
    throw FileError(place_of(table, error.what()), error.what());
  }
}

}  // namespace thermotwin::twin
