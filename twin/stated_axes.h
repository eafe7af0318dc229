#pragma once

#include <string>
#include <vector>

#include "scenarios/experiment.h"
#include "thermal/network.h"
#include "twin/assembly.h"
#include "twin/description.h"
#include "twin/file/tables.h"
#include "twin/screw.h"

namespace thermotwin::twin {

/// The linear axes that a machine's file states, [[axis]], and whether what else stands in it agrees: each mistake is a
/// FileError at its place.
class StatedAxes {
 public:
  explicit StatedAxes(Tables& tables);

  /// Their screws have no end yet.
  [[nodiscard]] std::vector<scenarios::AxisLimits> const& limits() const { return limits_; }
  /// The names of those whose friction is that of the speed while they move, not of the mean speed.
  [[nodiscard]] std::vector<std::string> const& with_friction_while_moving() const { return while_moving_; }

  /// A table's key 'axis' names one of them, unless none is stated.
  void check(Value const& table) const;
  /// The same of inputs: "X.speed" where the axis is 'x', and those of the axis that a part has where none is given.
  /// Any other may be an experiment's own.
  void check_inputs(thermal::Network const& network) const;
  /// A ball screw turns where the nuts of its axis run, and its positions are on it, each another.
  void check_screw(Value const& table, BallScrewDescription const& screw, Assembly const& assembly) const;
  /// A nut of a length is not longer than its screw.
  void check_nut(Value const& table, Assembly const& assembly) const;
  /// As limits(), with screws as long as the shortest bar of an axis' nuts and ball screws; the strokes are on them.
  [[nodiscard]] std::vector<scenarios::AxisLimits> limits_on_screws(std::vector<Screw> const& screws,
                                                                    Assembly const& assembly) const;

 private:
  [[nodiscard]] std::vector<std::string> names() const;
  [[nodiscard]] std::vector<std::string> bars_of_nuts(std::string const& axis) const;
  [[nodiscard]] Location place_without_axis() const;

  Tables const& tables_;
  std::vector<scenarios::AxisLimits> limits_;
  std::vector<std::string> while_moving_;
};

}  // namespace thermotwin::twin
