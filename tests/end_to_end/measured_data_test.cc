#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>

#include "scenarios/csv.h"
#include "twin/experiment_file.h"
#include "twin/file/value.h"
#include "twin/machine.h"
#include "twin/run.h"

/// Plants that are no machine tools, against what was measured on them. Nothing is fitted.
namespace thermotwin::twin {
namespace {

namespace fs = std::filesystem;

fs::path data_folder() {
  char const* given = std::getenv("THERMOTWIN_MEASURED_DATA");
  return given ? fs::path(given) : fs::path(THERMOTWIN_SOURCE_DIR) / ".." / "shared" / "data";
}

Value machine_document(std::string const& name) { return read_toml(machine_file(name)); }

void erase_tables(Value& document, std::string const& kind) {
  std::erase_if(std::get<Value::Table>(document.content), [&](auto const& entry) { return entry.key == kind; });
}

void erase_sensor(Value& document, std::string const& name) {
  std::erase_if(std::get<Value::List>(document.find("temperature_sensor")->content),
                [&](Value const& sensor) { return std::get<std::string>(sensor.find("name")->content) == name; });
}

/// Root mean square of simulated less measured [K]; the sensor's own errors left out.
double error(Value const& machine, std::string const& experiment_name, std::string const& sensor,
             std::string const& recording, std::string const& time_column, std::string const& column) {
  auto const file = experiment_file(experiment_name);
  auto const result = run(Machine::build(machine), read_experiment(read_toml(file), file), {});
  auto const measured = scenarios::read_csv(data_folder() / recording, {time_column, column});
  auto const& time = result.dataset.time_s;
  auto const& readings = result.dataset.truth_readings;
  auto const channel = std::find_if(readings.begin(), readings.end(), [&](auto const& c) { return c.name == sensor; });
  double sum = 0.0;
  int count = 0;
  for (std::size_t row = 0; row < measured.lines.size(); ++row) {
    double const t = measured.columns[0][row];
    auto const after = std::upper_bound(time.begin(), time.end(), t) - time.begin();
    if (after == 0 || after == time.size()) continue;
    double const share = (t - time[after - 1]) / (time[after] - time[after - 1]);
    double const simulated = channel->values[after - 1] + share * (channel->values[after] - channel->values[after - 1]);
    sum += std::pow(simulated - measured.columns[1][row], 2);
    ++count;
  }
  return std::sqrt(sum / count);
}

class MeasuredData : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(data_folder())) GTEST_SKIP() << "measured data are not at " << data_folder();
  }
};

double outlet_error(Value const& machine, std::string const& run) {
  return error(machine, "water_pipe_" + run, "T_water_out", "water_pipe/run_" + run + ".csv", "time_s",
               "T_water_out_C");
}

TEST_F(MeasuredData, WaterPipeMeetsTheOutletBecauseItsWallTakesUpHeat) {
  auto const pipe = machine_document("water_pipe");
  EXPECT_LT(outlet_error(pipe, "150801"), 0.5);
  EXPECT_LT(outlet_error(pipe, "151204_1"), 0.4);
}

TEST_F(MeasuredData, WaterPipeWithoutItsWallMissesTheOutlet) {
  auto pipe = machine_document("water_pipe");
  for (auto const* kind : {"hollow_cylinder", "channel_film", "film"}) erase_tables(pipe, kind);
  for (auto const* sensor : {"T_wall_out", "T_wall_in"}) erase_sensor(pipe, sensor);
  EXPECT_NEAR(outlet_error(pipe, "150801"), 3.46, 0.1);
  EXPECT_NEAR(outlet_error(pipe, "151204_1"), 2.04, 0.1);
}

double heater_error(Value const& machine, std::string const& run) {
  return error(machine, "tclab_" + run, "T1", "tclab/" + run + ".csv", "Time (sec)",
               run == "second_order" ? "Temperature 1" : "Temperature 1 (degC)");
}

/// The published figures are those of another specimen: they meet the shape of the course, not its height.
TEST_F(MeasuredData, HeatedBoardIsMetBetterWithTheLagBetweenHeaterAndThermistor) {
  auto const board = machine_document("tclab");
  auto direct = board;
  set_parameter(direct, "temperature_sensor.T1.at", "heater1");
  for (std::string const run : {"energy_balance", "second_order"}) {
    double const with_lag = heater_error(board, run), without = heater_error(direct, run);
    EXPECT_LT(with_lag, 3.5) << run;
    EXPECT_LT(with_lag, 0.75 * without) << run;
  }
}

}  // namespace
}  // namespace thermotwin::twin
