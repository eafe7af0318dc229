#include "thermal/reduced_network.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "thermal/error.h"
#include "thermal/physical_constant.h"
#include "thermal/threaded_product.h"

namespace thermotwin::thermal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// V (VᵀCV)^−½, twice: what the first leaves of round-off the second takes away.
MatrixXd orthonormal(MatrixXd shapes, VectorXd const& capacity) {
  for (int pass = 0; pass < 2; ++pass) {
    for (Index k = 0; k < shapes.cols(); ++k) shapes.col(k) /= std::sqrt(shapes.col(k).cwiseAbs2().dot(capacity));
    MatrixXd const heat = capacity.asDiagonal() * shapes;
    Eigen::SelfAdjointEigenSolver<MatrixXd> const solver(threaded_product(shapes.transpose(), heat));
    if (!(solver.eigenvalues()[0] > 1e-13)) throw InputError("the shapes of a reduced network depend on each other");
    MatrixXd const turn = solver.eigenvectors() * solver.eigenvalues().cwiseSqrt().cwiseInverse().asDiagonal();
    shapes = threaded_product(shapes, turn);
  }
  return shapes;
}

}  // namespace

std::string why_irreducible(Network const& network) {
  if (!network.relays().empty())
    return fmt::format("the relay '{}' switches by a temperature: such a machine is run in full only",
                       network.relays()[0].name);
  for (auto const& average : network.averages())
    if (average.from_channel >= 0)
      return fmt::format("'{}' moves along its track: such a machine is run in full only", average.name);
  return "";
}

void check_reducible(Network const& network) {
  if (auto const why = why_irreducible(network); !why.empty()) throw InputError(why);
}

ReducedNetwork::ReducedNetwork(Network const& network, LinearPart const& linear, MatrixXd const& shapes,
                               std::vector<SampledElement> const& elements)
    : network_(&network), elements_(elements), start_(network.nodes()) {
  check_reducible(network);
  for (int i = 0; i < network.nodes(); ++i) start_[i] = network.signals()[std::size_t(i)] ? 0.0 : reference_temperature;
  project(linear, shapes);
  add_elements(linear);
}

void ReducedNetwork::project(LinearPart const& linear, MatrixXd const& shapes) {
  Eigen::Map<VectorXd const> const capacity(network_->capacity().data(), network_->nodes());
  MatrixXd const basis = orthonormal(shapes, capacity);
  MatrixXd const flow = linear.conductance * basis;
  MatrixXd const conductance = threaded_product(basis.transpose(), flow);
  Eigen::SelfAdjointEigenSolver<MatrixXd> const solver(0.5 * (conductance + conductance.transpose()));
  decay_ = solver.eigenvalues().cwiseMax(0.0);
  shapes_ = threaded_product(basis, solver.eigenvectors());

  // Boundaries are linear in the inputs: T_b − T₂₀ = (offset − T₂₀) + Σ weight · u.
  auto const& boundaries = network_->boundaries();
  MatrixXd const gain = shapes_.transpose() * linear.boundary;
  VectorXd const per_rise = shapes_.transpose() * (linear.conductance * start_);  // K of equal temperatures: films only
  constant_ = -per_rise;
  input_gain_ = MatrixXd::Zero(size(), network_->external_channels());
  for (std::size_t b = 0; b < boundaries.size(); ++b) {
    constant_ += gain.col(Index(b)) * boundaries[b].offset;
    for (auto const& term : boundaries[b].terms) input_gain_.col(term.channel) += gain.col(Index(b)) * term.weight;
  }
}

int ReducedNetwork::add_row(std::vector<std::pair<int, double>> const& shares) {
  auto& row = pending_rows_.emplace_back(std::size_t(size()) + 1, 0.0);
  for (auto const& [node, share] : shares) {
    for (Index k = 0; k < size(); ++k) row[std::size_t(k)] += share * shapes_(node, k);
    row.back() += share * start_[node];
  }
  return int(pending_rows_.size()) - 1;
}

