#pragma once

#include <Eigen/Core>
#include <numeric>
#include <vector>

namespace thermotwin::models {

/// The next set of that size of the numbers 0 to `of` − 1, in lexical order; false after the last.
inline bool next_subset(std::vector<Eigen::Index>& set, Eigen::Index of) {
  auto const size = Eigen::Index(set.size());
  for (auto i = size - 1; i >= 0; --i)
    if (set[std::size_t(i)] < of - size + i) {
      std::iota(set.begin() + i, set.end(), set[std::size_t(i)] + 1);
      return true;
    }
  return false;
}

/// Calls `visit` with every set of `size` of the numbers 0 to `of` − 1, in lexical order.
template <class Visit>
void for_each_subset(Eigen::Index of, Eigen::Index size, Visit const& visit) {
  std::vector<Eigen::Index> set(static_cast<std::size_t>(size));
  std::iota(set.begin(), set.end(), Eigen::Index{0});
  do visit(set);
  while (next_subset(set, of));
}

}  // namespace thermotwin::models
