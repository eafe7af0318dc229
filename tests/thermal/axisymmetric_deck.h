#pragma once

#include <map>
#include <string>
#include <vector>

#include "thermal/material.h"

namespace thermotwin::thermal {

/// An axisymmetric CalculiX model of one or more materials on a grid of CAX8 elements (x = radius, y = axis), with θ in
/// kelvin from 0; its loads are added face by face, then steps run it.
class AxisymmetricDeck {
 public:
  enum class Face { low = 1, outer = 2, high = 3, inner = 4 };

  AxisymmetricDeck(std::vector<double> radii, std::vector<double> heights);

  /// Layers [from, to) along the axis are of this solid; the last word holds.
  void fill(int from, int to, Material const& material);
  /// q = h (0 − θ) or towards `sink`.
  void add_film(Face face, double low, double high, double coefficient, double sink = 0.0);
  /// [W/m²] into the face.
  void add_flux(Face face, double low, double high, double flux);
  /// [W/m³] in all of it.
  void add_source(double density) { source_ = density; }
  void hold(Face face, double temperature);
  /// The lower face keeps its height.
  void support() { supported_ = true; }

  /// Node nearest to (radius, height).
  [[nodiscard]] int node(double radius, double height) const;

  /// θ and, if supported, (u_r, u_z) of the asked nodes at rest.
  struct State {
    std::map<int, double> theta;
    std::map<int, double> growth;  ///< u_z [m]
  };
  [[nodiscard]] State steady(std::vector<int> const& nodes) const;
  /// θ of the asked nodes at each time (increasing), backward Euler in steps of `step`.
  [[nodiscard]] std::vector<std::map<int, double>> transient(std::vector<int> const& nodes, double step,
                                                             std::vector<double> const& times) const;

 private:
  [[nodiscard]] int id(int i, int j) const { return 1 + i + (2 * int(radii_.size()) - 1) * j; }
  [[nodiscard]] std::string model(std::vector<int> const& nodes) const;
  [[nodiscard]] std::string loads() const;
  template <class Visit>
  void for_elements(Face face, double low, double high, Visit visit) const;

  std::vector<double> radii_, heights_;
  std::vector<Material> layers_;
  std::string films_, fluxes_, held_;
  double source_ = 0.0;
  bool supported_ = false;
};

}  // namespace thermotwin::thermal
