#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "twin/diagnosis/measured_run.h"
#include "twin/diagnosis/noise_model.h"

namespace thermotwin::twin {

/// One step of the twin's linearisation; none crosses a jump of the input. A row's prediction is the sum over its steps
/// of `at_begin` times the value at the begin and `at_end` times that at the end: the mean over the row's samples, each
/// interpolated in its step.
struct BinStep {
  double begin = 0.0, end = 0.0;  ///< [s]
  int row = 0;
  double at_begin = 0.0, at_end = 0.0;
};

/// A measured run averaged to rows of some minutes, none of which crosses a jump of the input, or of what may have been
/// given instead. What differs within such a row is noise; and a row in place of its samples makes a diagnosis ten
/// times as fast.
struct BinnedRun {
  MeasuredRun const* run = nullptr;
  std::vector<BinStep> steps;
  Eigen::VectorXd time;     ///< mean time of the samples of each row [s]
  Eigen::MatrixXd values;   ///< row × channel of the run [SI]; NaN: no sample
  Eigen::MatrixXd samples;  ///< how many were averaged
};

/// Rows of at most `interval` [s]. Steps grow from `first_step` after each jump, up to the row's length.
[[nodiscard]] BinnedRun bin(MeasuredRun const& run, double interval, double first_step = 20.0);

/// Of the noise that a channel, by its number in the run, has there.
[[nodiscard]] Whitening whitening_of(ChannelNoise const& noise, BinnedRun const& run, Eigen::Index channel);

/// Names of the channels that any of the runs has, in the order in which they come.
[[nodiscard]] std::vector<std::string> channels_of(std::vector<BinnedRun> const& runs);

/// The interval that gives a run at most `rows` rows, and each at least one sample; at least five minutes unless the
/// run is short.
[[nodiscard]] double fitting_interval(MeasuredRun const& run, int rows = 250);

}  // namespace thermotwin::twin
