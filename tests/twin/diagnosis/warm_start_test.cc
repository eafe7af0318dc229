#include "twin/diagnosis/warm_start.h"

#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "tests/twin/diagnosis/diagnosis_bench.h"
#include "thermal/integrate.h"
#include "twin/diagnosis/diagnosis.h"
#include "twin/diagnosis/run_files.h"

namespace thermotwin::twin {
namespace {

/// Four lumps with sensors around a fifth without: G to the first two of them, a film of 2 W/K.
Value star() {
  std::string text = "name = \"star\"\n";
  for (auto const* name : {"a", "b", "c", "d", "between"})
    text += fmt::format(R"toml(
      [[lump]]
      name = "{0}"
      heat_capacity = "5000 J/K"
      corner = ["0 mm", "0 mm", "0 mm"]
      size = ["100 mm", "100 mm", "100 mm"]
      [[film]]
      name = "air of {0}"
      on = "{0}"
      correlation = "constant"
      coefficient = "20 W/(m2 K)"
      area = "0.1 m2")toml",
                        name);
  for (auto const* name : {"a", "b", "c", "d"})
    text += fmt::format("\n[[temperature_sensor]]\nname = \"T_{0}\"\nat = \"{0}\"\nkind = \"ideal\"", name);
  auto const joint = [&](std::string const& from, std::string const& to, double conductance) {
    text += fmt::format("\n[[joint]]\nname = \"{0} {1}\"\nfrom = \"{0}\"\nto = \"{1}\"\nconductance = \"{2} W/K\"",
                        from, to, conductance);
  };
  joint("a", "between", 3.0);
  joint("b", "between", 5.0);
  joint("a", "c", 4.0);
  joint("b", "d", 6.0);
  return parse_toml(text, "star.toml");
}

/// Readings of an hour, as long as nothing but the first matters.
MeasuredRun readings(Machine const& machine, std::vector<double> const& rises) {
  auto dataset =
      run(machine, tests::experiment("duration = \"1 h\"\nambient.daily_cycle.amplitude = \"1 K\""), {}).dataset;
  for (std::size_t i = 0; i < rises.size(); ++i) dataset.readings[i].values.array() += rises[i];
  return measured_run(dataset, machine, "run");
}

/// What is not seen is, given what is, where no heat is left over: Σ G (θ_j − θ) = g θ, whatever offsets make of θ_j.
TEST(WarmStart, BetweenSensorsTheFieldIsWhereItsOwnConductancesHoldIt) {
  Machine const machine = Machine::build(star());
  auto measured = readings(machine, {7.0, 11.0, 5.0, 8.0});
  ASSERT_TRUE(measured.warm_start);
  auto const start = start_of(machine, measured);
  measured.warm_start.reset();
  double const room = start_of(machine, measured)[0];
  auto const rise = [&](std::string const& body) {
    return start[std::size_t(machine.network().range(body).first)] - room;
  };
  EXPECT_NEAR(rise("a"), 7.0, 0.3);
  EXPECT_NEAR(rise("b"), 11.0, 0.3);
  EXPECT_NEAR(rise("between"), (3.0 * rise("a") + 5.0 * rise("b")) / (3.0 + 5.0 + 2.0), 1e-9);
}

TEST(WarmStart, CovarianceOfTheFieldsIsProportionalToTheInverseOfTheConductances) {
  Machine const machine = Machine::build(star());
  auto const measured = readings(machine, {7.0, 11.0, 5.0, 8.0});
  ASSERT_TRUE(measured.warm_start);
  auto const& fields = measured.warm_start->fields;
  ASSERT_EQ(fields.cols(), 5);
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(5, 5);
  K.diagonal() << 2.0 + 3.0 + 4.0, 2.0 + 5.0 + 6.0, 2.0 + 4.0, 2.0 + 6.0, 2.0 + 3.0 + 5.0;
  auto const couple = [&](int i, int j, double conductance) { K(i, j) = K(j, i) = -conductance; };
  couple(0, 4, 3.0);
  couple(1, 4, 5.0);
  couple(0, 2, 4.0);
  couple(1, 3, 6.0);
  Eigen::MatrixXd const product = fields * fields.transpose() * K;
  EXPECT_TRUE(product.isApprox(product(0, 0) * Eigen::MatrixXd::Identity(5, 5), 1e-9)) << product;
}

TEST(WarmStart, AMachineAtRestHasNone) {
  Machine const machine = Machine::build(star());
  EXPECT_FALSE(readings(machine, {0.0, 0.0, 0.0, 0.0}).warm_start);
  EXPECT_FALSE(readings(machine, {0.3, -0.2, 0.4, -0.3}).warm_start) << "offsets";
  EXPECT_FALSE(readings(machine, {0.8, 0.8, 0.8, 0.8}).warm_start) << "a record of the room that is off";
}

TEST(WarmStart, NorDoesASensorThatIsWrong) {
  Machine const machine = Machine::build(star());
  EXPECT_FALSE(readings(machine, {0.1, 8.0, 0.0, -0.1}).warm_start);
}

/// What is not enough to be evident in one run is taken for what it looks like where another run shows it.
TEST(WarmStart, RunsMayBeginAsAnotherDoes) {
  Machine const machine = Machine::build(star());
  std::vector<MeasuredRun> alone = {readings(machine, {0.0, 0.0, 0.8, 0.7}), readings(machine, {0.1, -0.1, 0.1, 0.0})};
  let_begin_alike(alone, machine);
  EXPECT_FALSE(alone[0].warm_start);
  auto together = alone;
  together.push_back(readings(machine, {7.0, 11.0, 5.0, 8.0}));
  let_begin_alike(together, machine);
  ASSERT_TRUE(together[0].warm_start);
  EXPECT_THAT(together[0].remarks, testing::Contains(testing::HasSubstr("does not begin at rest")));
  EXPECT_FALSE(together[1].warm_start) << "nor does one that is at rest";
}

/// One whose tank evaporates is cooler than its room after a night, and as warm where it was filled in the morning.
TEST(WarmStart, AMachineMayHaveStoodUntilItsRunBegins) {
  Machine const machine = Machine::build(tests::with_table(star(), R"toml(
    [[evaporation]]
    name = "tank"
    from = "a"
    area = "0.1 m2"
    coefficient = "12 W/(m2 K)")toml"));
  auto const dataset = run(machine, tests::experiment("duration = \"1 h\""), {}).dataset;
  auto measured = measured_run(dataset, machine, "run");
  EXPECT_FALSE(measured.warm_start) << "nor need it have stood";
  auto const room = start_of(machine, measured);
  std::vector<double> stood;
  thermal::integrate(
      machine.network(), *measured.course, room, std::vector<double>{0.0, 24.0 * 3600.0}, {},
      [&](thermal::Sample const& sample) { stood.assign(sample.temperatures.begin(), sample.temperatures.end()); });
  ASSERT_LT(stood[0], room[0] - 2.0);
  for (std::size_t i = 0; i < 4; ++i) measured.channels[i].values.setConstant(stood[i]);
  measured.begin_with(warm_start(machine, measured));
  ASSERT_TRUE(measured.warm_start);
  auto const start = start_of(machine, measured);
  for (std::size_t i = 0; i < start.size(); ++i) EXPECT_NEAR(start[i], stood[i], 0.1 * (room[i] - stood[i])) << i;
}

TEST(WarmStart, AMassThatIsAddedIsAsWarmAsItsBody) {
  Machine const machine = Machine::build(star());
  Machine const with_mass = Machine::build(tests::with_table(star(), R"(
    [[extra_mass]]
    name = "more"
    at = "b"
    heat_capacity = "2000 J/K"
    conductance = "3 W/K")"));
  auto const measured = readings(machine, {7.0, 11.0, 5.0, 8.0});
  ASSERT_TRUE(measured.warm_start);
  auto const start = start_of(with_mass, measured);
  ASSERT_EQ(start.size(), 6);
  EXPECT_DOUBLE_EQ(start[5], start[std::size_t(with_mass.network().range("b").first)]);
}

/// A logger that is switched on an hour after the spindle has stopped.
class AfterWork : public testing::Test {
 protected:
  static constexpr double on = 5.0 * 3600.0;

  void SetUp() override {
    auto dataset = run(machine, tests::experiment(R"(
      duration = "12 h"
      ambient.daily_cycle.amplitude = "1.5 K"
      [spindle]
      blocks = [{duration = "4 h", speed = "6000 rpm"}, {duration = "2 h", speed = "0 rpm"},
                {duration = "2 h", speed = "4500 rpm"}, {duration = "1 h", speed = "1500 rpm"}])"),
                       {})
                       .dataset;
    measured = measured_run(tests::without_rows(dataset, -1.0, on - 1.0), machine, "after work");
    auto const whole = measured_run(dataset, machine, "whole");
    thermal::integrate(machine.network(), *whole.course, start_of(machine, whole), std::vector<double>{0.0, on}, {},
                       [&](thermal::Sample const& sample) {
                         auto const begin = sample.temperatures.begin();
                         truth.assign(begin, begin + machine.network().nodes());
                       });
  }

  Machine const machine = Machine::build(tests::v450());
  MeasuredRun measured;
  std::vector<double> truth;  ///< of the nodes, when it is switched on
};

TEST_F(AfterWork, EachPartIsNearlyAsWarmAsItWas) {
  ASSERT_TRUE(measured.warm_start);
  auto const start = start_of(machine, measured);
  measured.warm_start.reset();
  auto const rest = start_of(machine, measured);
  double missed = 0.0, warm = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    missed += std::pow(start[i] - truth[i], 2);
    warm += std::pow(rest[i] - truth[i], 2);
  }
  EXPECT_LT(std::sqrt(missed / warm), 0.2);
}

TEST_F(AfterWork, NothingIsMissing) {
  tests::add_noise(measured, 0.02, 0.05e-6, 7);
  EXPECT_EQ(name_of(diagnose(tests::v450(), {bin(measured, 300.0)}, {}).verdict), "nothing");
  measured.warm_start.reset();
  EXPECT_NE(name_of(diagnose(tests::v450(), {bin(measured, 300.0)}, {}).verdict), "nothing");
}

}  // namespace
}  // namespace thermotwin::twin
