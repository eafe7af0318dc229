#include "twin/input_range.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <vector>

namespace thermotwin::twin {
namespace {

constexpr double tolerated_share = 0.1;      ///< of its width, beyond a range
constexpr double coarsest_resolution = 0.5;  ///< [K] of sensors on machines: a DS18B20 of nine bits
constexpr double round_off = 1e-9;           ///< [K] between the same readings

double to_millikelvin(double change) { return std::round(1e3 * change) / 1e3; }

}  // namespace

bool InputRange::left_by(double change, double step) const {
  double const tolerated =
      std::max(tolerated_share * (highest - lowest), (1.0 + tolerated_share) * step);  // readings are rounded
  return change < lowest - tolerated || change > highest + tolerated;
}

std::vector<InputRange> input_ranges(std::vector<models::Batch> const& batches) {
  std::vector<InputRange> ranges(std::size_t(batches.front().temperature_rise.cols()), {INFINITY, -INFINITY});
  for (auto const& batch : batches)
    for (std::size_t j = 0; j < ranges.size(); ++j) {
      auto const changes = batch.temperature_rise.col(Eigen::Index(j));
      ranges[j].lowest = std::min(ranges[j].lowest, to_millikelvin(changes.minCoeff()));
      ranges[j].highest = std::max(ranges[j].highest, to_millikelvin(changes.maxCoeff()));
    }
  return ranges;
}

double reading_step(Eigen::VectorXd const& readings) {
  std::vector<double> sorted(readings.begin(), readings.end());
  std::sort(sorted.begin(), sorted.end());
  double step = INFINITY;
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (double const apart = sorted[i] - sorted[i - 1]; apart > round_off) step = std::min(step, apart);
  return step <= coarsest_resolution + round_off ? step : 0.0;
}

std::string range_left_text(std::string const& input, double change, InputRange const& range) {
  return fmt::format("{} changed by {:.2f} K; the model was fitted on changes of {:.2f} K to {:.2f} K", input, change,
                     range.lowest, range.highest);
}

}  // namespace thermotwin::twin
