#include "thermal/nearest_name.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <utility>
#include <vector>

namespace thermotwin::thermal {
namespace {

constexpr std::size_t listed_at_most = 10;
constexpr std::size_t shortest_part = 3;  ///< of a name that somebody cut short; less is in too much by chance

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

std::pair<int, int> remoteness(std::string_view name, std::string const& other) {
  return {edit_distance(name, other), std::abs(static_cast<int>(name.size()) - static_cast<int>(other.size()))};
}

bool holds(std::string_view text, std::string_view word) {
  auto const same = [](char a, char b) { return lower(a) == lower(b); };
  return std::search(text.begin(), text.end(), word.begin(), word.end(), same) != text.end();
}

/// Those first that hold the name, or whose meaning does: 'axial_cells' for 'cells', '42CrMo4' for 'steel'.
std::vector<std::string> nearest_first(std::string_view name, std::span<std::string const> known,
                                       std::function<std::string(std::string const&)> const& meaning) {
  auto const is_without = [&](std::string const& other) {
    return name.size() < shortest_part || !(holds(other, name) || (meaning && holds(meaning(other), name)));
  };
  std::vector<std::string> names(known.begin(), known.end());
  std::stable_sort(names.begin(), names.end(), [&](std::string const& a, std::string const& b) {
    return std::pair(is_without(a), remoteness(name, a)) < std::pair(is_without(b), remoteness(name, b));
  });
  return names;
}

/// The only name that begins like this, if it is not twice as long; empty if there is none, or more.
std::string whole_name(std::string_view beginning, std::span<std::string const> known) {
  if (beginning.size() < shortest_part) return {};
  auto const begins = [&](std::string const& name) { return name.starts_with(beginning); };
  auto const first = std::find_if(known.begin(), known.end(), begins);
  if (first == known.end() || std::find_if(first + 1, known.end(), begins) != known.end()) return {};
  return first->size() < 2 * beginning.size() ? *first : std::string();
}

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<int>> edits(a.size() + 1, std::vector<int>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) edits[i][0] = static_cast<int>(i);
  for (std::size_t j = 0; j <= b.size(); ++j) edits[0][j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      int const replace = edits[i - 1][j - 1] + (lower(a[i - 1]) == lower(b[j - 1]) ? 0 : 1);
      edits[i][j] = std::min({edits[i - 1][j] + 1, edits[i][j - 1] + 1, replace});
      bool const swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) edits[i][j] = std::min(edits[i][j], edits[i - 2][j - 2] + 1);
    }
  }
  return edits[a.size()][b.size()];
}

std::string nearest_name(std::string_view name, std::span<std::string const> known) {
  auto const nearest = std::min_element(known.begin(), known.end(), [&](std::string const& a, std::string const& b) {
    return remoteness(name, a) < remoteness(name, b);
  });
  return nearest == known.end() ? std::string() : *nearest;
}

std::string meant_name(std::string_view name, std::span<std::string const> known) {
  if (known.empty()) return {};
  if (std::string whole = whole_name(name, known); !whole.empty()) return whole;
  std::string nearest = nearest_name(name, known);
  int const size = static_cast<int>(name.size()), edits = edit_distance(name, nearest);
  return edits <= std::max(1, size / 3) && edits < size ? nearest : std::string();
}

std::string did_you_mean(std::string_view name, std::span<std::string const> known,
                         std::function<std::string(std::string const&)> const& meaning) {
  if (known.empty()) return "none is known";
  if (std::string const meant = meant_name(name, known); !meant.empty()) return "did you mean '" + meant + "'?";
  std::string sentence = "known: ";
  std::vector<std::string> const names = nearest_first(name, known, meaning);
  for (std::size_t i = 0; i < std::min(names.size(), listed_at_most); ++i) {
    sentence += (i == 0 ? "'" : ", '") + names[i] + "'";
    if (auto const said = meaning ? meaning(names[i]) : ""; !said.empty()) sentence += " (" + said + ")";
  }
  return names.size() > listed_at_most ? sentence + ", …" : sentence;
}

}  // namespace thermotwin::thermal
