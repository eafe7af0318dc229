#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "output/dataset.h"
#include "scenarios/sampled.h"
#include "twin/diagnosis/measured_run.h"
#include "twin/file/tables.h"

namespace thermotwin::twin {

/// What was recorded, wherever it comes from, before it is laid over a machine. Times from the start of the run.
struct MeasuredData {
  std::string machine;                 ///< name of the machine that was measured or simulated, if it is known
  std::filesystem::path machine_file;  ///< where a measurement file names one
  std::vector<scenarios::SampledInput> inputs;
  Eigen::VectorXd time;                   ///< of the readings [s], strictly increasing
  std::vector<output::Channel> readings;  ///< of sensors, in their units
  std::vector<output::Channel> displacements;
  std::optional<double> initial_temperature;  ///< [K]
  std::optional<double> start_time_of_day;    ///< of time stamps [s]; a recorded clock goes before
  double max_gap = 600.0;                     ///< longer gaps become remarks, and those of inputs are estimated [s]
  std::vector<std::string> remarks;           ///< of the reader
  /// Tables of a measurement file that name them, for complaints with a place; a data set has none.
  using Tables = std::map<std::string, Value>;
  Tables input_tables, reading_tables;
  std::map<std::string, std::string> clocks;  ///< of readings that another logger took than what is switched
};

/// Puts the place of the table that names a channel, if there is one, in front of a complaint about it.
template <class Action>
void located(MeasuredData::Tables const& tables, std::string const& channel, Action action) {
  auto const table = tables.find(channel);
  if (table == tables.end()) return action();
  located(table->second, action);
}

/// A data set (`.h5` as `run -o` writes it, `.csv` as `export` does) or a measurement file (`.toml`), which maps the
/// columns of a table to inputs and channels. InputError that names the file.
[[nodiscard]] MeasuredData read_measured_data(std::filesystem::path const& path);

/// The inputs, readings and displacements of a data set, counted from its first row.
[[nodiscard]] MeasuredData measured_data(output::Dataset const& dataset);

/// Of an input that is a temperature: values that no machine meets are missing, and told. InputError when it has such
/// values most of the time; its unit is wrong then.
void leave_out_impossible(scenarios::SampledInput& input, std::vector<std::string>& remarks);

/// InputError when the unit in a measurement file's table contradicts a channel that every experiment has.
void check_unit_of_channel(Value const& table, scenarios::SampledInput const& input);

/// Inputs whose names are nearly those that every experiment has: "input 'colant.on': did you mean 'coolant.on'?"
[[nodiscard]] std::vector<std::string> misspelt_inputs(MeasuredData const& data);

/// A time in which something was not recorded [s].
struct RecordGap {
  double from = 0.0, to = 0.0;
  bool operator==(RecordGap const&) const = default;
};

/// What drives a machine, and cannot be supposed, is not in the data.
class MissingInputs : public thermal::InputError {
 public:
  using InputError::InputError;
};

/// Adds the inputs as a course: what is not recorded follows from the rest (scenarios/course.h), axes without a record
/// stand still, machine and drives are on, the coolant is off; remarks say so. And what may have been given instead in
/// gaps (input_gap.h).
///
/// MissingInputs that lists the inputs that the machine needs and that cannot be supposed: the spindle's speed, the
/// air's temperature, and whatever has a name of the machine's own. InputError for a speed beyond the machine's; for a
/// unit that contradicts the channel. Of a measurement file with its place; and there for a channel whose name is
/// nearly one that is read and not given. Others that nothing reads are told.
void add_courses(MeasuredRun& run, MeasuredData data, Machine const& machine);

/// The machine's channels that the data have, in SI and in the machine's order. A value that no sensor shows (below
/// −60 °C, above 250 °C) is missing; where it is always the same one, as a DS18B20's −127 °C, remarks tell. So is the
/// 85 °C of one that was just switched on, where no other value is near it, and a value of one row that is far from
/// those before and after, which are near each other. A sensor that never moves while others do is dead: all its values
/// are missing; one that stops moving for the last tenth of the run or more, and longer than it stood before, is dead
/// from there on. Remarks tell of these, of gaps, and of channels that only one side has.
///
/// InputError when no channel is the machine's, when all are dead, when a unit contradicts the channel.
[[nodiscard]] std::vector<MeasuredChannel> channels_of(MeasuredData const& data, Machine const& machine,
                                                       std::vector<std::string>& remarks);

/// The same without a machine: every channel that the data have.
[[nodiscard]] std::vector<MeasuredChannel> channels_of(MeasuredData const& data, std::vector<std::string>& remarks);

/// What they tell of a channel that is dead since all its readings are one value.
[[nodiscard]] std::string remark_of_still(std::string const& channel);

/// A run of no machine: what its channels showed, without what drove it.
[[nodiscard]] MeasuredRun measured_run(MeasuredData const& data, std::string const& name);

/// Both together. InputError when the run has less than ten rows.
[[nodiscard]] MeasuredRun measured_run(MeasuredData data, Machine const& machine, std::string const& name);

}  // namespace thermotwin::twin
