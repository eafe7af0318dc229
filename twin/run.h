#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "output/dataset.h"
#include "scenarios/course.h"
#include "scenarios/experiment.h"
#include "thermal/integrate.h"
#include "twin/extrapolation_watch.h"
#include "twin/machine.h"

namespace thermotwin::twin {

/// The user stopped a run; what was computed is in the partial file that the message names.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Of a run's tolerance, as users give it.
inline constexpr double finest_tolerance = 1e-12, coarsest_tolerance = 0.01;

/// Beyond it no material of a machine is solid (steel melts near 1800 K), and no law of the twin holds [K].
inline constexpr double hottest_temperature = 2000.0;

/// InputError that names node, temperature and time for one below 0 K, beyond `hottest_temperature`, or no number. A
/// controller's state is no temperature.
void check_temperature(thermal::Network const& network, int node, double temperature, double time);

/// How a run is carried out and what it leaves behind.
struct RunOptions {
  thermal::IntegrationOptions integration;
  bool in_modes = false;                          ///< without heat balance and checkpoint (thermal/modal_integration.h)
  bool watch_ranges = false;                      ///< tell of correlations beyond their ranges
  std::optional<std::filesystem::path> dataset;   ///< HDF5 file
  std::optional<std::filesystem::path> fields;    ///< folder of the VTK series
  std::optional<std::filesystem::path> picture;   ///< PNG of the last frame
  double field_interval = 900.0;                  ///< between two frames [s]
  bool node_temperatures = false;                 ///< keep every node's course in the data set
  std::map<std::string, std::string> provenance;  ///< echo of the input files and the command
  /// File from which a killed run can be taken up; it goes when the run is done. InputError when there is one already
  /// and `resume` is not asked for, or when it is of another run.
  std::optional<std::filesystem::path> checkpoint;
  bool resume = false;  ///< go on from the checkpoint, if there is one
  /// The integrator starts anew at the first output time after each multiple of this [s], whether a checkpoint is
  /// written or not: a run that is taken up there gives the same bytes. 0: never.
  double checkpoint_interval = 0.0;
  /// Called now and then with the share done, 0…1.
  std::function<void(double)> progress;
  /// Set from outside (Ctrl-C) to stop at the next output time; the data set is then marked as partial.
  std::atomic<bool> const* stop = nullptr;
};

struct RunResult {
  output::Dataset dataset;
  thermal::IntegrationSummary summary;
  std::vector<double> jumps;               ///< of the inputs, in order [s]
  std::vector<Extrapolated> extrapolated;  ///< if it was asked for
};

/// How far a run's heat balance may be open: a thousand times what it is with the numbers of any shipped machine; and
/// what rounding leaves open where hardly any heat moves, 1e-7 J, a hundred times over [J].
inline constexpr double largest_imbalance = 1e-9, least_gap = 1e-5;

/// What is odd about a run's heat balance; empty: nothing.
[[nodiscard]] std::string balance_remark(thermal::IntegrationSummary const& summary);

/// Runs an experiment on a machine: temperatures, displacements, instruments, fields. InputError of check_temperature
/// for any node at any time that is shown.
[[nodiscard]] RunResult run(Machine const& machine, scenarios::Experiment const& experiment, RunOptions const& options);

/// What a run's data set says before it has a row: title ("v450: golden run B"; of an experiment without a title the
/// name of the machine), channels, and where it comes from.
[[nodiscard]] output::Dataset head_of_run(Machine const& machine, scenarios::Experiment const& experiment,
                                          scenarios::ExperimentCourse const& course);

/// The inputs of a course as a data set shows them, without their values: names, units of the edge, descriptions.
[[nodiscard]] std::vector<output::Channel> input_channels(scenarios::ExperimentCourse const& course);

/// Temperatures of all nodes at the start: as the experiment says, or the air around each.
[[nodiscard]] std::vector<double> initial_temperatures(Machine const& machine, scenarios::Experiment const& experiment,
                                                       thermal::Course const& course);

}  // namespace thermotwin::twin
