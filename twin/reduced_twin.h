#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "output/dataset.h"
#include "scenarios/course.h"
#include "scenarios/experiment.h"
#include "thermal/reduced_network.h"
#include "thermal/reduced_sums.h"
#include "thermal/reduction.h"
#include "twin/history.h"
#include "twin/machine.h"
#include "twin/training_experiments.h"

namespace thermotwin::twin {

/// How far a reduced run may be from the full one.
struct ReducedError {
  std::vector<double> readings;   ///< per sensor [K]
  Eigen::VectorXd displacements;  ///< per channel of displacement [um, urad]

  [[nodiscard]] double largest_reading() const;
  [[nodiscard]] double largest_displacement() const;
};

struct ReducedResult {
  output::Dataset
      dataset;  ///< as of a full run, without heat and node temperatures; the largest bounds are in its provenance
  ReducedError bound;
  long steps = 0, rate_evaluations = 0;
};

/// A machine through a reduced model of its network (thermal/reduction.h), for campaigns and for real time: what
/// conducts is projected, frictions and losses stay exact, films are sampled.
///
/// Every run is made twice: with four fifths of the shapes and ten times the tolerance in time, so that both errors
/// show in the difference, and with all of them. The result is the finer one, and
///
///   bound = 2 max_t |fine − coarse| + error of the fine model in the training runs + what one coarse step may err by
///
/// for every channel, but for errors of position along a screw, of which only the first is known: an estimate, no
/// proof. It holds if the finer model errs no more than twice what they differ (saturation; Hain, Ohlberger, Radic &
/// Urban, Adv. Comput. Math. 45 (2019) 2155); tests and docs/reduced_model.md compare it with full runs.
///
/// Refuses, with InputError that names channel, value and range, whatever lies outside the range for which it was made.
class ReducedTwin {
 public:
  /// `kept`: folder of a ReductionStore, in which the shapes are looked for, and left when they had to be found;
  /// `progress` is told before they are, which takes long.
  explicit ReducedTwin(Machine const& machine, ReducedRange const& range = {},
                       std::optional<std::filesystem::path> const& kept = {},
                       std::function<void(std::string const&)> const& progress = {});

  /// InputError of check_temperature (twin/run.h) for the middle of any body at any time that is shown.
  [[nodiscard]] ReducedResult run(scenarios::Experiment const& experiment) const;

  [[nodiscard]] Machine const& machine() const { return *machine_; }
  [[nodiscard]] thermal::ReducedNetwork const& network() const { return fine_->network; }
  [[nodiscard]] thermal::ReducedNetwork const& coarse_network() const { return coarse_->network; }

  /// Lowest and highest value of an input of the network.
  struct Limits {
    double low = 0.0, high = 0.0;
  };
  [[nodiscard]] std::vector<Limits> const& limits() const { return limits_; }
  /// InputError when an input lies outside its limits.
  void check_inputs(std::vector<double> const& input) const;

 private:
  /// One of the two models, with what the machine's instruments see.
  struct Model {
    Model(Machine const& machine, thermal::LinearPart const& linear, thermal::Subspace const& subspace);
    thermal::ReducedNetwork network;
    thermal::ReducedSums sums;
    thermal::ReducedSums middles;  ///< of every body, its middle node
  };
  [[nodiscard]] History history_of(Model const& model, scenarios::Experiment const& experiment,
                                   scenarios::ExperimentCourse const& course, double tolerance,
                                   ReducedResult& result) const;

  Machine const* machine_;
  std::vector<Limits> limits_;
  std::vector<std::string> units_;  ///< in which people see each input
  Limits initial_;                  ///< of the machine's temperature at the start [K]
  ReducedError least_error_;
  std::unique_ptr<Model const> fine_, coarse_;
};

}  // namespace thermotwin::twin
