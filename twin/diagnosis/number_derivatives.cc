#include "twin/diagnosis/number_derivatives.h"

#include <Eigen/Core>
#include <algorithm>

#include "thermal/error.h"
#include "twin/parallel.h"

namespace thermotwin::twin {
namespace {

void scale(thermal::NetworkDerivative& d, double factor) {
  auto const times = [&](std::vector<double>& values) {
    for (double& v : values) v *= factor;
  };
  times(d.capacity);
  times(d.boundary_offset);
  for (auto& group : d.coefficients) times(group);
  for (auto& weights : d.boundary_weights) times(weights);
}

/// By more than a hundredth in a group.
bool differs(std::vector<std::vector<double>> const& one, std::vector<std::vector<double>> const& other) {
  for (std::size_t g = 0; g < one.size() && g < other.size(); ++g) {
    if (one[g].empty() || one[g].size() != other[g].size()) continue;
    Eigen::Map<Eigen::VectorXd const> const a(one[g].data(), Eigen::Index(one[g].size()));
    Eigen::Map<Eigen::VectorXd const> const b(other[g].data(), a.size());
    if ((a - b).norm() > 0.01 * b.norm()) return true;
  }
  return false;
}

bool all_zero(std::vector<NodeWeights> const& channels) {
  return std::all_of(channels.begin(), channels.end(), [](NodeWeights const& weights) {
    return std::all_of(weights.begin(), weights.end(), [](auto const& w) { return w.second == 0.0; });
  });
}

}  // namespace

bool changes_heat(thermal::NetworkDerivative const& d) {
  auto const any = [](std::vector<double> const& values) {
    return std::any_of(values.begin(), values.end(), [](double v) { return v != 0.0; });
  };
  return any(d.capacity) || any(d.boundary_offset) || std::any_of(d.coefficients.begin(), d.coefficients.end(), any) ||
         std::any_of(d.boundary_weights.begin(), d.boundary_weights.end(), any);
}

NumberDerivatives::NumberDerivatives(Value document, std::vector<UncertainNumber> numbers)
    : numbers_(std::move(numbers)), derivatives_(numbers_.size()), is_bent_(numbers_.size(), 0) {
  in_parallel(numbers_.size(), [&](std::size_t i) {
    try {
      derivatives_[i] = differentiate(document, numbers_[i].path);
    } catch (thermal::InputError const&) {  // another structure, or other relays: what it does is not asked
      numbers_[i].of_any_kind = false;
      return;
    }
    if (all_zero(derivatives_[i].displacements)) derivatives_[i].displacements.clear();
    is_bent_[i] = bends(document, i) ? 1 : 0;
  });
}

bool NumberDerivatives::bends(Value document, std::size_t i) const {
  auto const& number = numbers_[i];
  double const half = 0.5 * number.deviation;
  double const x = number.upper >= half ? half : std::max(-half, number.lower);
  set_number(document, {number.path, number.nominal, number.dimension, false}, number.value(x));
  try {
    auto const there = differentiate(document, number.path).network;
    return differs(there.coefficients, derivatives_[i].network.coefficients);
  } catch (thermal::InputError const&) {  // so much of it no machine may have
    return false;
  }
}

bool NumberDerivatives::is_read_directly(std::size_t i) const {
  return numbers_[i].of_any_kind && derivatives_[i].displacements.empty() && !changes_heat(derivatives_[i].network);
}

thermal::NetworkDerivative NumberDerivatives::network(std::size_t i, Value const& at, double x) const {
  auto derivative = is_bent_[i] ? differentiate(at, numbers_[i].path).network : derivatives_[i].network;
  scale(derivative, numbers_[i].slope(x));
  return derivative;
}

}  // namespace thermotwin::twin
