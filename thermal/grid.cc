#include "thermal/grid.h"

#include <map>
#include <vector>

namespace thermotwin::thermal {
namespace {

/// How many links bridge each distance.
std::map<int, int> links_by_offset(Eigen::SparseMatrix<double> const& pattern, int first, int count) {
  std::map<int, int> links;
  for (int column = first; column < first + count; ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator it(pattern, column); it; ++it)
      if (it.row() > column && it.row() < first + count) ++links[int(it.row()) - column];
  return links;
}

}  // namespace

int Grid::direction(int from, int offset) const {
  int const place = from - first;
  for (int d = 0; d < 3; ++d) {
    int const s = stride(d), extent = n[std::size_t(d)];
    if (offset == s && extent > 1) return place / s % extent + 1 < extent ? d : -1;
  }
  return -1;
}

Grid find_grid(Eigen::SparseMatrix<double> const& pattern, int first, int count) {
  Grid const row{first, {count, 1, 1}};
  if (count == 1) return row;
  std::vector<int> strides;
  for (auto const& [offset, links] : links_by_offset(pattern, first, count))
    if (links >= 0.4 * count) strides.push_back(offset);
  if (strides.size() < 2 || strides.size() > 3 || strides[0] != 1) return row;
  strides.resize(3, count);
  if (strides[2] % strides[1] != 0 || count % strides[2] != 0) return row;
  return {first, {strides[1], strides[2] / strides[1], count / strides[2]}};
}

}  // namespace thermotwin::thermal
