#include "thermal/parameter_columns.h"

#include <algorithm>
#include <numeric>

#include "thermal/error.h"

namespace thermotwin::thermal {
namespace {

bool any(std::vector<double> const& values) {
  return std::any_of(values.begin(), values.end(), [](double v) { return v != 0.0; });
}

}  // namespace

NetworkDerivative lengthened(NetworkDerivative d, Network const& network) {
  d.capacity.resize(network.capacity().size());
  d.capacity_slope.resize(network.capacity().size());
  d.coefficients.resize(network.groups().size());
  for (std::size_t g = 0; g < d.coefficients.size(); ++g)
    if (!d.coefficients[g].empty()) d.coefficients[g].resize(network.groups()[g].coefficients.size());
  d.boundary_offset.resize(network.boundaries().size());
  d.boundary_weights.resize(network.boundaries().size());
  for (std::size_t b = 0; b < d.boundary_weights.size(); ++b)
    d.boundary_weights[b].resize(network.boundaries()[b].terms.size());
  d.average_weights.resize(network.averages().size());
  for (std::size_t a = 0; a < d.average_weights.size(); ++a)
    d.average_weights[a].resize(network.averages()[a].weights.size());
  return d;
}

bool ParameterColumns::has(NetworkDerivative const& parameter) {
  return !any(parameter.capacity_slope) &&
         std::none_of(parameter.average_weights.begin(), parameter.average_weights.end(), any);
}

ParameterColumns::ParameterColumns(Network const& network, std::vector<NetworkDerivative const*> const& parameters)
    : network_(&network), count_(int(parameters.size())) {
  for (std::size_t g = 0; g < network.groups().size(); ++g) add_group(network.groups()[g], g, parameters);
  for (int k = 0; k < count_; ++k) {
    auto const& parameter = *parameters[std::size_t(k)];
    if (!has(parameter)) throw InputError("parameter '" + parameter.name + "' moves a place; that has no column here");
    for (std::size_t i = 0; i < parameter.capacity.size(); ++i)
      if (parameter.capacity[i] != 0.0)
        capacities_.push_back({int(i), k, parameter.capacity[i] / network.capacity()[i]});
    for (std::size_t b = 0; b < parameter.boundary_offset.size(); ++b)
      if (parameter.boundary_offset[b] != 0.0 || any(parameter.boundary_weights[b]))
        boundaries_.push_back({int(b), k, parameter.boundary_offset[b], parameter.boundary_weights[b]});
  }
}

void ParameterColumns::add_group(ElementGroup const& group, std::size_t index,
                                 std::vector<NetworkDerivative const*> const& parameters) {
  int const P = group.law->ports(), C = group.law->coefficients(), U = group.law->inputs();
  Group own{group.law, {}, {}, {}, {}, {}, {}};
  for (int k = 0; k < count_; ++k) {
    auto const& rates = parameters[std::size_t(k)]->coefficients[index];
    if (rates.empty()) continue;
    for (int e = 0; e < group.count(); ++e) {
      auto const first = rates.begin() + e * C;
      if (std::all_of(first, first + C, [](double r) { return r == 0.0; })) continue;
      own.columns.push_back(k);
      own.ports.insert(own.ports.end(), group.ports.begin() + e * P, group.ports.begin() + (e + 1) * P);
      own.inputs.insert(own.inputs.end(), group.inputs.begin() + e * U, group.inputs.begin() + (e + 1) * U);
      own.coefficients.insert(own.coefficients.end(), group.coefficients.begin() + e * C,
                              group.coefficients.begin() + (e + 1) * C);
      own.rates.insert(own.rates.end(), first, first + C);
    }
  }
  if (own.columns.empty()) return;
  own.own_ports.resize(own.ports.size());
  std::iota(own.own_ports.begin(), own.own_ports.end(), 0);
  groups_.push_back(std::move(own));
}

void ParameterColumns::add_heat(Evaluation const& evaluation, int port, int column, double heat,
                                NodeByParameter& forcing) const {
  int const n = network_->nodes(), first_average = n + int(network_->boundaries().size());
  auto const& capacity = network_->capacity();
  if (port < n) {
    forcing(port, column) += heat / capacity[std::size_t(port)];
  } else if (port >= first_average) {
    auto const a = std::size_t(port - first_average);
    auto const& nodes = network_->averages()[a].nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      forcing(nodes[i], column) += evaluation.average_weights()[a][i] * heat / capacity[std::size_t(nodes[i])];
  }
}

void ParameterColumns::evaluate(Evaluation& evaluation, double const* state, double const* input,
                                NodeByParameter& forcing) const {
  Linearisation at;
  if (!boundaries_.empty()) {
    evaluation.linearise(state, input, at);
  } else if (!capacities_.empty()) {
    at.rate.resize(network_->nodes());
    evaluation.rate(state, input, at.rate.data());
  }
  evaluate(evaluation, at, state, input, forcing);
}

void ParameterColumns::evaluate(Evaluation& evaluation, Linearisation const& at, double const* state,
                                double const* input, NodeByParameter& forcing) const {
  int const n = network_->nodes();
  forcing.setZero(n, count_);
  for (auto const& c : capacities_) forcing(c.node, c.column) -= at.rate[c.node] * c.relative;
  for (auto const& change : boundaries_) {
    auto const& boundary = network_->boundaries()[std::size_t(change.boundary)];
    double warmer = change.offset;
    for (std::size_t t = 0; t < boundary.terms.size(); ++t)
      warmer += change.weights[t] * input[boundary.terms[t].channel];
    for (Eigen::SparseMatrix<double>::InnerIterator it(at.coupling, n + change.boundary); it; ++it)
      add_heat(evaluation, int(it.row()), change.column, it.value() * warmer, forcing);
  }
  auto const temperature = evaluation.temperatures(state, input);
  std::vector<double> own, still, heat;
  for (auto const& group : groups_) {
    own.resize(group.ports.size());
    for (std::size_t i = 0; i < own.size(); ++i) own[i] = temperature[std::size_t(group.ports[i])];
    still.assign(own.size(), 0.0);
    heat.assign(own.size(), 0.0);
    ElementBatch const batch{int(group.columns.size()), group.own_ports, group.coefficients, group.inputs};
    group.law->add_directional(batch, own.data(), still.data(), group.rates.data(), evaluation.inputs().data(),
                               heat.data());
    auto const ports = group.ports.size() / group.columns.size();
    for (std::size_t i = 0; i < heat.size(); ++i)
      if (heat[i] != 0.0) add_heat(evaluation, group.ports[i], group.columns[i / ports], heat[i], forcing);
  }
}

}  // namespace thermotwin::thermal