/// Rows come first; composed averages and boundaries are marked until the number of rows is known.
int ReducedNetwork::compact_port(int port, std::vector<int>& known) {
  constexpr int composed_mark = 1 << 24, boundary_mark = 1 << 25;
  int const boundary = port - network_->nodes();
  if (boundary >= 0 && boundary < int(network_->boundaries().size())) return boundary_mark + boundary;
  if (known[std::size_t(port)] >= 0) return known[std::size_t(port)];
  auto const shares = node_shares(*network_, port);
  bool const is_sloped = std::any_of(shares.begin(), shares.end(), [&](auto const& share) {
    return network_->capacity_slope()[std::size_t(share.first)] != 0.0;
  });
  int index = 0;
  if (is_sloped && port >= network_->nodes()) {
    Composed average;
    for (auto const& [node, share] : shares) average.shares.emplace_back(compact_port(node, known), share);
    composed_.push_back(std::move(average));
    index = composed_mark + int(composed_.size()) - 1;
  } else {
    index = add_row(shares);
    if (is_sloped) sloped_.emplace_back(index, port);
  }
  return known[std::size_t(port)] = index;
}

void ReducedNetwork::add_elements(LinearPart const& linear) {
  std::vector<int> known(std::size_t(network_->temperatures()), -1);
  std::vector<int> place(network_->groups().size(), -1);
  for (auto const& sample : elements_) {
    auto const& source = network_->groups()[std::size_t(sample.group)];
    int& at = place[std::size_t(sample.group)];
    if (at < 0) {
      at = int(groups_.size());
      groups_.push_back({source.law, {}, {}, {}, {}, {}});
    }
    auto& group = groups_[std::size_t(at)];
    auto const copy = [&](auto const& from, auto& to, int count) {
      auto const begin = from.begin() + sample.element * count;
      to.insert(to.end(), begin, begin + count);
    };
    for (int p = 0; p < source.law->ports(); ++p)
      group.ports.push_back(compact_port(source.ports[std::size_t(sample.element * source.law->ports() + p)], known));
    copy(source.coefficients, group.coefficients, source.law->coefficients());
    copy(source.inputs, group.inputs, source.law->inputs());
    group.secant.push_back(linear.secant[std::size_t(sample.group)][std::size_t(sample.element)]);
    group.weight.push_back(sample.weight);
  }
  int const rows = int(pending_rows_.size()), composed = int(composed_.size());
  constexpr int composed_mark = 1 << 24, boundary_mark = 1 << 25;
  for (auto& group : groups_)
    for (int& port : group.ports) {
      if (port >= boundary_mark)
        port += rows + composed - boundary_mark;
      else if (port >= composed_mark)
        port += rows - composed_mark;
    }
  rows_.resize(rows, size());
  row_offset_.resize(rows);
  for (int i = 0; i < rows; ++i) {
    rows_.row(i) = Eigen::Map<Eigen::RowVectorXd const>(pending_rows_[std::size_t(i)].data(), size());
    row_offset_[i] = pending_rows_[std::size_t(i)].back();
  }
  pending_rows_.clear();
}

VectorXd ReducedNetwork::state_of(std::span<double const> node_temperatures) const {
  VectorXd heat(network_->nodes());
  for (int i = 0; i < network_->nodes(); ++i)
    heat[i] = network_->capacity()[std::size_t(i)] *
              (network_->state_of_temperature(i, node_temperatures[std::size_t(i)]) - start_[i]);
  return shapes_.transpose() * heat;
}

void ReducedNetwork::temperatures_of(VectorXd const& state, std::span<double> node_temperatures) const {
  Eigen::Map<VectorXd> all(node_temperatures.data(), network_->nodes());
  all.noalias() = shapes_ * state;
  all += start_;
  for (int i = 0; i < network_->nodes(); ++i)
    if (network_->capacity_slope()[std::size_t(i)] != 0.0) all[i] = network_->temperature_of_state(i, all[i]);
}

