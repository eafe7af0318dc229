#include "thermal/evaluation.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "thermal/error.h"
#include "thermal/fixed_blocks.h"
#include "thermal/physical_constant.h"

namespace thermotwin::thermal {
namespace {

constexpr double roundings_of_a_sum = 1000.0;  // a weight is a share of the sum over all cells

/// `digits`: how many of the last bits are rounding.
template <class Values>
std::vector<double> divided_difference(Values const& plus, Values const& minus, double step, double digits = 8.0) {
  std::vector<double> d(plus.size());
  for (std::size_t i = 0; i < d.size(); ++i) {
    double const rounding =
        digits * std::numeric_limits<double>::epsilon() * std::max(std::abs(plus[i]), std::abs(minus[i]));
    double const change = plus[i] - minus[i];
    d[i] = std::abs(change) > rounding ? change / (2.0 * step) : 0.0;
  }
  return d;
}

}  // namespace

NetworkDerivative difference(Network const& plus, Network const& minus, double step) {
  auto const same = [](bool condition) {
    if (!condition) throw InputError("the parameter changes the structure of the network, not only its numbers");
  };
  same(plus.nodes() == minus.nodes() && plus.groups().size() == minus.groups().size() &&
       plus.boundaries().size() == minus.boundaries().size() && plus.averages().size() == minus.averages().size());
  NetworkDerivative d;
  d.capacity = divided_difference(plus.capacity(), minus.capacity(), step);
  d.capacity_slope = divided_difference(plus.capacity_slope(), minus.capacity_slope(), step);
  for (std::size_t g = 0; g < plus.groups().size(); ++g) {
    auto const& a = plus.groups()[g];
    auto const& b = minus.groups()[g];
    same(a.law == b.law && a.ports == b.ports);
    d.coefficients.push_back(divided_difference(a.coefficients, b.coefficients, step));
    auto& rates = d.coefficients.back();
    if (std::all_of(rates.begin(), rates.end(), [](double r) { return r == 0.0; })) rates.clear();
  }
  for (std::size_t i = 0; i < plus.boundaries().size(); ++i) {
    auto const& a = plus.boundaries()[i];
    auto const& b = minus.boundaries()[i];
    same(a.terms.size() == b.terms.size());
    d.boundary_offset.push_back((a.offset - b.offset) / (2.0 * step));
    auto& weights = d.boundary_weights.emplace_back();
    for (std::size_t k = 0; k < a.terms.size(); ++k)
      weights.push_back((a.terms[k].weight - b.terms[k].weight) / (2.0 * step));
  }
  for (std::size_t i = 0; i < plus.averages().size(); ++i) {
    auto const& a = plus.averages()[i];
    auto const& b = minus.averages()[i];
    same(a.nodes == b.nodes);
    if (a.window != b.window || a.edges != b.edges)
      throw InputError(fmt::format("the parameter changes where '{}' is; that has no sensitivity here", a.name));
    d.average_weights.push_back(divided_difference(a.weights, b.weights, step, roundings_of_a_sum));
  }
  same(plus.relays().size() == minus.relays().size());
  for (std::size_t i = 0; i < plus.relays().size(); ++i) {
    auto const& a = plus.relays()[i];
    auto const& b = minus.relays()[i];
    if (a.high != b.high || a.low != b.low || a.minimum_off_time != b.minimum_off_time)
      throw InputError(fmt::format("the parameter changes when '{}' switches; that has no sensitivity here", a.name));
  }
  return d;
}

Evaluation::Evaluation(Network const& network)
    : network_(&network),
      temperature_(std::size_t(network.temperatures())),
      heat_(temperature_.size()),
      temperature_rate_(temperature_.size()),
      heat_rate_(temperature_.size()) {
  auto const& slope = network.capacity_slope();
  constant_capacity_ = std::all_of(slope.begin(), slope.end(), [](double s) { return s == 0.0; });
  for (auto const& average : network.averages()) weights_.push_back(average.weights);
  input_.resize(std::size_t(network.channels()));
}

/// A window that hangs over the end of its track is cut there.
void Evaluation::weigh_moving_averages(double const* input) {
  auto const& averages = network_->averages();
  for (std::size_t a = 0; a < averages.size(); ++a) {
    auto const& average = averages[a];
    if (average.from_channel < 0) continue;
    double const from = std::min(input[average.from_channel], input[average.to_channel]);
    double const to = std::max(input[average.from_channel], input[average.to_channel]);
    double sum = 0.0;
    for (std::size_t i = 0; i < average.nodes.size(); ++i)
      sum += weights_[a][i] = mean_overlap(average.edges[i], average.edges[i + 1], average.window, from, to);
    if (!(sum > 0.0)) throw InputError("the moving part '" + average.name + "' has left its track");
    for (std::size_t i = 0; i < average.nodes.size(); ++i)
      input_[std::size_t(average.weight_channels[i])] = weights_[a][i] /= sum;
  }
}

std::span<double const> Evaluation::temperatures(double const* state, double const* input) {
  auto const& net = *network_;
  int const n = net.nodes();
  std::copy_n(input, net.given_channels(), input_.begin());
  for_blocks(n, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    if (constant_capacity_)
      std::copy(state + begin, state + end, temperature_.data() + begin);
    else
      for (auto i = begin; i < end; ++i) temperature_[std::size_t(i)] = net.temperature_of_state(int(i), state[i]);
  });
  double* next = temperature_.data() + n;
  for (auto const& boundary : net.boundaries()) {
    *next = boundary.offset;
    for (auto const& term : boundary.terms) *next += term.weight * input[term.channel];
    ++next;
  }
  weigh_moving_averages(input);
  for (std::size_t a = 0; a < net.averages().size(); ++a, ++next) {
    *next = 0.0;
    auto const& nodes = net.averages()[a].nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i) *next += weights_[a][i] * temperature_[std::size_t(nodes[i])];
  }
  return temperature_;
}

