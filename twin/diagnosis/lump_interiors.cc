#include "twin/diagnosis/lump_interiors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

#include "thermal/bounding_box.h"
#include "twin/bodies.h"
#include "twin/diagnosis/linearised_run.h"
#include "twin/file/document.h"

namespace thermotwin::twin {
namespace {

constexpr double pi_squared = std::numbers::pi * std::numbers::pi;
constexpr double share = pi_squared / (3.0 + pi_squared);  // s
constexpr double next_to_nothing = 1e-5, amount_step = 1e-3;

std::string name_of_inside(std::string const& lump) { return "inside of " + lump; }

}  // namespace

std::vector<LumpInteriors::Interior> LumpInteriors::interiors_of(Value const& document) {
  Tables tables(document);
  Bodies const bodies(tables);
  Value copy = document;
  std::vector<Interior> interiors;
  for (auto const* table : tables_of(copy, "lump")) {
    Interior interior{.lump = name_in(*table)};
    auto const* material = bodies.material_of(interior.lump);
    if (!material || !table->find("mass") || !table->find("size")) continue;
    auto const& body = bodies.all().at(interior.lump);
    double const length = std::cbrt(thermal::bounding_box(body.cells).volume());
    double const time = length * length / (pi_squared * thermal::diffusivity(*material));
    interior.heat_capacity = share * body.capacities[0];
    interior.conductance = interior.heat_capacity * (1.0 - share) / time;
    interiors.push_back(interior);
  }
  return interiors;
}

LumpInteriors::LumpInteriors(Value const& document)
    : interiors_(interiors_of(document)),
      machine_(machine_with(document, std::vector<double>(interiors_.size(), next_to_nothing))) {
  auto const& network = machine_.network();
  std::vector<double> amounts(interiors_.size(), next_to_nothing);
  for (std::size_t i = 0; i < interiors_.size(); ++i) {
    auto& interior = interiors_[i];
    interior.node = network.range(interior.lump).first;
    interior.interior_node = network.range("extra mass '" + name_of_inside(interior.lump) + "'").first;
    amounts[i] = next_to_nothing + 2.0 * amount_step;
    derivatives_.push_back(thermal::difference(machine_with(document, amounts).network(), network, amount_step));
    amounts[i] = next_to_nothing;
    add_unknowns(i);
  }
}

/// As much of each interior, from 0, the lump of the file, to 1.
Machine LumpInteriors::machine_with(Value document, std::vector<double> const& amounts) const {
  for (std::size_t i = 0; i < interiors_.size(); ++i) {
    auto const& [lump, heat_capacity, conductance, node, interior_node] = interiors_[i];
    for (auto* table : tables_of(document, "lump"))
      if (name_in(*table) == lump) {
        double const mass = number_in(*table, "mass", dimension::mass).value();
        set_key(*table, "mass", thermal::format_quantity(mass * (1.0 - amounts[i] * share), dimension::mass));
      }
    append_table(document, "extra_mass",
                 make_table({document.where.file, 1'000'000, 1},
                            {{"name", name_of_inside(lump)},
                             {"at", lump},
                             {"heat_capacity", fmt::format("{:.17g} J/K", amounts[i] * heat_capacity)},
                             {"conductance", fmt::format("{:.17g} W/K", amounts[i] * conductance)}}));
  }
  return Machine::build(document);
}

void LumpInteriors::add_unknowns(std::size_t interior) {
  auto const& lump = interiors_[interior].lump;
  unknowns_.push_back({Unknown::Kind::heat, name_of_inside(lump), interior, ""});
  auto const has_weight = [at = interiors_[interior].node](auto const& entry) {
    return std::any_of(entry.weights.begin(), entry.weights.end(), [&](auto const& w) { return w.first == at; });
  };
  if (std::any_of(machine_.linear_channels.begin(), machine_.linear_channels.end(), has_weight))
    unknowns_.push_back({Unknown::Kind::growth, "growth of " + lump, interior, ""});
  for (auto const& sensor : machine_.sensors) {
    auto const& name = sensor.description.name;
    if (has_weight(sensor))
      unknowns_.push_back({Unknown::Kind::reading, fmt::format("{} within {}", name, lump), interior, name});
  }
}

/// The mean of lump and interior in place of the lump.
Machine LumpInteriors::seeing_means(Unknown const& unknown) const {
  auto const& interior = interiors_[unknown.interior];
  auto const move = [&](NodeWeights& weights) {
    for (std::size_t w = 0, count = weights.size(); w < count; ++w) {
      if (weights[w].first != interior.node) continue;
      double const moved = share * weights[w].second;
      weights[w].second -= moved;
      weights.emplace_back(interior.interior_node, moved);
    }
  };
  Machine machine = machine_;
  if (unknown.kind == Unknown::Kind::growth)
    for (auto& displacement : machine.linear_channels) move(displacement.weights);
  for (auto& sensor : machine.sensors)
    if (sensor.description.name == unknown.sensor) move(sensor.weights);
  return machine;
}

Eigen::MatrixXd LumpInteriors::responses(BinnedRun const& run) const {
  if (unknowns_.empty()) return {};
  std::vector<thermal::NetworkDerivative const*> pointers;
  for (auto const& derivative : derivatives_) pointers.push_back(&derivative);
  LinearisedRun const twin(machine_, run);
  Eigen::MatrixXd const heated = twin.response(thermal::ParameterColumns(machine_.network(), pointers));
  Eigen::VectorXd const prediction = twin.prediction().reshaped();
  Eigen::MatrixXd responses(run.values.size(), Eigen::Index(unknowns_.size()));
  for (std::size_t u = 0; u < unknowns_.size(); ++u) {
    auto const& unknown = unknowns_[u];
    auto column = responses.col(Eigen::Index(u));
    if (unknown.kind == Unknown::Kind::heat)
      column = heated.col(Eigen::Index(unknown.interior));
    else
      column = twin.prediction_of(seeing_means(unknown)).reshaped() - prediction;
  }
  return responses;
}

}  // namespace thermotwin::twin
