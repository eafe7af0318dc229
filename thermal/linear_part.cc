#include "thermal/linear_part.h"

#include <algorithm>
#include <cmath>

#include "thermal/laws.h"

namespace thermotwin::thermal {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

bool has_constant_capacity(Network const& network, int port) {
  auto const shares = node_shares(network, port);
  return std::all_of(shares.begin(), shares.end(),
                     [&](auto const& share) { return network.capacity_slope()[std::size_t(share.first)] == 0.0; });
}

bool is_plain_conductance(Network const& network, ElementGroup const& group, int element) {
  return group.law == law_of<Conductance>() && has_constant_capacity(network, group.ports[std::size_t(2 * element)]) &&
         has_constant_capacity(network, group.ports[std::size_t(2 * element + 1)]);
}

/// −∂q₀/∂T₀ of every element, 0 where the two ports do not answer nearly alike: then it does not conduct.
std::vector<double> secants(ElementGroup const& group, ReferencePoint const& at) {
  std::vector<double> result(std::size_t(group.count()), 0.0);
  if (group.law->ports() != 2 || !group.law->conservative()) return result;
  std::vector<double> blocks(std::size_t(group.count()) * 4);
  group.law->jacobian_blocks(group.batch(), at.temperatures.data(), at.input.data(), blocks.data());
  for (std::size_t e = 0; e < result.size(); ++e) {
    double const own = -blocks[4 * e], other = blocks[4 * e + 1];
    if (own > 0.0 && std::abs(own - other) < 0.5 * own) result[e] = own;
  }
  return result;
}

void add_conductance(Network const& network, int first, int second, double g, Triplets& inside, Triplets& outside) {
  auto shares = node_shares(network, first);
  for (auto const& [node, share] : node_shares(network, second)) shares.emplace_back(node, -share);
  for (auto const& [row, a] : shares)
    for (auto const& [column, b] : shares) inside.emplace_back(row, column, g * a * b);
  for (int port : {first, second}) {
    int const boundary = port - network.nodes();
    if (boundary < 0 || boundary >= int(network.boundaries().size())) continue;
    for (auto const& [node, share] : shares) outside.emplace_back(node, boundary, g * std::abs(share));
  }
}

}  // namespace

std::vector<std::pair<int, double>> node_shares(Network const& network, int port) {
  if (port < network.nodes()) return {{port, 1.0}};
  int const index = port - network.nodes() - int(network.boundaries().size());
  if (index < 0) return {};
  auto const& average = network.averages()[std::size_t(index)];
  std::vector<std::pair<int, double>> shares;
  for (std::size_t i = 0; i < average.nodes.size(); ++i) shares.emplace_back(average.nodes[i], average.weights[i]);
  return shares;
}

LinearPart::LinearPart(Network const& network, ReferencePoint const& at) {
  Triplets inside, outside;
  for (auto const& group : network.groups()) {
    auto& g = secant.emplace_back(secants(group, at));
    auto& linear = is_all_linear.emplace_back(g.size(), 0);
    for (int e = 0; e < group.count(); ++e) {
      auto const k = std::size_t(e);
      linear[k] = is_plain_conductance(network, group, e) ? 1 : 0;
      if (linear[k]) g[k] = group.coefficients[k];
      if (g[k] > 0.0) add_conductance(network, group.ports[2 * k], group.ports[2 * k + 1], g[k], inside, outside);
    }
  }
  conductance.resize(network.nodes(), network.nodes());
  conductance.setFromTriplets(inside.begin(), inside.end());
  boundary.resize(network.nodes(), Eigen::Index(network.boundaries().size()));
  boundary.setFromTriplets(outside.begin(), outside.end());
}

std::vector<SampledElement> nonlinear_elements(Network const& network, LinearPart const& linear) {
  std::vector<SampledElement> elements;
  for (int g = 0; g < int(network.groups().size()); ++g)
    for (int e = 0; e < network.groups()[std::size_t(g)].count(); ++e)
      if (!linear.is_all_linear[std::size_t(g)][std::size_t(e)]) elements.push_back({g, e, 1.0});
  return elements;
}

}  // namespace thermotwin::thermal
