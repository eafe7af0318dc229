#pragma once

#include <map>
#include <string>
#include <vector>

#include "thermal/body.h"
#include "thermal/material.h"
#include "twin/description.h"
#include "twin/file/tables.h"

namespace thermotwin::twin {

/// Of a machine, in all: at up to 1 KiB each (docs/performance.md) they take 10 GB of memory.
inline constexpr double most_cells = 1e7;

/// The bodies of a machine file, discretised, and what they are made of.
class Bodies {
 public:
  explicit Bodies(Tables& tables);

  [[nodiscard]] std::map<std::string, thermal::Body> const& all() const { return bodies_; }
  /// In the order in which their nodes are numbered: lumps, bars, cylinders, blocks, channels, each as in the file.
  [[nodiscard]] std::vector<std::string> const& order() const { return order_; }
  [[nodiscard]] std::vector<Tabled<ChannelDescription>> const& channels() const { return channels_; }
  /// Who carries a solid, or nullptr for a fluid.
  [[nodiscard]] CarriedDescription const* carried(std::string const& body) const;
  /// What a body is made of; nullptr for a fluid, or a lump of given heat capacity.
  [[nodiscard]] thermal::Material const* material_of(std::string const& body) const;
  /// The same, where it must have one.
  [[nodiscard]] thermal::Material const& metal_of(std::string const& body) const;

 private:
  void read_materials(Tables& tables);
  void read_lumps(Tables& tables);
  void read_bars(Tables& tables);
  void read_cylinders(Tables& tables);
  void read_blocks(Tables& tables);
  void claim_cells(Value const& table, std::string const& name, double cells);
  void add(Value const& table, std::string const& name, thermal::Body body);
  void add_solid(Value const& table, std::string const& name, std::string const& material, thermal::Body body,
                 CarriedDescription const& carried);
  [[nodiscard]] thermal::Material const& material(std::string const& name) const;

  double cells_ = 0.0;  ///< claimed so far
  std::map<std::string, thermal::Material> materials_;
  std::map<std::string, thermal::Body> bodies_;
  std::map<std::string, std::string> material_names_;
  std::map<std::string, CarriedDescription> carried_;
  std::vector<std::string> order_;
  std::vector<Tabled<ChannelDescription>> channels_;
};

}  // namespace thermotwin::twin