void Evaluation::share_averages(std::vector<double>& heat) const {
  auto const& averages = network_->averages();
  double const* into = heat.data() + network_->nodes() + network_->boundaries().size();
  for (std::size_t a = 0; a < averages.size(); ++a)
    for (std::size_t i = 0; i < averages[a].nodes.size(); ++i)
      heat[std::size_t(averages[a].nodes[i])] += weights_[a][i] * into[a];
}

void Evaluation::rate(double const* state, double const* input, double* state_rate) {
  rate_and_power(state, input, state_rate);
}

Energy Evaluation::rate_and_power(double const* state, double const* input, double* state_rate) {
  Energy const energy = power(state, input);
  share_averages(heat_);
  for_terms(network_->nodes(), [state_rate, heat = heat_.data(), capacity = network_->capacity().data()](
                                   std::ptrdiff_t i) { state_rate[i] = heat[i] / capacity[i]; });
  return energy;
}

/// What an element's flows bring into bodies, averages and boundaries together; a controller's state is none of them.
double Evaluation::heat_made(ElementGroup const& group, int element, double const* flows) const {
  int const p = group.law->ports();
  double made = 0.0;
  for (int k = 0; k < p; ++k) {
    int const port = group.ports[std::size_t(element * p + k)];
    bool const signal = port < network_->nodes() && network_->signals()[std::size_t(port)];
    if (!signal) made += flows[element * p + k];
  }
  return made;
}

/// From the blocks of a group that makes or takes heat.
void Evaluation::add_made_gradient(ElementGroup const& group, Linearisation& result) {
  int const p = group.law->ports(), n = network_->nodes();
  flows_.resize(group.ports.size());
  group.law->heat_flows(group.batch(), temperature_.data(), input_.data(), flows_.data());
  for (int e = 0; e < group.count(); ++e) {
    bool const makes = heat_made(group, e, flows_.data()) >= 0.0;
    int const* port = group.ports.data() + std::size_t(e * p);
    for (int k = 0; k < p; ++k) {
      if (port[k] < n && network_->signals()[std::size_t(port[k])]) continue;
      for (int r = 0; r < p; ++r) {
        double const slope = blocks_[std::size_t((e * p + k) * p + r)];
        result.power(makes ? 0 : 1, port[r]) += makes ? slope : -slope;
      }
    }
  }
}

/// The blocks of a group, at the present temperatures, to the values of the coupling.
void Evaluation::add_coupling(std::size_t group, double* values) {
  auto const& slots = network_->slots_[group];
  auto const& elements = network_->groups()[group];
  blocks_.resize(slots.size());
  elements.law->jacobian_blocks(elements.batch(), temperature_.data(), input_.data(), blocks_.data());
  for (std::size_t i = 0; i < blocks_.size(); ++i) values[slots[i]] += blocks_[i];
}

