#pragma once

#include <string>
#include <vector>

#include "twin/diagnosis/amended_file.h"
#include "twin/diagnosis/estimation.h"

namespace thermotwin::twin {

/// Two-sided 95 % of a normal distribution, in standard deviations.
inline constexpr double two_sided_95 = 1.96;

/// The usual unit in which a value has few digits before the point; empty for a number without dimension.
[[nodiscard]] std::string readable_unit(double si, thermal::Dimension dimension);

/// "61.4823 W/K": as it stands in a file that people go on editing, six digits, or as many as are asked for.
[[nodiscard]] std::string written_value(double si, std::string const& unit, int digits = 6);

/// Half of the 95 % interval, two digits: "± 4.1 W/K".
[[nodiscard]] std::string written_interval(double standard_error, std::string const& unit);

/// A number of the file where its unknown is x ± `deviation`, with its interval as comment.
[[nodiscard]] ChangedValue changed_value(UncertainNumber const& number, double x, double deviation);

/// All numbers of the file at a fit.
[[nodiscard]] std::vector<ChangedValue> changed_numbers(Estimation const& estimation, Fit const& fit);
/// The lags of all sensors that have any of the channels.
[[nodiscard]] std::vector<ChangedValue> changed_lags(Estimation const& estimation, Fit const& fit);

}  // namespace thermotwin::twin
