#include "thermal/sensitivity_rates.h"

#include <algorithm>
#include <utility>

namespace thermotwin::thermal {
namespace {

std::vector<NetworkDerivative const*> addresses(std::vector<NetworkDerivative> const& parameters,
                                                std::vector<std::size_t> const& chosen) {
  std::vector<NetworkDerivative const*> all;
  for (std::size_t const k : chosen) all.push_back(&parameters[k]);
  return all;
}

bool has_column(NetworkDerivative const& parameter) {
  auto const none = [](std::vector<double> const& values) {
    return std::all_of(values.begin(), values.end(), [](double v) { return v == 0.0; });
  };
  return none(parameter.capacity_slope) &&
         std::all_of(parameter.average_weights.begin(), parameter.average_weights.end(), none);
}

}  // namespace

SensitivityRates::Parts SensitivityRates::parts_of(std::vector<NetworkDerivative> const& parameters) {
  Parts parts;
  for (std::size_t k = 0; k < parameters.size(); ++k)
    (has_column(parameters[k]) ? parts.together : parts.apart).push_back(k);
  return parts;
}

SensitivityRates::SensitivityRates(Network const& network, std::vector<NetworkDerivative> const& parameters)
    : SensitivityRates(network, parameters, parts_of(parameters)) {}

SensitivityRates::SensitivityRates(Network const& network, std::vector<NetworkDerivative> const& parameters,
                                   Parts parts)
    : network_(&network),
      parameters_(&parameters),
      parts_(std::move(parts)),
      columns_(network, addresses(parameters, parts_.together)) {}

void SensitivityRates::evaluate(Evaluation& evaluation, double const* state, double const* input,
                                std::span<double const* const> state_derivatives, std::span<double* const> rates) {
  auto const& averages = network_->averages();
  Eigen::Index const nodes = network_->nodes(), count = columns_.count();
  Eigen::Index const first_average = nodes + Eigen::Index(network_->boundaries().size());
  columns_.evaluate(evaluation, state, input, forcing_);
  evaluation.linearise(state, input, at_);
  temperature_.setZero(network_->temperatures(), count);
  heat_.setZero(network_->temperatures(), count);
  for (Eigen::Index k = 0; k < count; ++k) {
    double const* derivative = state_derivatives[parts_.together[std::size_t(k)]];
    for (Eigen::Index i = 0; i < nodes; ++i) temperature_(i, k) = derivative[i] * at_.slope[i];
  }
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
  for (Eigen::Index k = 0; k < count; ++k) {
    double* rate = rates[parts_.together[std::size_t(k)]];
    for (Eigen::Index i = 0; i < nodes; ++i)
      rate[i] = heat_(i, k) / network_->capacity()[std::size_t(i)] + forcing_(i, k);
  }
  for (std::size_t const k : parts_.apart)
    evaluation.rate_derivative(state, state_derivatives[k], (*parameters_)[k], input, rates[k]);
}

}  // namespace thermotwin::thermal
