#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "twin/diagnosis/measured_run.h"
#include "twin/diagnosis/noise_model.h"

namespace thermotwin::twin {

/// One step of the twin's linearisation; none crosses a jump of the input.
struct BinStep {
  double begin = 0.0, end = 0.0;  ///< [s]
  int row = 0;

  [[nodiscard]] double length() const { return end - begin; }
};

/// A channel's samples in one step. The prediction of a row is the mean over the samples that the channel has there,
/// each interpolated in its step by Hermite's cubic: `at_begin` and `at_end` times the values there, and
/// `bend_at_begin` and `bend_at_end` times the slopes there beyond that of the straight line.
struct StepReadings {
  double at_begin = 0.0, at_end = 0.0;
  double bend_at_begin = 0.0, bend_at_end = 0.0;  ///< [s]
  std::vector<double> samples = {};               ///< [s after the step's begin]
  double share = 0.0;                             ///< of each in the row's mean
};

/// A measured run averaged to rows of some minutes, none of which crosses a jump of the input, or of what may have been
/// given instead. What differs within such a row is noise; and a row in place of its samples makes a diagnosis ten
/// times as fast. Samples that may have been taken between a change of the input and the sample that shows it are left
/// out. A channel that was read at some of a row's times only, as by a slower logger, is held against the twin at
/// these.
struct BinnedRun {
  MeasuredRun const* run = nullptr;
  std::vector<BinStep> steps;
  /// Of every channel of the run, in every step; at all times of a row where it was not read in that.
  std::vector<std::vector<StepReadings>> readings;
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
