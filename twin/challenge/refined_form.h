#pragma once

#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

#include "thermal/body.h"
#include "thermal/site.h"
#include "twin/file/value.h"

namespace thermotwin::twin {

/// The same machine as another form of network, with at least ten times the nodes of its file: what a measured machine
/// is to a lumped twin. Masses, areas of films and sources are those of the file; what differs is the form.
///
/// - Bars have five times the cells.
/// - A lump with a material and a mass that fills its box loosely is a block of that box and mass (solidity up to 0.8),
///   in cells. Other lumps (rings, fluids, small dense bodies) stay.
/// - Films act on the block's free faces, with the area of the file. Sensors sit on
///   them where they stand best for the block's mean.
/// - Joints meet blocks where they touch: faces, or the stretch of a bar within. Bodies that are drawn apart or inside
///   one another are joined by a plate without weight. A conductance from middle to middle is corrected for what the
///   blocks themselves resist now, so that the whole stays within 15 % of the file where that is possible.
/// - Segments of the structural loop keep their lengths; the mean temperature of the block drives them.
/// - Ranges of uncertain numbers are left out: this form has other numbers.
class RefinedForm {
 public:
  explicit RefinedForm(Value const& machine_document);

  [[nodiscard]] Value const& document() const { return document_; }

  /// A table that was written for the machine's file, as it acts on the other form; more than one where a plate is
  /// needed. Appends them to `document`.
  void append(Value& document, std::string const& kind, Value table) const;

  [[nodiscard]] bool is_block(std::string const& body) const {
    return solids_.contains(body) && solids_.at(body).block;
  }
  /// Box that a solid fills; empty for an unknown one.
  [[nodiscard]] Eigen::AlignedBox3d box(std::string const& body) const;
  /// "head.x_max", the largest first, without those that another body covers.
  [[nodiscard]] std::vector<std::string> free_faces(std::string const& block) const;

 private:
  struct Solid {
    Eigen::AlignedBox3d box;
    bool block = false, bar = false;
  };
  void read_solids();
  void make_blocks();
  void make_cells();
  void stiffen_blocks();
  void refine_parts();
  void place_sensors();
  [[nodiscard]] std::string sensor_place(std::string const& block) const;
  void join(Value& document, std::string const& kind, Value table) const;
  void correct_conductance(Value& table, std::string const& from, std::string const& to) const;
  [[nodiscard]] std::string contact_place(std::string const& text, std::string const& other) const;
  [[nodiscard]] double own_resistance(std::string const& place) const;

  Value document_;
  int nominal_nodes_ = 0;
  std::map<std::string, Solid> solids_;
  std::map<std::string, thermal::Body> bodies_;  ///< of the refined form
};

[[nodiscard]] Value refined_form(Value const& machine_document);

/// Temperatures of a body's nodes about their mean [K/W] while it warms evenly: one watt comes in at the site by its
/// shares, and every node takes up its part by capacity.
[[nodiscard]] Eigen::VectorXd rise_about_mean(thermal::Body const& body, thermal::Site const& site);

/// From the surface of the site to the mean of its body, in that state [K/W]; 0 for a lump.
[[nodiscard]] double resistance_to_mean(thermal::Body const& body, thermal::Site const& site);

}  // namespace thermotwin::twin
