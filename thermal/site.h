#pragma once

#include <string>
#include <vector>

#include "thermal/body.h"

namespace thermotwin::thermal {

/// What a site takes of one node.
struct Contact {
  int node = 0;                  ///< of the body, from 0
  double share = 0.0;            ///< of the site, Σ = 1
  double area = 0.0;             ///< [m²]; 0 where the site has no area
  double half_resistance = 0.0;  ///< from the node to the surface [m² K/W]
  Eigen::Vector3d centre{0.0, 0.0, 0.0};
  double low = 0.0, high = 0.0;                   ///< interval along the body's axis [m]
  double inner_radius = 0.0, outer_radius = 0.0;  ///< of an end face [m]
  Eigen::AlignedBox3d box;                        ///< of a block: the part of the cell or of its face [m]

  /// From the node to the surface [K/W].
  [[nodiscard]] double resistance() const { return area > 0.0 ? half_resistance / area : 0.0; }
  /// What the node has of a conductance to the site's surface, in series with the way there [W/K].
  [[nodiscard]] double in_series(double conductance) const {
    return conductance * share / (1.0 + conductance * share * resistance());
  }
};

/// A place on or in a body where something acts or is measured: nodes with shares that add up to 1. A heat source, a
/// film, a joint and a sensor all speak of sites; none of them asks for "the nearest node".
struct Site {
  enum class Kind { lump, axial, end, plane, volume };

  std::string body;
  std::string place;  ///< for messages: "face 'outer' from 0.1 to 0.2 m"
  Kind kind = Kind::lump;
  Eigen::Vector3d origin{0.0, 0.0, 0.0}, axis{0.0, 0.0, 1.0};  ///< of axial and end sites
  Eigen::Vector3d normal{0.0, 0.0, 0.0};                       ///< of plane and end sites
  std::vector<Contact> contacts;

  [[nodiscard]] double area() const;
};

/// All cells, by volume; without area.
[[nodiscard]] Site whole(Body const& body);

/// A face, by area.
[[nodiscard]] Site face(Body const& body, std::string const& name);

/// The part of a bar's, cylinder's or channel's mantle between two positions along its axis [m]. Cells that are cut
/// count by the length inside.
[[nodiscard]] Site face(Body const& body, std::string const& name, double from, double to);

/// The part of a block's face inside a box of machine coordinates [m]; across the face the box says nothing. Cells that
/// are cut count by the area inside.
[[nodiscard]] Site face(Body const& body, std::string const& name, Eigen::AlignedBox3d const& box);

/// The part of a block inside a box of machine coordinates [m], by volume; without area.
[[nodiscard]] Site region(Body const& body, Eigen::AlignedBox3d const& box);

/// One point of machine coordinates [m]: linear interpolation between the nodes along each direction of the grid,
/// constant beyond the outermost nodes. InputError outside the body (by more than 1 µm).
[[nodiscard]] Site point(Body const& body, Eigen::Vector3d const& position);

/// The circle of a bar's or cylinder's mantle at a position along the axis [m]: linear interpolation between the nodes,
/// constant beyond the outermost ones.
[[nodiscard]] Site ring(Body const& body, std::string const& face_name, double position);

/// The same nodes and shares with a total area of `area` [m²]: a lump's face, or where the drawn face is not the true
/// one.
[[nodiscard]] Site with_area(Site site, double area);

/// The port of a contact; the site's body is already in the builder.
[[nodiscard]] Port port_of(NetworkBuilder const& builder, Site const& site, Contact const& contact);

/// One port for the whole site: its node, or the average of its nodes.
[[nodiscard]] Port port_of(NetworkBuilder& builder, Site const& site);

}  // namespace thermotwin::thermal