void Evaluation::linearise(double const* state, double const* input, Linearisation& result) {
  auto const& net = *network_;
  int const n = net.nodes(), boundaries = int(net.boundaries().size());
  result.rate.resize(n);
  rate_and_power(state, input, result.rate.data());  // leaves the flows into the boundaries in heat_
  if (result.coupling.rows() == 0) result.coupling = net.port_pattern();
  result.power.setZero(4, net.temperatures());
  if (linear_coupling_.empty()) {
    linear_coupling_.assign(std::size_t(result.coupling.nonZeros()), 0.0);
    for (std::size_t g = 0; g < net.groups().size(); ++g)
      if (net.groups()[g].law->linear()) add_coupling(g, linear_coupling_.data());
  }
  double* values = result.coupling.valuePtr();
  std::copy(linear_coupling_.begin(), linear_coupling_.end(), values);
  for (std::size_t g = 0; g < net.groups().size(); ++g) {
    auto const& group = net.groups()[g];
    if (group.law->linear()) continue;
    add_coupling(g, values);
    if (!group.law->conservative()) add_made_gradient(group, result);
  }
  for (int column = 0; column < net.temperatures(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator it(result.coupling, column); it; ++it)
      if (it.row() >= n && it.row() < n + boundaries) {
        result.power(2, column) += it.value();
        result.power(3, column) += heat_[std::size_t(it.row())] < 0.0 ? -it.value() : it.value();
      }
  result.slope.resize(n);
  for (int i = 0; i < n; ++i)
    result.slope[i] =
        1.0 / (1.0 + net.capacity_slope()[std::size_t(i)] * (temperature_[std::size_t(i)] - reference_temperature));
  result.weights = weights_;
}

Eigen::SparseMatrix<double> Evaluation::jacobian(double const* state, double const* input) {
  auto const& net = *network_;
  Linearisation at;
  linearise(state, input, at);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < net.nodes(); ++i) entries.emplace_back(i, i, 1.0);
  int const first_average = net.nodes() + int(net.boundaries().size());
  for (int a = 0; a < int(net.averages().size()); ++a)
    for (std::size_t i = 0; i < at.weights[std::size_t(a)].size(); ++i)
      entries.emplace_back(first_average + a, net.averages()[std::size_t(a)].nodes[i], at.weights[std::size_t(a)][i]);
  Eigen::SparseMatrix<double> spread(net.temperatures(), net.nodes());
  spread.setFromTriplets(entries.begin(), entries.end());
  Eigen::Map<Eigen::VectorXd const> const capacity(net.capacity().data(), net.nodes());
  Eigen::SparseMatrix<double> const coupling = spread.transpose() * at.coupling * spread;
  return capacity.cwiseInverse().asDiagonal() * coupling * at.slope.asDiagonal();
}

std::span<double const> Evaluation::temperature_derivatives(double const* state, double const* state_derivative,
                                                            NetworkDerivative const& derivative, double const* input) {
  temperatures(state, input);
  auto const& net = *network_;
  int const n = net.nodes();
  for (int i = 0; i < n; ++i) {
    auto const k = std::size_t(i);
    double const rise = temperature_[k] - reference_temperature;
    // y − reference_temperature = rise + ½ s rise²  ⇒  dy = (1 + s rise) dT + ½ rise² ds
    temperature_rate_[k] = (state_derivative[i] - 0.5 * rise * rise * derivative.capacity_slope[k]) /
                           (1.0 + net.capacity_slope()[k] * rise);
  }
  double* next = temperature_rate_.data() + n;
  for (std::size_t b = 0; b < net.boundaries().size(); ++b, ++next) {
    *next = derivative.boundary_offset[b];
    for (std::size_t k = 0; k < net.boundaries()[b].terms.size(); ++k)
      *next += derivative.boundary_weights[b][k] * input[net.boundaries()[b].terms[k].channel];
  }
  for (std::size_t a = 0; a < net.averages().size(); ++a, ++next) {
    *next = 0.0;
    auto const& nodes = net.averages()[a].nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      *next += weights_[a][i] * temperature_rate_[std::size_t(nodes[i])] +
               derivative.average_weights[a][i] * temperature_[std::size_t(nodes[i])];
  }
  return temperature_rate_;
}

