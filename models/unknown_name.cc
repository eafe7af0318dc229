#include "models/unknown_name.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <numeric>
#include <utility>
#include <vector>

namespace thermotwin::models {

namespace {

/// Letters to insert, delete or replace (Levenshtein 1966).
std::size_t edits_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      std::size_t const replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string unknown_name(std::string_view kind, std::string_view name, std::span<std::string_view const> known) {
  auto const nearest = std::min_element(known.begin(), known.end(), [&](auto const& a, auto const& b) {
    return edits_between(name, a) < edits_between(name, b);
  });
  bool const near = nearest != known.end() && 3 * edits_between(name, *nearest) <= nearest->size();
  auto const introduced = near ? fmt::format("did you mean '{}'? Known", *nearest) : "known";
  return fmt::format("no {} '{}'; {}: {}", kind, name, introduced, fmt::join(known, ", "));
}

}  // namespace thermotwin::models
