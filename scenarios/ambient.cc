#include "scenarios/ambient.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "thermal/error.h"

namespace thermotwin::scenarios {
namespace {

using thermal::format_quantity;
using thermal::format_temperature;
using thermal::InputError;
namespace dimension = thermal::dimension;

constexpr double day = 86400.0;

double daily(DailyCycle const& cycle, double time_of_day) {
  return cycle.amplitude * std::cos(2.0 * std::numbers::pi * (time_of_day - cycle.peak_time) / day);
}

double conditioned(AirConditioning const& cycle, double t) {
  return cycle.amplitude * std::sin(2.0 * std::numbers::pi * t / cycle.period);
}

double draught(DoorOpening const& door, double t) {
  if (t <= door.time) return 0.0;
  double const open = std::min(t - door.time, door.duration);
  double const closed = t - door.time - open;
  return door.step * -std::expm1(-open / door.time_constant) * std::exp(-closed / door.time_constant);
}

/// From the mean, were all that changes the air to do so at once [K].
double largest_departure(Ambient const& ambient, double duration) {
  double sum = std::abs(ambient.drift) * duration;
  if (ambient.daily_cycle) sum += std::abs(ambient.daily_cycle->amplitude);
  if (ambient.air_conditioning) sum += std::abs(ambient.air_conditioning->amplitude);
  for (DoorOpening const& door : ambient.door_openings) sum += std::abs(door.step);
  return sum;
}

void require_air(double temperature, std::string const& place) {
  if (temperature >= coldest_air && temperature <= hottest_air) return;
  throw InputError(place + format_temperature(temperature) + "; allowed is " + format_temperature(coldest_air) +
                   " to " + format_temperature(hottest_air));
}

void require_time(double value, std::string const& place) {
  if (!(value > 0.0)) throw InputError(place + ": " + format_quantity(value, dimension::time) + " must be above 0 s");
}

}  // namespace

double air_temperature(Ambient const& ambient, double start_time_of_day, double t) {
  double temperature = ambient.mean + ambient.drift * t;
  if (ambient.daily_cycle) temperature += daily(*ambient.daily_cycle, start_time_of_day + t);
  if (ambient.air_conditioning) temperature += conditioned(*ambient.air_conditioning, t);
  for (DoorOpening const& door : ambient.door_openings) temperature += draught(door, t);
  return temperature;
}

bool door_open(Ambient const& ambient, double t) {
  return std::any_of(ambient.door_openings.begin(), ambient.door_openings.end(),
                     [t](DoorOpening const& door) { return door.time <= t && t < door.time + door.duration; });
}

void check(Ambient const& ambient, double start_time_of_day, double duration) {
  require_air(ambient.mean, "ambient.mean: ");
  if (ambient.air_conditioning) require_time(ambient.air_conditioning->period, "ambient.air_conditioning.period");
  for (std::size_t i = 0; i < ambient.door_openings.size(); ++i) {
    DoorOpening const& door = ambient.door_openings[i];
    std::string const place = "ambient.door_openings[" + std::to_string(i) + "].";
    if (door.time < 0.0) {
      throw InputError(place + "time: " + format_quantity(door.time, dimension::time) +
                       " is before the start of the run");
    }
    require_time(door.duration, place + "duration");
    require_time(door.time_constant, place + "time_constant");
    require_air(air_temperature(ambient, start_time_of_day, std::min(door.time + door.duration, duration)),
                place + "step: the air reaches ");
  }
  double const most = largest_departure(ambient, duration);
  if (ambient.mean - most >= coldest_air && ambient.mean + most <= hottest_air) return;  // as of nearly all
  constexpr int looks = 1000;
  for (int i = 0; i <= looks; ++i)
    require_air(air_temperature(ambient, start_time_of_day, duration * i / looks), "ambient: the air reaches ");
}

}  // namespace thermotwin::scenarios