void Evaluation::rate_derivative(double const* state, double const* state_derivative,
                                 NetworkDerivative const& derivative, double const* input, double* result) {
  temperature_derivatives(state, state_derivative, derivative, input);
  auto const& net = *network_;
  std::fill(heat_.begin(), heat_.end(), 0.0);
  std::fill(heat_rate_.begin(), heat_rate_.end(), 0.0);
  for (std::size_t g = 0; g < net.groups().size(); ++g) {
    auto const& group = net.groups()[g];
    flows_.assign(group.coefficients.size(), 0.0);
    double const* rates = derivative.coefficients[g].empty() ? flows_.data() : derivative.coefficients[g].data();
    group.law->add_heat_flows(group.batch(), temperature_.data(), input_.data(), heat_.data());
    group.law->add_directional(group.batch(), temperature_.data(), temperature_rate_.data(), rates, input_.data(),
                               heat_rate_.data());
  }
  int const first_average = net.nodes() + int(net.boundaries().size());
  for (std::size_t a = 0; a < net.averages().size(); ++a)
    for (std::size_t i = 0; i < net.averages()[a].nodes.size(); ++i)
      heat_rate_[std::size_t(net.averages()[a].nodes[i])] +=
          derivative.average_weights[a][i] * heat_[std::size_t(first_average) + a];
  share_averages(heat_);
  share_averages(heat_rate_);
  for (std::size_t i = 0; i < net.capacity().size(); ++i) {
    double const c = net.capacity()[i];
    result[i] = heat_rate_[i] / c - heat_[i] * derivative.capacity[i] / (c * c);
  }
}

Energy Evaluation::power(double const* state, double const* input) {
  temperatures(state, input);
  auto const& net = *network_;
  for_blocks(std::ptrdiff_t(heat_.size()), [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    std::fill(heat_.begin() + begin, heat_.begin() + end, 0.0);
  });
  Energy energy;
  for (auto const& group : net.groups()) {
    if (group.inside) {
      net.conduction().add_heat_flows(temperature_.data(), heat_.data());
      continue;
    }
    if (group.law->conservative()) {
      group.law->add_heat_flows(group.batch(), temperature_.data(), input_.data(), heat_.data());
      continue;
    }
    flows_.resize(group.ports.size());
    group.law->heat_flows(group.batch(), temperature_.data(), input_.data(), flows_.data());
    for (std::size_t i = 0; i < flows_.size(); ++i) heat_[std::size_t(group.ports[i])] += flows_[i];
    for (int e = 0; e < group.count(); ++e) {
      double const made = heat_made(group, e, flows_.data());
      (made >= 0.0 ? energy.supplied : energy.withdrawn) += std::abs(made);
    }
  }
  for (std::size_t b = 0; b < net.boundaries().size(); ++b) {
    energy.lost += heat_[std::size_t(net.nodes()) + b];
    energy.exchanged += std::abs(heat_[std::size_t(net.nodes()) + b]);
  }
  return energy;
}

void Evaluation::heat_of_parts(double const* state, double const* input, std::span<double> watts) {
  temperatures(state, input);
  auto const& net = *network_;
  int const n = net.nodes(), first_average = n + int(net.boundaries().size());
  std::fill(watts.begin(), watts.end(), 0.0);
  for (auto const& group : net.groups()) {
    int const p = group.law->ports();
    flows_.resize(group.ports.size());
    group.law->heat_flows(group.batch(), temperature_.data(), input_.data(), flows_.data());
    for (int e = 0; e < group.count(); ++e)
      for (int k = 0; k < p; ++k) {
        int const port = group.ports[std::size_t(e * p + k)];
        bool const body = port >= first_average || (port < n && !net.signals()[std::size_t(port)]);
        if (body) watts[std::size_t(group.parts[std::size_t(e)])] += flows_[std::size_t(e * p + k)];
      }
  }
}

void Evaluation::source_of_nodes(double const* state, double const* input, std::span<double> watts) {
  temperatures(state, input);
  std::fill(heat_.begin(), heat_.end(), 0.0);
  for (auto const& group : network_->groups())
    if (!group.law->conservative())
      group.law->add_heat_flows(group.batch(), temperature_.data(), input_.data(), heat_.data());
  share_averages(heat_);
  std::copy_n(heat_.begin(), watts.size(), watts.begin());
}

}  // namespace thermotwin::thermal
