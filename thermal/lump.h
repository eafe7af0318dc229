#pragma once

#include <optional>

#include "thermal/body.h"

namespace thermotwin::thermal {

/// A body of one temperature: right where Bi = h L/k < 0.05 (physics.md 2.1) or where nothing better is known.
/// Its capacity is given, or mass × specific heat, or that of the drawn box full of the material.
struct Lump {
  Material material;
  std::optional<double> capacity;         ///< [J/K]
  std::optional<double> mass;             ///< [kg]
  double area = 0.0;                      ///< of the face "surface" [m²]; 0: every joint and film says its own
  Eigen::Vector3d corner{0.0, 0.0, 0.0};  ///< of the box that stands for it in the fields [m]
  Eigen::Vector3d size{0.0, 0.0, 0.0};
};

/// Face: "surface".
[[nodiscard]] Body make_body(std::string const& name, Lump const& lump);

}  // namespace thermotwin::thermal
