#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scenarios/ambient.h"
#include "scenarios/feed_program.h"
#include "scenarios/field.h"
#include "scenarios/input_program.h"
#include "scenarios/recorded.h"
#include "scenarios/spindle_program.h"
#include "scenarios/switching.h"
#include "thermal/units.h"

namespace thermotwin::scenarios {

/// What a machine is put through. Its fields, and those of its parts, are listed as scenarios/field.h says.
///
/// Programmes run from the start, one block after another; what a programme leaves open at its end stands still.
struct Experiment {
  std::string title;
  std::string machine;                        ///< name of a machine, or the file that describes it
  double duration = required;                 ///< [s] > 0
  double sampling = 60.0;                     ///< interval of the readings [s]
  int seed = 1;                               ///< of everything random in the instruments
  double start_time_of_day = 8 * 3600.0;      ///< [s]
  std::optional<double> initial_temperature;  ///< of the whole machine [K]; default: that of the air around each part
  std::optional<SpindleProgram> spindle;
  std::vector<FeedProgram> axes;
  std::optional<LaserMeasurement> laser;
  Ambient ambient;
  Coolant coolant;
  Chiller chiller;
  PowerSwitch power;  ///< of the machine
  PowerSwitch servo;  ///< of the drives
  std::vector<InputProgram> inputs;
  std::vector<Recording> recorded;

  std::vector<DrivenChannel> driven;      ///< inputs in memory, of a measured run; they count as recorded
  std::filesystem::path directory = ".";  ///< of the experiment's file: relative names of recordings start here

  template <class Fields>
  static void fields(Fields& f) {
    f("title", &Experiment::title, "one line for people");
    f.name("machine", &Experiment::machine, "name of a machine, or the file that describes it");
    f("duration", &Experiment::duration, thermal::dimension::time, "of the run", {0.0, unbounded});
    f("sampling", &Experiment::sampling, thermal::dimension::time, "interval of the readings", {0.0, unbounded});
    f("seed", &Experiment::seed, "of everything random in the instruments");
    f("start_time_of_day", &Experiment::start_time_of_day, thermal::dimension::time, "clock at the start of the run",
      {0.0, unbounded});
    f.temperature("initial_temperature", &Experiment::initial_temperature,
                  "of the whole machine; default: that of the air around each part");
    f("spindle", &Experiment::spindle, "speed of the spindle; without it: standstill");
    f("axes", &Experiment::axes, "motion of feed axes; those without a programme stand still");
    f("laser", &Experiment::laser, "measurement of position errors with a laser interferometer");
    f("ambient", &Experiment::ambient, "air around the machine");
    f("coolant", &Experiment::coolant, "coolant of the cutting zone");
    f("chiller", &Experiment::chiller, "command to the chiller");
    f("power", &Experiment::power, "of the machine");
    f("servo", &Experiment::servo, "of the drives");
    f("inputs", &Experiment::inputs, "programmes for any other input channel, one that no table here drives");
    f("recorded", &Experiment::recorded, "inputs from measured files, in place of programmes");
  }
};

/// Times of the readings: 0, sampling, 2 sampling, … up to the duration [s].
std::vector<double> sample_times(Experiment const& experiment);

/// Throws InputError for a duration, interval or seed that cannot be.
void check(Experiment const& experiment);

/// Throws InputError for a run that ends before its second reading.
void check_readings(Experiment const& experiment);

}  // namespace thermotwin::scenarios
