#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenarios/recorded.h"

namespace thermotwin::scenarios {

/// An input channel as it was sampled [SI]; NaN: missing. Times increase strictly; with one value for each.
struct SampledInput {
  std::string name;  ///< of the channel
  std::string unit;  ///< SI
  std::vector<double> times;
  std::vector<double> values;
  bool absolute_temperature = false;        ///< a point on the scale, not a difference
  std::string interpolation = "automatic";  ///< "automatic", "linear" or "step"
  double average = 0.0;  ///< linear channels: one breakpoint per this time, the mean of its samples [s]
};

/// What is added to the numbers of such a column, once they are in SI; a temperature's is a difference. Throws
/// InputError.
[[nodiscard]] double offset_of(RecordedColumn const& column);

/// In which a row of units may state the numbers of a column whose unit is that of factor · number; empty: the factor
/// converts them.
[[nodiscard]] std::string unit_of_numbers(double factor, std::string const& unit);

/// The column of a table, as it is read there.
[[nodiscard]] SampledInput sampled_input(RecordedColumn const& column, std::vector<double> times,
                                         std::vector<double> numbers);

/// Whether it is a point on the temperature scale: its unit or its name says so.
[[nodiscard]] bool is_temperature(SampledInput const& input);

/// Whether rows come when something changes, besides those that come at regular times: of the rows that `changed`, from
/// 1 on, more than a third come at other intervals than rows mostly do.
[[nodiscard]] bool are_written_at_changes(std::vector<double> const& times, std::vector<std::size_t> const& changed);

/// Times of the samples that are not missing.
[[nodiscard]] std::vector<double> recorded_times(SampledInput const& input);

/// The channel with its course, missing samples left out.
///
/// Automatic: temperatures, positions and clocks go along straight lines; speeds, feeds, shares and flags, and whatever
/// repeats its last value more often than not, is a programme and held until the next sample.
///
/// What is held may be noisy, and would jump at every sample. Unless more than half of the samples that are not
/// zero repeat the one before, or neighbours differ by more than noise does (by 10 % of the largest magnitude; by 2 %,
/// and those two apart by 1.7 times as much, or at times of their own; rows that repeat the one before do not count),
/// as where only changes are written down, a sample belongs to the running block while it is within max(2 % of the
/// channel's largest magnitude, 5 σ) of the block's mean, which is then the block's value; σ = 1.05 median |Δ| of
/// neighbours. A noisy block stands still, 0, where its mean is below 0.2 % of the largest, or below 2 % and its
/// samples are noise about zero. Temperatures that go along straight lines are smoothed (noisy_record.h): a sensor that
/// lags would explain away the noise of what it is held against.
///
/// Where "linear" or "step" is stated, every sample is taken at its word.
///
/// Throws InputError when no sample is finite.
DrivenChannel driven_channel(SampledInput const& input);

/// How often a channel changes that is held until its next sample.
struct HeldChanges {
  std::size_t count = 0;
  bool averaged = false;  ///< what neighbours differ by was taken for noise
};

/// As driven_channel reads it; nothing where it goes along straight lines, or has no sample.
[[nodiscard]] std::optional<HeldChanges> held_changes(SampledInput const& input);

}  // namespace thermotwin::scenarios
