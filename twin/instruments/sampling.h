#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "thermal/operating_point.h"
#include "twin/instruments/readings.h"

namespace thermotwin::twin {

/// Which of the sample times the instrument serves: those that pass an instant t₀ + m Δ of its own clock; Δ = 0: all.
std::vector<bool> due(Eigen::VectorXd const& sample_times, double interval);

/// When a machine must be seen for its instruments to show it right: at the sample times and, since what lags or
/// averages answers what happens between two of them, where an input jumps or bends, every few seconds after that, and
/// then ever less often, down to once a minute.
std::vector<double> looks(std::span<double const> sample_times, thermal::Course const& course);

/// Sets readings to NaN, each with probability `dropout`, and all from `dead_from` on.
void drop_out(Eigen::VectorXd& values, Eigen::VectorXd const& sample_times, InstrumentChannel const& channel,
              double dropout, double dead_from);

/// Quant(x) = q round(x/q); x itself for q = 0.
double quantised(double x, double resolution);

}  // namespace thermotwin::twin
