#include "scenarios/experiment.h"

#include <fmt/format.h>

#include "thermal/error.h"

namespace thermotwin::scenarios {
namespace {

constexpr double most_readings = 1e8;  ///< of a channel: more fit into no memory

void require_positive(double seconds, std::string const& name) {
  if (seconds > 0.0) return;
  throw thermal::InputError(name + ": " + thermal::format_quantity(seconds, thermal::dimension::time) +
                            " must be above 0 s, for example \"4 h\"");
}

}  // namespace

std::vector<double> sample_times(Experiment const& experiment) {
  return times_every(experiment.sampling, experiment.duration);
}

void check(Experiment const& experiment) {
  require_positive(experiment.duration, "duration");
  require_positive(experiment.sampling, "sampling");
  if (double const readings = experiment.duration / experiment.sampling; readings > most_readings)
    throw thermal::InputError(
        fmt::format("sampling: {} makes {:.1e} readings of {}; at most {:.0e} are possible",
                    thermal::format_quantity(experiment.sampling, thermal::dimension::time), readings,
                    thermal::format_quantity(experiment.duration, thermal::dimension::time), most_readings));
  if (experiment.seed < 0) {
    throw thermal::InputError("seed: " + std::to_string(experiment.seed) + " must be 0 or more");
  }
  if (experiment.start_time_of_day < 0.0 || experiment.start_time_of_day >= 86400.0) {
    throw thermal::InputError(
        "start_time_of_day: " + thermal::format_quantity(experiment.start_time_of_day, thermal::dimension::time) +
        " must be from 0 h to below 24 h");
  }
  check(experiment.ambient, experiment.start_time_of_day, experiment.duration);
}

void check_readings(Experiment const& experiment) {
  if (experiment.sampling <= experiment.duration) return;
  throw thermal::InputError("sampling: " + thermal::format_quantity(experiment.sampling, thermal::dimension::time) +
                            " is longer than the run, " +
                            thermal::format_quantity(experiment.duration, thermal::dimension::time));
}

}  // namespace thermotwin::scenarios
