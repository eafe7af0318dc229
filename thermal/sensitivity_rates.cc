#include "thermal/sensitivity_rates.h"

#include <algorithm>

namespace thermotwin::thermal {
namespace {

std::vector<NetworkDerivative const*> addresses(std::vector<NetworkDerivative> const& parameters) {
  std::vector<NetworkDerivative const*> all;
  for (auto const& parameter : parameters) all.push_back(&parameter);
  return all;
}

}  // namespace

bool has_no_column(NetworkDerivative const& parameter) {
  auto const any = [](std::vector<double> const& values) {
    return std::any_of(values.begin(), values.end(), [](double v) { return v != 0.0; });
  };
  return any(parameter.capacity_slope) ||
         std::any_of(parameter.average_weights.begin(), parameter.average_weights.end(), any);
}

SensitivityRates::SensitivityRates(Network const& network, std::vector<NetworkDerivative> const& parameters)
    : network_(&network), columns_(network, addresses(parameters)) {}

void SensitivityRates::evaluate(Evaluation& evaluation, double const* state, double const* input,
                                std::span<double const* const> state_derivatives, std::span<double* const> rates) {
  auto const& averages = network_->averages();
  Eigen::Index const nodes = network_->nodes(), count = columns_.count();
  Eigen::Index const first_average = nodes + Eigen::Index(network_->boundaries().size());
  columns_.evaluate(evaluation, state, input, forcing_);
  evaluation.linearise(state, input, at_);
  temperature_.setZero(network_->temperatures(), count);
  heat_.setZero(network_->temperatures(), count);
  for (Eigen::Index k = 0; k < count; ++k)
    for (Eigen::Index i = 0; i < nodes; ++i) temperature_(i, k) = state_derivatives[std::size_t(k)][i] * at_.slope[i];
  for (std::size_t a = 0; a < averages.size(); ++a)
    for (std::size_t i = 0; i < averages[a].nodes.size(); ++i)
      temperature_.row(first_average + Eigen::Index(a)) += at_.weights[a][i] * temperature_.row(averages[a].nodes[i]);
  for (Eigen::Index port = 0; port < at_.coupling.outerSize(); ++port) {
    if (port >= nodes && port < first_average) continue;
    for (Eigen::SparseMatrix<double>::InnerIterator it(at_.coupling, port); it; ++it)
      heat_.row(it.row()) += it.value() * temperature_.row(port);
  }
  for (std::size_t a = 0; a < averages.size(); ++a)
    for (std::size_t i = 0; i < averages[a].nodes.size(); ++i)
      heat_.row(averages[a].nodes[i]) += at_.weights[a][i] * heat_.row(first_average + Eigen::Index(a));
  for (Eigen::Index k = 0; k < count; ++k)
    for (Eigen::Index i = 0; i < nodes; ++i)
      rates[std::size_t(k)][i] = heat_(i, k) / network_->capacity()[std::size_t(i)] + forcing_(i, k);
}

}  // namespace thermotwin::thermal
