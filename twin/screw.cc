#include "twin/screw.h"

#include <fmt/format.h>
#include <string>
#include <vector>

#include "thermal/body.h"
#include "thermal/material.h"

namespace thermotwin::twin {

std::string Screw::channel_at(double x) const { return fmt::format("{}_{:g}mm", description.name, x * 1e3); }

bool Screw::is_linear() const { return screw.support != thermal::BallScrew::Support::fixed_fixed || !screw.unilateral; }

NodeWeights Screw::weights_at(double x) const {
  NodeWeights weights;
  std::vector<double> rise(screw.edges.size() - 1, 0.0);
  double const by_seats = screw.position_error(x, rise, 1.0);
  for (std::size_t cell = 0; cell < rise.size(); ++cell) {
    rise[cell] = 1.0;
    weights.emplace_back(first_node + int(cell), screw.position_error(x, rise));
    rise[cell] = 0.0;
  }
  for (auto const& [node, growth] : seat_growth) weights.emplace_back(node, by_seats * growth);
  for (auto const& [node, strain] : reference_strain) weights.emplace_back(node, -x * strain);
  weights.insert(weights.end(), zero_shift.begin(), zero_shift.end());
  return weights;
}

Screw screw_of(BallScrewDescription const& d, Assembly const& assembly, Bodies const& bodies,
               StructuralLoop const& loop) {
  thermal::Body const& body = assembly.body(d.body);
  thermal::Material const& metal = bodies.metal_of(d.body);
  using Support = thermal::BallScrew::Support;
  thermal::BallScrew screw;
  screw.support = d.support == "fixed-free"    ? Support::fixed_free
                  : d.support == "fixed-fixed" ? Support::fixed_fixed
                                               : Support::fixed_supported;
  screw.expansion = d.growth_factor * metal.expansion;
  screw.section_area =
      body.capacities[0] / (metal.density * metal.specific_heat * (body.edges[0][1] - body.edges[0][0]));
  screw.youngs_modulus = d.youngs_modulus;
  screw.stiffness_fixed = d.stiffness_fixed;
  screw.stiffness_far = d.stiffness_far;
  screw.preload_temperature = d.preload_temperature;
  screw.unilateral = d.unilateral;
  screw.released_stiffness = d.released_stiffness;
  screw.edges = body.edges[0];
  Screw built{d, screw, {}, {}, {}, assembly.first_node(d.body)};
  auto const add = [&](NodeWeights& weights, std::string const& text, double length) {
    if (text.empty()) return;
    Place const place = assembly.place(text);
    add_growth(weights, place, length * loop.expansion_at(place, {}));
  };
  add(built.seat_growth, d.seats, screw.length());
  add(built.reference_strain, d.reference, 1.0);
  for (auto const& term : assembly.temperature_terms()) {
    if (term.displacement != d.name) continue;
    add_growth(built.zero_shift, term.place, term.coefficient);
    add_growth(built.reference_strain, term.place, -term.strain);
  }
  return built;
}

}  // namespace thermotwin::twin
