#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>

namespace thermotwin::twin {

/// Where the chance of an instrument comes from: the run's seed and the channel's name. Nothing else, so that adding,
/// removing or reordering channels changes no other channel's readings.
struct InstrumentChannel {
  std::string name;
  std::uint64_t seed = 1;
};

/// What an instrument showed, in the units of the edge (°C, µm), one value per sample time; NaN where there is none.
struct Readings {
  Eigen::VectorXd values;
  Eigen::VectorXd truth;                ///< what a perfect instrument at the same place would have shown
  std::map<std::string, double> drawn;  ///< the specimen's properties [SI], by the names of the fields
};

}  // namespace thermotwin::twin
