#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "output/dataset.h"
#include "thermal/operating_point.h"
#include "twin/compensation/twin_observer.h"
#include "twin/diagnosis/measured_run.h"

namespace thermotwin::twin {

/// What an observer of rows so far apart [s] may believe: a reading errs by 0.1 K (noise, steps, and what a place
/// differs from its node), a node by one of three values. Whoever has runs takes the one that meets them best.
[[nodiscard]] std::vector<ObserverOptions> observer_choices(double interval);

/// "extended Kalman filter, nodes err by 0.0005 K in a second"
[[nodiscard]] std::string text_of(ObserverOptions const& options);

/// What an observer says at every row of a recorded run [µm]: the machine is given the inputs of a course, which is at
/// `start` [s] where the rows' time is 0, and shows the readings of the rows [°C]. Between two rows the observer is
/// told the inputs at every longest step. InputError, with the nearest name, for an input that the course lacks.
[[nodiscard]] Eigen::VectorXd observed_error(TwinObserver observer, output::Dataset const& shown,
                                             thermal::Course const& course, double start);

/// The same of a measured run, in the rows of dataset_of(run, sampling): the observer follows the run's own rows from
/// the first reading on, and what it says is averaged over `sampling` [s] as what the run shows is. A mean is no
/// reading of the instant at which its stretch begins: it is of half of `sampling` later, and so is the error's. Where
/// the run has a past, or states its initial temperature, the observer begins where the twin is after it.
[[nodiscard]] Eigen::VectorXd observed_error(TwinObserver observer, MeasuredRun const& run,
                                             std::optional<double> sampling);

/// What is to be said of a measured run that an observer follows: that one of few sensors begins with the room, where
/// the run does not.
/// Empty otherwise.
[[nodiscard]] std::string observer_remark(MeasuredRun const& run);

}  // namespace thermotwin::twin
