#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "scenarios/machine_limits.h"
#include "thermal/geometry.h"
#include "thermal/growth_field.h"
#include "thermal/network.h"
#include "twin/assembly.h"
#include "twin/description.h"
#include "twin/effect.h"
#include "twin/instruments/displacement_probe.h"
#include "twin/instruments/five_probe_nest.h"
#include "twin/instruments/laser_interferometer.h"
#include "twin/instruments/temperature_sensor.h"
#include "twin/screw.h"
#include "twin/structural_loop.h"

namespace thermotwin::twin {

/// `[[temperature_sensor]]`: an instrument at a place, or at a mean of several.
struct SensorDescription : TemperatureSensor {
  std::string name, title;
  std::vector<std::string> at;
  std::vector<double> shares;
  std::string component;

  /// Of a place in what it reads.
  [[nodiscard]] double share(std::size_t place) const {
    return shares.empty() ? 1.0 / double(at.size()) : shares[place];
  }

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &SensorDescription::name, "of the channel: T1");
    f("title", &SensorDescription::title, "one line for people");
    f("at", &SensorDescription::at,
      "place on a body; several: their mean; on a face: what is half a cell below it; \"ambient\": room air at 1 m");
    f("shares", &SensorDescription::shares, dimension::dimensionless,
      "of each place in what it reads, sum 1; default: equal; below 0: farther from there than the others are");
    f("component", &SensorDescription::component, "group that it belongs to when sensors are selected");
    TemperatureSensor::fields(f);
  }
};

/// `[[displacement_probe]]`: measures one channel of displacement.
struct ProbeDescription : DisplacementProbe {
  std::string name, of;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &ProbeDescription::name, "of the probe");
    f.name("of", &ProbeDescription::of, "displacement that it measures");
    DisplacementProbe::fields(f);
  }
};

/// A sensor as built: what it sees.
struct Sensor {
  SensorDescription description;
  NodeWeights weights;                      ///< Σ = 1; empty: it hangs in the air
  Eigen::Vector3d position{0.0, 0.0, 0.0};  ///< [m]
};

/// A machine: what its file describes, ready to run. Built whole and never changed; threads share it.
class Machine {
 public:
  /// Reads a machine file. FileError names file, line, column, value and what is allowed.
  static Machine read(std::filesystem::path const& path);
  /// From a document that was read (and perhaps changed by set_parameter).
  static Machine build(Value const& document);

  std::string name, title;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< against gravity
  scenarios::MachineLimits limits;
  thermal::Geometry geometry;
  std::vector<thermal::GrowingBody> growing;  ///< the solids, for the displacements that fields show
  std::vector<Sensor> sensors;
  std::vector<Displacement> displacements;
  std::vector<Screw> screws;
  /// The displacements, and the errors of position at the screws' positions, where they are linear.
  std::vector<Displacement> linear_channels;
  std::vector<ProbeDescription> probes;
  std::vector<ReadingTerm> reading_terms;  ///< those of a ball screw for each of its positions
  std::optional<FiveProbeNest> nest;
  LaserInterferometer laser;

  [[nodiscard]] thermal::Network const& network() const { return *network_; }

 private:
  friend class MachineBuilder;
  Machine() = default;
  std::shared_ptr<thermal::Network const> network_;
};

/// The file of a machine: a path, or the name of one in twin/machines. InputError that names the nearest one.
[[nodiscard]] std::filesystem::path machine_file(std::string const& name_or_path);

}  // namespace thermotwin::twin
