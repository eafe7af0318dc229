#include "twin/diagnosis/comparison.h"

#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "output/dataset_file.h"
#include "tests/output/temporary_directory.h"
#include "twin/experiment_file.h"
#include "twin/run.h"

/// Two machines along the same run: one has what the run was made with, the other lacks it.
namespace thermotwin::twin {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

Value document() { return read_toml(machine_file("v450")); }

Machine nominal() { return Machine::build(document()); }
/// Its front bearing has stiffer grease.
Machine worse() {
  auto other = document();
  set_parameter(other, "bearing.front.grease_factor", "1.5");
  return Machine::build(other);
}

/// What an ideal instrument shows, and each offset by something of its own.
MeasuredRun measured(Machine const& machine) {
  auto const experiment = parse_toml(R"(
    title = "one start and one stop"
    machine = "v450"
    duration = "2 h"
    spindle.blocks = [{duration = "1 h", speed = "5000 rpm"}, {duration = "1 h", speed = "0 rpm"}])",
                                     "experiment.toml");
  auto dataset = run(machine, read_experiment(experiment, "experiment.toml"), {}).dataset;
  dataset.readings = dataset.truth_readings;
  dataset.displacements = dataset.truth_displacements;
  double offset = 0.0;
  for (auto* group : {&dataset.readings, &dataset.displacements})
    for (auto& channel : *group) channel.values.array() += (offset += 0.1);
  return measured_run(dataset, machine, "made");
}

Machine without_lag(Machine machine) {
  for (auto& sensor : machine.sensors) sensor.description.lag = sensor.description.stem_loss = 0.0;
  return machine;
}

TEST(Comparison, MachineThatMadeTheDataHasNoGapAndTheOtherHas) {
  auto const right = without_lag(worse()), wrong = without_lag(nominal());
  auto const comparison = compare(wrong, right, {measured(right)});
  auto const kelvin = total(comparison, "K"), micrometres = total(comparison, "um");
  EXPECT_GT(kelvin.before, 0.1);
  EXPECT_LT(kelvin.after, 1e-3);
  EXPECT_GT(micrometres.before, 0.1);
  EXPECT_LT(micrometres.after, 1e-2);
}

TEST(Comparison, OffsetsOfInstrumentsAreTakenOffAndTold) {
  auto const machine = without_lag(nominal());
  auto const comparison = compare(machine, machine, {measured(machine)});
  auto const& channels = comparison.runs[0].channels;
  EXPECT_NEAR(channels[0].offset_before, 0.1, 1e-3);
  EXPECT_NEAR(channels[3].offset_after, 0.4, 1e-3);
}

TEST(Comparison, RegimesAreSpeedsAndTheirSquaresAddUp) {
  auto const right = without_lag(worse()), wrong = without_lag(nominal());
  auto const run = compare(wrong, right, {measured(right)}).runs[0];
  EXPECT_THAT(run.regimes, ElementsAre("idle", "5000 rpm"));
  for (auto const& channel : run.channels) {
    if (channel.whole.samples == 0) continue;
    double squares = 0.0;
    for (auto const& part : channel.parts) squares += part.before * part.before * double(part.samples);
    EXPECT_NEAR(std::sqrt(squares / double(channel.whole.samples)), channel.whole.before, 1e-12);
  }
  EXPECT_EQ(run.channels[0].parts[1].samples, 60);
}

/// Twenty letters are six more than the column has for short ones.
TEST(Comparison, LongNamesMoveTheirHeadings) {
  GapPair const gap{1.0, 0.5, 60};
  Comparison const comparison{"a", "b", {{"made", {"idle"}, {{"temperature_of_oil_2", "K", gap, {gap}}}, {}}}};
  EXPECT_THAT(comparison_table(comparison),
              HasSubstr("\n  channel                      before    after    before    after    before → after\n"
                        "  temperature_of_oil_2     K        1      0.5         0        0           1 → 0.5\n"));
}

TEST(Comparison, PageAndJsonSayTheSame) {
  auto const right = without_lag(worse()), wrong = without_lag(nominal());
  auto const comparison = compare(wrong, right, {measured(right)});
  auto const json = nlohmann::json::parse(comparison_json(comparison));
  auto const& channel = comparison.runs[0].channels[0];
  EXPECT_DOUBLE_EQ(json["runs"][0]["channels"][0]["regimes"]["5000 rpm"]["before"], channel.parts[1].before);
  EXPECT_DOUBLE_EQ(json["total"]["K"]["after"], total(comparison, "K").after);
  EXPECT_THAT(comparison_table(comparison), HasSubstr(fmt::format("{:>8.3g}", channel.whole.before)));
}

/// Every number stands under "before" or "after", and those of a regime beside an arrow, which is no comparison.
TEST(Comparison, PageHeadsWhatIsBeforeAndAfter) {
  auto const right = without_lag(worse()), wrong = without_lag(nominal());
  auto const comparison = compare(wrong, right, {measured(right)});
  auto const text = comparison_table(comparison);
  EXPECT_THAT(text, HasSubstr("\n                              error, RMS   offset taken off              idle         "
                              "5000 rpm\n"
                              "  channel                before    after    before    after    before → after   "
                              "before → after\n"
                              "  T1                 K "));
  auto const& part = comparison.runs[0].channels[0].parts[1];
  EXPECT_THAT(text, HasSubstr(fmt::format(" {:.3g} → {:.3g}\n", part.before, part.after)));
  EXPECT_THAT(text, Not(HasSubstr(" > ")));
}

/// The user has added a sensor; the machine that came before has none of that name.
TEST(Comparison, IsOfTheChannelsThatBothMachinesHave) {
  thermotwin::tests::TemporaryDirectory const folder;
  auto const text = thermotwin::tests::contents(machine_file("v450"));
  thermotwin::tests::put(folder / "mine.toml", text + "\n[[temperature_sensor]]\nname = \"T99\"\nat = \"motor\"\n");
  auto const experiment = parse_toml(R"(
    machine = "v450"
    duration = "1 h"
    spindle.blocks = [{duration = "1 h", speed = "5000 rpm"}])",
                                     "experiment.toml");
  auto const made = run(Machine::read(folder / "mine.toml"), read_experiment(experiment, "experiment.toml"), {});
  output::write(made.dataset, folder / "run.h5");
  auto const compared = compare_files(folder / "mine.toml", machine_file("v450"), {folder / "run.h5"}).runs.at(0);
  std::vector<std::string> names;
  for (auto const& channel : compared.channels) names.push_back(channel.name);
  EXPECT_THAT(names, AllOf(Contains("T1"), Not(Contains("T99"))));
  EXPECT_THAT(compared.remarks, Contains("of the first machine only, so not compared: T99"));
}

}  // namespace
}  // namespace thermotwin::twin
