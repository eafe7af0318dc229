#pragma once

#include <cmath>
#include <cstddef>
#include <string>

namespace thermotwin::twin {

/// Of priors [K]: how far an offset of a temperature sensor is from none, and a machine's start from that of its
/// record.
inline constexpr double offset_deviation = 0.3, start_deviation = 0.3;

/// What is estimated from the data, with its prior N(mean, deviation²).
struct Unknown {
  enum class Kind {
    number,     ///< ln(value/nominal) of a number of the file
    amplitude,  ///< of an effect that was added, in units of its hypothesis' `largest`
    offset,     ///< of a channel [K, m]: of a sensor in all runs, of a displacement in one
    lag,        ///< of a sensor [s]
    start,      ///< deviation of the whole machine's temperature at the start of a run [K]
    warmth,     ///< of one of the fields of a run that does not begin at rest (warm_start.h), in its deviations
    air,        ///< deviation of the room air from its record, in one run [K]
    input,      ///< share of what a run may have been given instead in a gap of its record
    moments,   ///< how much earlier than the samples that show them a run's inputs changed, of the time between samples
    moment,    ///< how much earlier than that one of them changed [s]
    clock,     ///< by which a logger's is behind that of what is switched, in one run [s]
    place,     ///< of a sensor, in units of sensor_places.h
    loop,      ///< share of a solid's growth that a displacement follows beyond its loop (loop_gaps.h)
    interior,  ///< of what a lump hides, in units of a slab's (lump_interiors.h)
    zero,      ///< of a channel in one run or in the rest of it, from what it was (changed_zero.h) [K, m]
  };
  Kind kind = Kind::number;
  std::string name;
  double mean = 0.0, deviation = 1.0;
  double lower = -INFINITY, upper = INFINITY;
  std::size_t index =
      0;         ///< of the number, effect, channel, field, alternative, change, clock, place, loop, interior or zero
  int run = -1;  ///< −1: all

  /// Of an estimate from the prior's mean, in the prior's deviations.
  [[nodiscard]] double departure(double estimate) const { return std::abs(estimate - mean) / deviation; }
};

/// What a machine has and its file does not say: of what lumps hide it cannot, of places and loops only what data tell.
[[nodiscard]] inline bool is_beyond_a_file(Unknown::Kind kind) {
  return kind == Unknown::Kind::interior || kind == Unknown::Kind::place || kind == Unknown::Kind::loop;
}

}  // namespace thermotwin::twin
