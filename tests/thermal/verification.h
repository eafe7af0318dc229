#pragma once

#include <cmath>
#include <vector>

#include "tests/thermal/function_course.h"
#include "thermal/body.h"
#include "thermal/integrate.h"
#include "thermal/material.h"
#include "thermal/site.h"

namespace thermotwin::thermal {

/// What the verification cases of physics.md §9 share: θ is counted from 20 °C.
inline constexpr double T0 = 293.15;

inline Material verification_steel() { return {"steel", 50.0, 0.0, 7850.0, 470.0, 0.0, 11.5e-6, 210e9, 0.3, 0.25}; }

inline IntegrationOptions tight(double tolerance = 1e-9) {
  IntegrationOptions options;
  options.relative_tolerance = options.absolute_tolerance = tolerance;
  return options;
}

/// Node temperatures at each time, from a uniform start.
inline std::vector<std::vector<double>> run(Network const& network, Course const& course, double start,
                                            std::vector<double> const& times, IntegrationOptions const& options) {
  std::vector<std::vector<double>> history;
  std::vector<double> const initial(std::size_t(network.nodes()), start);
  integrate(network, course, initial, times, options, [&](Sample const& s) {
    history.emplace_back(s.temperatures.begin(), s.temperatures.begin() + network.nodes());
  });
  return history;
}

/// A body in air with a thermostat between them: it switches by a temperature.
inline Network with_thermostat() {
  NetworkBuilder builder;
  int const part = builder.part("p");
  Port const body = builder.add_body("body", {100.0});
  Port const air = builder.add_boundary({"air", T0, {}});
  builder.connect(part, body, air, 1.0);
  builder.add_relay("thermostat", body, air, 1.0, 0.5);
  return builder.build();
}

/// What a site of the only body reads.
inline double reading(Site const& site, std::vector<double> const& temperatures) {
  double sum = 0.0;
  for (auto const& c : site.contacts) sum += c.share * temperatures[std::size_t(c.node)];
  return sum;
}

/// Film on every contact: A/(r + 1/h).
inline void add_film(NetworkBuilder& builder, int part, Site const& site, Port outside, double coefficient) {
  for (auto const& c : site.contacts)
    builder.connect(part, port_of(builder, site, c), outside, c.area / (c.half_resistance + 1.0 / coefficient));
}

/// The surface itself is held at the boundary's temperature.
inline void hold(NetworkBuilder& builder, int part, Site const& site, Port boundary) {
  for (auto const& c : site.contacts)
    builder.connect(part, port_of(builder, site, c), boundary, c.area / c.half_resistance);
}

/// log₂ of the ratio of errors on two meshes of which the second is twice as fine.
inline double order(double coarse, double fine) { return std::log2(std::abs(coarse / fine)); }

}  // namespace thermotwin::thermal
