#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace thermotwin::output {

/// One recorded course over the data set's time axis; a missing sample is NaN.
struct Channel {
  std::string name;       ///< unique within its group: "T1", "E_Z", "spindle.speed"
  std::string unit;       ///< of the stored numbers: "degC", "um", "urad", "rpm", "W"
  std::string long_name;  ///< one line for people
  Eigen::VectorXd values;
};

/// What the laser saw: error of position along an axis, per target, time and direction of approach.
struct Positioning {
  std::string axis;             ///< "z"
  Eigen::VectorXd position_mm;  ///< targets
  Eigen::VectorXd time_s;       ///< one per pass
  Eigen::MatrixXd forward_um;   ///< time × position
  Eigen::MatrixXd backward_um;  ///< time × position
};

/// A run, simulated or measured: the same type, so that whatever works on one works on the other.
///
/// A simulated one carries `truth_*` besides: noise-free readings, displacements, heat of every source, and nodal
/// temperatures when asked. Times in seconds from the start, strictly increasing. Units are those of the edges
/// (°C, µm, rpm), because this is an edge.
struct Dataset {
  std::string title;
  Eigen::VectorXd time_s;
  std::vector<Channel> inputs;
  std::vector<Channel> readings;       ///< temperature sensors
  std::vector<Channel> displacements;  ///< displacement and tilt channels
  std::vector<Positioning> positioning;

  std::vector<Channel> truth_readings;
  std::vector<Channel> truth_displacements;
  std::vector<Positioning> truth_positioning;
  std::vector<Channel> heat;                         ///< of every part that makes or takes heat [W]
  std::optional<Eigen::MatrixXf> node_temperatures;  ///< time × node [°C]
  std::vector<std::string> node_names;               ///< with node_temperatures

  std::map<std::string, std::string> provenance;  ///< echo of both input files, version, seed, solver summary, …
  bool complete = true;                           ///< false: the run was interrupted; rows up to time_s.size() are good
};

/// Throws thermal::InputError unless the data set is in order: every course as long as the time axis, times finite and
/// strictly increasing, names unique within their group, not empty, without '/' and not "time".
void check(Dataset const& dataset);

/// The channel of that name; null where there is none.
[[nodiscard]] Channel const* find_channel(std::vector<Channel> const& channels, std::string const& name);
[[nodiscard]] std::vector<std::string> names_of(std::vector<Channel> const& channels);

/// Cuts or lengthens the time axis and every course along it; what is added is not set.
void resize_rows(Dataset& dataset, Eigen::Index rows);

/// A course known at `own` times, at others: along straight lines; NaN outside.
[[nodiscard]] Eigen::VectorXd at_times(Eigen::VectorXd const& course, Eigen::VectorXd const& own,
                                       Eigen::VectorXd const& times);

}  // namespace thermotwin::output