ReducedNetwork::Functional ReducedNetwork::functional(std::vector<std::pair<int, double>> const& weights) const {
  Functional result{0.0, Eigen::RowVectorXd::Zero(size())};
  for (auto const& [node, weight] : weights) {
    result.row += weight * shapes_.row(node);
    result.offset += weight * start_[node];
  }
  return result;
}

VectorXd ReducedNetwork::shape_of_port(int port) const {
  if (port < int(rows_.rows())) return rows_.row(port).transpose();
  VectorXd shape = VectorXd::Zero(size());
  if (int const c = port - int(rows_.rows()); c < int(composed_.size()))
    for (auto const& [row, share] : composed_[std::size_t(c)].shares) shape += share * rows_.row(row).transpose();
  return shape;
}

ReducedEvaluation::ReducedEvaluation(ReducedNetwork const& network) : network_(&network) {
  auto const ports = network.rows_.rows() + Index(network.composed_.size() + network.network_->boundaries().size());
  linear_.setZero(ports);
  temperature_.setZero(ports);
  heat_.setZero(ports);
  for (auto const& group : network.groups_) flows_.emplace_back(group.ports.size());
}

void ReducedEvaluation::find_temperatures(VectorXd const& state, double const* input) {
  auto const& net = *network_;
  Index const rows = net.rows_.rows();
  linear_.head(rows).noalias() = net.rows_ * state;
  linear_.head(rows) += net.row_offset_;
  Index next = rows + Index(net.composed_.size());
  for (auto const& boundary : net.network_->boundaries()) {
    double& value = linear_[next++];
    value = boundary.offset;
    for (auto const& term : boundary.terms) value += term.weight * input[term.channel];
  }
  temperature_ = linear_;
  for (auto const& [row, node] : net.sloped_)
    temperature_[row] = net.network_->temperature_of_state(node, linear_[row]);
  for (std::size_t c = 0; c < net.composed_.size(); ++c) {
    double y = 0.0, T = 0.0;
    for (auto const& [row, share] : net.composed_[c].shares) {
      y += share * linear_[row];
      T += share * temperature_[row];
    }
    linear_[rows + Index(c)] = y;
    temperature_[rows + Index(c)] = T;
  }
}

void ReducedEvaluation::rest(VectorXd const& state, double const* input, VectorXd& result) {
  auto const& net = *network_;
  find_temperatures(state, input);
  heat_.setZero();
  for (std::size_t g = 0; g < net.groups_.size(); ++g) {
    auto const& group = net.groups_[g];
    auto& flows = flows_[g];
    group.law->heat_flows(group.batch(), temperature_.data(), input, flows.data());
    auto const ports = std::size_t(group.law->ports());
    for (std::size_t e = 0; e < group.weight.size(); ++e) {
      int const* port = group.ports.data() + e * ports;
      double* flow = flows.data() + e * ports;
      if (ports == 2) {
        double const conducted = group.secant[e] * (linear_[port[1]] - linear_[port[0]]);
        flow[0] -= conducted;
        flow[1] += conducted;
      }
      for (std::size_t p = 0; p < ports; ++p) heat_[port[p]] += group.weight[e] * flow[p];
    }
  }
  Index const rows = net.rows_.rows();
  for (std::size_t c = 0; c < net.composed_.size(); ++c)
    for (auto const& [row, share] : net.composed_[c].shares) heat_[row] += share * heat_[rows + Index(c)];
  result = net.constant_;
  result.noalias() += net.rows_.transpose() * heat_.head(rows);
  for (Index channel = 0; channel < net.input_gain_.cols(); ++channel)
    if (input[channel] != 0.0) result += input[channel] * net.input_gain_.col(channel);
}

double ReducedEvaluation::port_change(VectorXd const& change) {
  change_.noalias() = network_->rows_ * change;
  return change_.size() > 0 ? change_.cwiseAbs().maxCoeff() : change.cwiseAbs().maxCoeff();
}

}  // namespace thermotwin::thermal
