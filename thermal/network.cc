#include "thermal/network.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "thermal/error.h"
#include "thermal/laws.h"
#include "thermal/nearest_name.h"
#include "thermal/physical_constant.h"

namespace thermotwin::thermal {
namespace {

std::vector<std::string> names_of(std::vector<NodeRange> const& ranges) {
  std::vector<std::string> names;
  for (auto const& range : ranges) names.push_back(range.name);
  return names;
}

int find_or_add(std::vector<std::string>& names, std::string const& name) {
  auto const it = std::find(names.begin(), names.end(), name);
  if (it != names.end()) return int(it - names.begin());
  names.push_back(name);
  return int(names.size()) - 1;
}

/// Union-find over everything a port can be.
class Partition {
 public:
  explicit Partition(int n) : parent_(std::size_t(n)) {
    for (int i = 0; i < n; ++i) parent_[std::size_t(i)] = i;
  }
  int root(int i) {
    while (parent_[std::size_t(i)] != i) i = parent_[std::size_t(i)] = parent_[std::size_t(parent_[std::size_t(i)])];
    return i;
  }
  void join(int a, int b) { parent_[std::size_t(root(a))] = root(b); }

 private:
  std::vector<int> parent_;
};

/// Integral of max(x, 0) from −∞.
double ramp_integral(double x) { return x > 0.0 ? 0.5 * x * x : 0.0; }

}  // namespace

double mean_overlap(double low, double high, double window, double from, double to) {
  double const half = 0.5 * window;
  if (to - from < 1e-9 * window) {
    double const centre = 0.5 * (from + to);
    return std::max(0.0, std::min(high, centre + half) - std::max(low, centre - half));
  }
  // The overlap as a function of the window's centre p is a sum of four ramps; their integrals give the mean.
  auto const integral = [&](double p) {
    return ramp_integral(p + half - low) - ramp_integral(p + half - high) - ramp_integral(p - half - low) +
           ramp_integral(p - half - high);
  };
  return (integral(to) - integral(from)) / (to - from);
}

std::string Network::node_name(int node) const {
  for (auto const& range : ranges_)
    if (node >= range.first && node < range.first + range.count)
      return range.count == 1 ? range.name : fmt::format("{}[{}]", range.name, node - range.first);
  return fmt::format("node {}", node);
}

NodeRange const& Network::range(std::string const& name) const {
  for (auto const& range : ranges_)
    if (range.name == name) return range;
  throw InputError(fmt::format("there is no body '{}'; {}", name, did_you_mean(name, names_of(ranges_))));
}

int Network::index_of(Port port) const {
  switch (port.kind) {
    case Port::Kind::node:
      return port.index;
    case Port::Kind::boundary:
      return nodes() + port.index;
    case Port::Kind::average:
      return nodes() + int(boundaries_.size()) + port.index;
  }
  return -1;
}

double Network::temperature_of_warm_state(int node, double y) const {
  double const slope = capacity_slope_[std::size_t(node)];
  return reference_temperature + (std::sqrt(1.0 + 2.0 * slope * (y - reference_temperature)) - 1.0) / slope;
}

double Network::state_of_temperature(int node, double temperature) const {
  double const rise = temperature - reference_temperature;
  return temperature + 0.5 * capacity_slope_[std::size_t(node)] * rise * rise;
}

void Network::build_pattern() {
  std::vector<Eigen::Triplet<double>> entries;
  for (auto const& group : groups_) {
    int const p = group.law->ports();
    for (int e = 0; e < group.count(); ++e)
      for (int a = 0; a < p; ++a)
        for (int b = 0; b < p; ++b)
          entries.emplace_back(group.ports[std::size_t(e * p + a)], group.ports[std::size_t(e * p + b)], 0.0);
  }
  pattern_.resize(temperatures(), temperatures());
  pattern_.setFromTriplets(entries.begin(), entries.end());
  pattern_.makeCompressed();

  auto const slot = [&](int row, int column) {
    int const* begin = pattern_.innerIndexPtr() + pattern_.outerIndexPtr()[column];
    int const* end = pattern_.innerIndexPtr() + pattern_.outerIndexPtr()[column + 1];
    return int(std::lower_bound(begin, end, row) - pattern_.innerIndexPtr());
  };
  for (auto const& group : groups_) {
    auto& slots = slots_.emplace_back();
    int const p = group.law->ports();
    for (int e = 0; e < group.count(); ++e)
      for (int a = 0; a < p; ++a)
        for (int b = 0; b < p; ++b)
          slots.push_back(slot(group.ports[std::size_t(e * p + a)], group.ports[std::size_t(e * p + b)]));
  }
}

void Network::find_grids() {
  for (auto const& range : ranges_) grids_.push_back(find_grid(pattern_, range.first, range.count));
  for (auto const& group : groups_)
    if (group.inside) conduction_ = GridConduction(grids_, group.ports, group.coefficients);
}

Port NetworkBuilder::add_body(std::string const& name, std::vector<double> const& capacities, double capacity_slope) {
  for (auto const& range : network_.ranges_)
    if (range.name == name) throw InputError(fmt::format("the name '{}' is taken: there are two bodies of it", name));
  for (double c : capacities)
    if (!(c > 0.0) || !std::isfinite(c))
      throw InputError(fmt::format("the heat capacity of '{}' is {} J/K; it must be positive", name, c));
  Port const first{Port::Kind::node, nodes()};
  network_.ranges_.push_back({name, nodes(), int(capacities.size())});
  network_.capacity_.insert(network_.capacity_.end(), capacities.begin(), capacities.end());
  network_.capacity_slope_.resize(network_.capacity_.size(), capacity_slope);
  network_.signal_.resize(network_.capacity_.size(), 0);
  return first;
}

Port NetworkBuilder::add_signal(std::string const& name) {
  Port const port = add_body(name, {1.0});
  network_.signal_.back() = 1;
  return port;
}

Port NetworkBuilder::add_boundary(Boundary boundary) {
  network_.boundaries_.push_back(std::move(boundary));
  return {Port::Kind::boundary, int(network_.boundaries_.size()) - 1};
}

void NetworkBuilder::add_to_boundary(Port boundary, double offset, std::vector<Boundary::Term> const& terms) {
  auto& known = network_.boundaries_.at(std::size_t(boundary.index));
  known.offset += offset;
  known.terms.insert(known.terms.end(), terms.begin(), terms.end());
}

Port NetworkBuilder::add_average(Average average) {
  double sum = 0.0;
  for (double w : average.weights) sum += w;
  if (average.from_channel < 0 && std::abs(sum - 1.0) > 1e-9)
    throw InputError(fmt::format("the weights of the average '{}' add up to {}, not to 1", average.name, sum));
  if (average.from_channel < 0)
    for (double& w : average.weights) w /= sum;
  average.weights.resize(average.nodes.size());
  for (std::size_t i = 0; average.from_channel >= 0 && i < average.nodes.size(); ++i)
    average.weight_channels.push_back(channel(fmt::format("{}.weight[{}]", average.name, i)));
  network_.averages_.push_back(std::move(average));
  return {Port::Kind::average, int(network_.averages_.size()) - 1};
}

int NetworkBuilder::weight_channel(Port average, int entry) const {
  return network_.averages_.at(std::size_t(average.index)).weight_channels.at(std::size_t(entry));
}

int NetworkBuilder::channel(std::string const& name) { return find_or_add(network_.channels_, name); }

int NetworkBuilder::share(std::string const& name) {
  find_or_add(network_.shares_, name);
  return channel(name);
}

int NetworkBuilder::add_relay(std::string const& name, Port measured, Port reference, double high, double low,
                              double minimum_off_time, int enable_channel) {
  if (!(high > low)) throw InputError(fmt::format("relay '{}': switches on at {} K, off at {} K", name, high, low));
  int const state = channel(name + ".state");
  relays_.push_back({{name, 0, 0, high, low, minimum_off_time, enable_channel, state}, measured, reference});
  return state;
}

int NetworkBuilder::part(std::string const& name) { return find_or_add(network_.parts_, name); }

void NetworkBuilder::add(std::shared_ptr<Law const> law, int part, std::vector<Port> const& ports,
                         std::vector<double> const& coefficients, std::vector<int> const& channels) {
  auto const& owner = network_.parts_.at(std::size_t(part));
  if (int(ports.size()) != law->ports() || int(coefficients.size()) != law->coefficients() ||
      int(channels.size()) != law->inputs())
    throw InputError(fmt::format("'{}': the law '{}' takes {} ports, {} coefficients and {} inputs, not {}, {} and {}",
                                 owner, law->name(), law->ports(), law->coefficients(), law->inputs(), ports.size(),
                                 coefficients.size(), channels.size()));
  for (double c : coefficients)
    if (!std::isfinite(c)) throw InputError(fmt::format("'{}': a coefficient of '{}' is {}", owner, law->name(), c));
  bool const inside = law == law_of<Conductance>() && inside_one_body(ports);
  auto it =
      std::find_if(groups_.begin(), groups_.end(), [&](auto const& g) { return g.law == law && g.inside == inside; });
  if (it == groups_.end()) {
    groups_.push_back({law, inside, {}, {}, {}, {}});
    it = groups_.end() - 1;
  }
  it->ports.insert(it->ports.end(), ports.begin(), ports.end());
  it->coefficients.insert(it->coefficients.end(), coefficients.begin(), coefficients.end());
  it->channels.insert(it->channels.end(), channels.begin(), channels.end());
  it->parts.push_back(part);
}

bool NetworkBuilder::inside_one_body(std::vector<Port> const& ports) const {
  if (ports[0].kind != Port::Kind::node || ports[1].kind != Port::Kind::node) return false;
  auto const& ranges = network_.ranges_;
  auto const after = std::upper_bound(ranges.begin(), ranges.end(), ports[0].index,
                                      [](int node, NodeRange const& range) { return node < range.first; });
  auto const& range = *(after - 1);
  return ports[1].index >= range.first && ports[1].index < range.first + range.count;
}

void NetworkBuilder::connect(int part, Port a, Port b, double conductance) {
  if (!(conductance >= 0.0) || !std::isfinite(conductance))
    throw InputError(fmt::format("the conductance of '{}' is {} W/K; it must not be negative",
                                 network_.parts_.at(std::size_t(part)), conductance));
  add<Conductance>(part, {a, b}, {conductance});
}

Network NetworkBuilder::build() {
  if (nodes() == 0) throw InputError("the machine has no body");
  check_paths();

  // What the network fills itself comes last in the operating point: relay states, then weights.
  std::vector<std::string> own;
  for (auto const& relay : relays_) own.push_back(network_.channels_[std::size_t(relay.relay.state_channel)]);
  for (auto const& average : network_.averages_)
    for (int c : average.weight_channels) own.push_back(network_.channels_[std::size_t(c)]);
  std::vector<std::string> ordered;
  for (auto const& name : network_.channels_)
    if (std::find(own.begin(), own.end(), name) == own.end()) ordered.push_back(name);
  network_.external_channels_ = int(ordered.size());
  ordered.insert(ordered.end(), own.begin(), own.end());
  auto const renumber = [&](int old) {
    auto const& name = network_.channels_[std::size_t(old)];
    return int(std::find(ordered.begin(), ordered.end(), name) - ordered.begin());
  };
  for (auto& boundary : network_.boundaries_)
    for (auto& term : boundary.terms) term.channel = renumber(term.channel);
  for (auto& average : network_.averages_)
    if (average.from_channel >= 0) {
      average.from_channel = renumber(average.from_channel);
      average.to_channel = renumber(average.to_channel);
      for (int& c : average.weight_channels) c = renumber(c);
    }
  for (auto& pending : relays_) {
    pending.relay.measured = network_.index_of(pending.measured);
    pending.relay.reference = network_.index_of(pending.reference);
    pending.relay.state_channel = renumber(pending.relay.state_channel);
    if (pending.relay.enable_channel >= 0) pending.relay.enable_channel = renumber(pending.relay.enable_channel);
    network_.relays_.push_back(pending.relay);
  }
  for (auto& pending : groups_) {
    ElementGroup group{pending.law, {}, std::move(pending.coefficients), {}, std::move(pending.parts), pending.inside};
    group.ports.reserve(pending.ports.size());
    for (Port port : pending.ports) group.ports.push_back(network_.index_of(port));
    for (int c : pending.channels) group.inputs.push_back(renumber(c));
    pending = {};
    network_.groups_.push_back(std::move(group));
  }
  network_.channels_ = std::move(ordered);
  network_.build_pattern();
  network_.find_grids();
  groups_.clear();
  relays_.clear();
  Network result = std::move(network_);
  network_ = Network();
  return result;
}

/// Every body must reach a boundary through elements with more than one port, or its temperature never settles.
void NetworkBuilder::check_paths() const {
  int const boundaries = int(network_.boundaries_.size()), n = nodes();
  Partition partition(n + 1 + int(network_.averages_.size()));
  int const outside = n, first_average = n + 1;
  auto const index = [&](Port port) {
    if (port.kind == Port::Kind::node) return port.index;
    return port.kind == Port::Kind::boundary ? outside : first_average + port.index;
  };
  for (std::size_t a = 0; a < network_.averages_.size(); ++a)
    for (int node : network_.averages_[a].nodes) partition.join(first_average + int(a), node);
  for (auto const& group : groups_) {
    auto const p = std::size_t(group.law->ports());
    for (std::size_t e = 0; group.law->conservative() && e < group.parts.size(); ++e) {
      bool const open = group.law != law_of<Conductance>() || group.coefficients[e] > 0.0;
      for (std::size_t k = 1; open && k < p; ++k)
        partition.join(index(group.ports[e * p]), index(group.ports[e * p + k]));
    }
  }
  for (auto const& range : network_.ranges_)
    for (int node = range.first; node < range.first + range.count; ++node)
      if (!network_.signal_[std::size_t(node)] && partition.root(node) != partition.root(outside))
        throw InputError(fmt::format("the body '{}' has no path to {}: no joint or film leads heat out of it",
                                     network_.node_name(node), boundaries > 0 ? "any boundary" : "the ambient"));
}

}  // namespace thermotwin::thermal
