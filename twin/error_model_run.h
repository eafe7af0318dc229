#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "models/feed_axis.h"
#include "output/dataset.h"
#include "twin/compensation/twin_observer.h"
#include "twin/diagnosis/measured_run.h"
#include "twin/machine.h"

namespace thermotwin::twin {

/// What a run was recorded as, before it is known what a model makes of it: readings [°C] and displacements in the
/// units of a data set, from the first reading on. Simulated or measured: a data set (.h5), a table (.csv), a
/// measurement file (.toml).
struct RecordedRun {
  std::string file;                     ///< for messages
  std::string machine;                  ///< name; empty where the data do not say
  output::Dataset shown;                ///< dead sensors and missing readings are NaN
  std::optional<output::Dataset> said;  ///< by the twin, in the same rows
  std::vector<std::string> remarks;
  std::optional<double> sampling{};          ///< that what it showed and what the twin says are means over [s]
  std::shared_ptr<MeasuredRun const> run{};  ///< its own rows, where there is a twin
  std::map<std::string, double> still{};     ///< sensors that never moved, and what they showed [°C]

  /// Of a model that reads these: one that never moved is taken to live in a place that did not, and that is told.
  void believe_still(std::vector<std::string> const& sensors);

  /// Of a run that an observer of this machine follows: InputError where it is of another one, whatever the names of
  /// sensors and inputs; a remark where it begins warm, and an observer of few sensors with the room.
  void admit_observer(std::string const& observed);
};

/// Means over `sampling` [s] where it is given. With a twin, what the machine says that is given the run's inputs.
/// InputError that names the file; for a `sampling` finer than the rows.
[[nodiscard]] RecordedRun read_recorded_run(std::filesystem::path const& path, std::optional<double> sampling,
                                            Machine const* twin = nullptr);

/// A run as error models see it, temperatures counted from the first row that has all of them.
struct ErrorModelRun {
  models::Batch batch;                        ///< as shown; error 0 where the run did not show it, else counted from
                                              ///< the first row that has it
  std::optional<models::Batch> said;          ///< by the twin, where there is one
  std::optional<Eigen::VectorXd> observed{};  ///< error that an observer tells, where there is one
  std::optional<models::AxisRecord> axis;     ///< where the error is a slope
  bool shown = true;                          ///< the run shows the error
  std::string unit, title;                    ///< of the error
  std::vector<double> zero;                   ///< what the sensors showed first, to 1 mK [°C]
  std::string fingerprint;
  std::vector<Eigen::Index> rows{};           ///< of the record
  std::vector<Eigen::Index> without_error{};  ///< rows of the batch in which the run does not show the error

  /// Row of the batch in which an error is 0, where the run shows one: the first that has it.
  [[nodiscard]] Eigen::Index first_with_error() const;

  /// What the twin errs by. There must be one.
  [[nodiscard]] models::Batch less_twin() const;
};

/// These sensors of a run, and its error: a displacement channel or "slope z". Rows that lack one of them are left out,
/// and a remark says so; those that lack the error only where it must be shown. The fingerprint is of the rows that
/// have all of them, as a fit sees them. InputError with the nearest name for a sensor that the run does not have, or
/// that is dead; for the error too where it must be shown.
[[nodiscard]] ErrorModelRun error_model_run(RecordedRun& run, std::vector<std::string> const& sensors,
                                            std::string const& error, bool must_show);

/// The error that an observer tells in the rows of a run that was read with a twin, counted from the first of them.
/// InputError that names the run; std::invalid_argument for a batch that no model would take (models::check).
[[nodiscard]] Eigen::VectorXd observed_change(TwinObserver const& observer, RecordedRun const& recorded,
                                              ErrorModelRun const& run);

}  // namespace thermotwin::twin
