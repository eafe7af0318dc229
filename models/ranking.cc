#include "models/ranking.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace thermotwin::models {

using Eigen::Index;
using Eigen::VectorXd;

Index best(VectorXd const& score, std::vector<Index> const& among) {
  double largest = score(among.front()), magnitude = 0.0;
  for (Index const i : among) {
    largest = std::max(largest, score(i));
    magnitude = std::max(magnitude, std::abs(score(i)));
  }
  return *std::find_if(among.begin(), among.end(), [&](Index i) { return score(i) >= largest - 1e-9 * magnitude; });
}

std::vector<Index> ranked(VectorXd const& score, std::vector<Index> among) {
  std::vector<Index> order;
  while (!among.empty()) {
    order.push_back(best(score, among));
    std::erase(among, order.back());
  }
  return order;
}

std::vector<Index> completed(std::vector<Index> chosen, Index count, VectorXd const& score) {
  for (Index const i : ranked(score, first_numbers(score.size())))
    if (std::find(chosen.begin(), chosen.end(), i) == chosen.end()) chosen.push_back(i);
  chosen.resize(std::min(chosen.size(), static_cast<std::size_t>(count)));
  return chosen;
}

std::vector<Index> first_numbers(Index count) {
  std::vector<Index> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), Index{0});
  return numbers;
}

}  // namespace thermotwin::models
