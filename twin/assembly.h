#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "thermal/body.h"
#include "thermal/network.h"
#include "thermal/site.h"
#include "twin/description.h"

namespace thermotwin::twin {

/// A place on a body of the machine, as text in a file:
///
///   head                         the whole body
///   shaft[40 mm .. 80 mm]        a stretch along the axis of a bar, a cylinder or a channel
///   shaft[10 mm]                 a point on it
///   cartridge.outer[0 mm .. 40 mm]   a stretch of a face (faces: see `thermotwin describe machine`)
///   column.x_max[0 mm .. 200 mm, 100 mm .. 900 mm]   a rectangle on a block's face, from the block's corner
///   head[10 mm, 20 mm, 30 mm]    a point in a block; with `..` a box
struct Place {
  std::string text;
  thermal::Body const* body = nullptr;
  int first_node = 0;
  thermal::Site site;

  [[nodiscard]] double area() const;
  [[nodiscard]] Eigen::Vector3d centre() const;
};

/// The name of a place's body.
[[nodiscard]] std::string body_of(std::string const& place);

/// Whether two places have a stretch, a face or a lump in common, or are the same point. A body without a face means
/// its "surface", where it has one.
[[nodiscard]] bool have_in_common(Place const& a, Place const& b);

/// What a place's text means on its body.
[[nodiscard]] thermal::Site site_of(thermal::Body const& body, std::string const& text);

/// A term of a displacement channel that follows an input at once: coefficient · u[channel]^power.
struct InputTerm {
  std::string displacement;
  std::string channel;
  double coefficient = 0.0;
  double power = 1.0;
};

/// A term of a displacement channel that follows the mean temperature of a place: coefficient · (T(t) − T(0)). Of a
/// ball screw's error of position at x, (coefficient + strain · x) (T(t) − T(0)).
struct TemperatureTerm {
  std::string displacement;  ///< channel, or ball screw
  Place place;
  double coefficient = 0.0;  ///< [m/K] or [rad/K]
  double strain = 0.0;       ///< [1/K]
};

/// How the air at the machine departs from what the experiment says of the room: by a rise that follows an input, or
/// with height, at height z: rise · u[channel] + gradient · (z − reference_height).
struct AirTerm {
  std::string channel = {};
  double rise = 0.0;              ///< [K]
  double gradient = 0.0;          ///< [K/m]
  double reference_height = 0.0;  ///< [m]
};

/// What a part does to the reading of one instrument; of a ball screw, to all its errors of position.
struct ReadingTerm {
  std::string channel;      ///< sensor, displacement channel, or ball screw
  double drift = 0.0;       ///< [K/s] or [m/s], from the start of the run
  double lag = 0.0;         ///< of first order, besides the instrument's own [s]
  double air_share = 0.0;   ///< of the way from the body's temperature to that of the air [1]
  double per_air = 0.0;     ///< of a displacement, per kelvin of the air near the tool since the start [m/K]
  double air_strain = 0.0;  ///< of an error of position besides, per metre of it [1/K]
  bool of_displacement = false;
};

/// What the parts of a machine file are added to: the network while it is built, and the names of everything in it.
class Assembly {
 public:
  /// `up`: unit vector against gravity.
  Assembly(std::map<std::string, thermal::Body> const& bodies, std::vector<std::string> const& order,
           double maximum_spindle_speed, Eigen::Vector3d const& up = Eigen::Vector3d::UnitZ());

  [[nodiscard]] thermal::NetworkBuilder& network() { return builder_; }

  /// The part being added; its elements and its heat carry this number.
  [[nodiscard]] int part() const { return part_; }
  void begin_part(std::string const& name) { part_ = builder_.part(name); }

  /// Resolves a place; InputError that names the nearest body, or what else may stand there, or the faces that there
  /// are.
  [[nodiscard]] Place place(std::string const& text, std::vector<std::string> const& or_else = {}) const;
  /// The same, where heat passes a surface: a bar or a lump without a face means its "surface".
  [[nodiscard]] Place surface(std::string const& text) const;

  /// The temperature of a place: its node, or the weighted average of its nodes.
  [[nodiscard]] thermal::Port port(Place const& place);
  [[nodiscard]] thermal::Port port(std::string const& text) { return port(place(text)); }
  [[nodiscard]] thermal::Port node(Place const& place, int local) const;
  /// Air at the height of a point [m]: the room's, with what the parts add to it.
  [[nodiscard]] thermal::Port air(Eigen::Vector3d const& point);
  /// A boundary whose temperature is an input channel plus an offset [K].
  [[nodiscard]] thermal::Port boundary(std::string const& channel, double offset = 0.0);

  [[nodiscard]] int channel(std::string const& name) { return builder_.channel(name); }
  /// A speed over time, and the one at which friction is taken: of an axis, that of its screw while moving.
  [[nodiscard]] std::vector<int> friction_channels(std::string const& speed);
  void take_friction_while_moving(std::string const& axis) { friction_while_moving_.insert(axis); }
  /// The same for one that is between 0 and 1: a run must not give it in rpm.
  [[nodiscard]] int share(std::string const& name) { return builder_.share(name); }
  [[nodiscard]] double maximum_spindle_speed() const { return maximum_spindle_speed_; }
  /// At which the numbers of a part hold: its own, or the spindle's maximum [rad/s]. InputError if that is not above 0,
  /// unless the part acts by a channel of the spindle: one that the machine does not have never turns.
  [[nodiscard]] double rated_speed(std::optional<double> own, std::string const& channel = "spindle.speed") const;
  [[nodiscard]] thermal::Body const& body(std::string const& name, std::vector<std::string> const& or_else = {}) const;
  [[nodiscard]] int first_node(std::string const& name) const;

  /// InputError for a coefficient that is not finite; a run must give the channel that an input term follows.
  void displace(InputTerm term);
  void displace(TemperatureTerm term);
  void warm_air(AirTerm term) { air_terms_.push_back(std::move(term)); }
  /// Gives all boundaries of air what the parts add to them, whichever came first; once, when all parts are there.
  void add_air_terms();
  void misread(ReadingTerm term) { reading_terms_.push_back(std::move(term)); }
  [[nodiscard]] std::vector<ReadingTerm> const& reading_terms() const { return reading_terms_; }
  [[nodiscard]] std::vector<InputTerm> const& input_terms() const { return input_terms_; }
  [[nodiscard]] std::vector<TemperatureTerm> const& temperature_terms() const { return temperature_terms_; }

  /// What one part tells those after it: the ports and coefficients of a friction torque, for the motor that drives it.
  struct Torque {
    std::vector<thermal::Port> ports;
    std::vector<double> coefficients;
  };
  void announce(std::string const& part, Torque torque) { torques_[part] = std::move(torque); }
  [[nodiscard]] Torque const& torque_of(std::string const& part) const;

 private:
  thermal::NetworkBuilder builder_;
  std::map<std::string, thermal::Body> const& bodies_;
  std::map<std::string, int> first_nodes_;
  std::map<std::string, thermal::Port> averages_;
  std::map<double, thermal::Port> airs_;
  std::map<std::pair<std::string, double>, thermal::Port> boundaries_;
  std::map<std::string, Torque> torques_;
  std::vector<InputTerm> input_terms_;
  std::vector<TemperatureTerm> temperature_terms_;
  std::vector<ReadingTerm> reading_terms_;
  std::vector<AirTerm> air_terms_;
  double maximum_spindle_speed_ = 0.0;
  std::set<std::string> friction_while_moving_;  ///< axes
  Eigen::Vector3d up_;
  int part_ = 0;
};

}  // namespace thermotwin::twin
