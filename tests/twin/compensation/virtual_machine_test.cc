#include "twin/compensation/virtual_machine.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "thermal/error.h"
#include "twin/compensation/play.h"

namespace thermotwin::twin {
namespace {

output::Dataset run() {
  output::Dataset data;
  data.time_s = Eigen::VectorXd::LinSpaced(101, 0.0, 1000.0);
  data.readings = {{"T1", "degC", "", Eigen::VectorXd::LinSpaced(101, 20.0, 30.0)}};
  data.inputs = {{"spindle.speed", "rpm", "", Eigen::VectorXd::Constant(101, 4500.0)}};
  data.displacements = {{"E_X", "um", "", Eigen::VectorXd::Constant(101, 8.0)}};
  return data;
}

std::string offset(double value, double time, std::string const& unit = "um", std::string const& name = "X") {
  return payload_of({name, value, unit, time, "good"});
}

TEST(VirtualMachine, TellsReadingsAndInputsWithTheirUnits) {
  VirtualMachine machine(run(), {});
  auto const messages = machine.begin(10);
  ASSERT_EQ(messages.size(), 2u);
  EXPECT_EQ(messages[0].first, "thermotwin/input/spindle.speed");
  EXPECT_EQ(messages[0].second,
            R"({"name":"spindle.speed","quality":"good","time":100.0,"unit":"rpm","value":4500.0})");
  EXPECT_EQ(messages[1].first, "thermotwin/sensor/T1");
  EXPECT_EQ(messages[1].second, R"({"name":"T1","quality":"good","time":100.0,"unit":"degC","value":21.0})");
}

TEST(VirtualMachine, RecordsTheErrorWithTheOffsetInForce) {
  VirtualMachine machine(run(), {});
  for (std::size_t row = 0; row < machine.rows(); ++row) {
    static_cast<void>(machine.begin(row));
    machine.take(offset(row < 50 ? 0.0 : -6.0, machine.time(row)));
  }
  auto const& played = machine.played();
  EXPECT_DOUBLE_EQ(played.largest_error(), 8.0);
  EXPECT_DOUBLE_EQ(played.offset[50], 0.0);
  EXPECT_DOUBLE_EQ(played.offset[51], -6.0);
  EXPECT_NEAR(played.rms_residual(), std::sqrt((51 * 64.0 + 50 * 4.0) / 101), 1e-9);
  EXPECT_EQ(played.worst_excess(), 0.0);
  EXPECT_THAT(played_csv(played), testing::StartsWith("time_s,error_um,offset_um,compensated_um\n0,8,0,8\n"));
}

TEST(VirtualMachine, AppliesNoOffsetThatIsNone) {
  VirtualMachine machine(run(), {});
  static_cast<void>(machine.begin(0));
  for (auto const& payload : {offset(1e6, 1.0), offset(std::nan(""), 1.0), offset(3.0, 1.0, "mm"),
                              offset(3.0, 1.0, "um", "Z"), std::string("{"), std::string()})
    machine.take(payload);
  machine.take(offset(2.0, 5.0));
  machine.take(offset(7.0, 5.0));
  machine.take(offset(7.0, 4.0));
  static_cast<void>(machine.begin(1));
  EXPECT_EQ(machine.played().accepted, 1);
  EXPECT_EQ(machine.played().refused, 8);
  EXPECT_DOUBLE_EQ(machine.played().offset.back(), 2.0);
}

TEST(VirtualMachine, LetsGoOfTheLastOffsetWhenNoMoreCome) {
  VirtualMachineSettings settings;
  settings.fallback = {300.0, 200.0};
  VirtualMachine machine(run(), settings);
  static_cast<void>(machine.begin(0));
  machine.take(offset(-6.0, 0.0));
  for (std::size_t row = 1; row < machine.rows(); ++row) static_cast<void>(machine.begin(row));
  EXPECT_DOUBLE_EQ(machine.played().offset[30], -6.0);
  EXPECT_NEAR(machine.played().offset[40], -3.0, 1e-3);
  EXPECT_DOUBLE_EQ(machine.played().offset[51], 0.0);
}

TEST(VirtualMachine, RowsWithoutAnErrorCountInNoFigure) {
  auto gappy = run();
  gappy.displacements[0].values.segment(20, 11).setConstant(std::nan(""));
  VirtualMachine machine(gappy, {});
  for (std::size_t row = 0; row < machine.rows(); ++row) {
    static_cast<void>(machine.begin(row));
    machine.take(offset(row < 50 ? 0.0 : -6.0, machine.time(row)));
  }
  auto const& played = machine.played();
  EXPECT_EQ(played.unmeasured(), 11U);
  EXPECT_DOUBLE_EQ(played.rms_error(), 8.0);
  EXPECT_NEAR(played.rms_residual(), std::sqrt((40 * 64.0 + 50 * 4.0) / 90), 1e-9);
  EXPECT_DOUBLE_EQ(played.largest_residual(), 8.0);
  EXPECT_EQ(played.worst_excess(), 0.0);
  EXPECT_THAT(played_text(played), testing::EndsWith("\n11 of 101 rows are left out: no value of the error\n"));
}

TEST(VirtualMachine, NamesTheDisplacementsThatItHas) {
  VirtualMachineSettings settings;
  settings.channel = "E_Y";
  try {
    VirtualMachine const machine(run(), settings);
    FAIL() << "not refused";
  } catch (thermal::InputError const& error) {
    EXPECT_STREQ(error.what(), "the run has no displacement 'E_Y'; did you mean 'E_X'?");
  }
}

TEST(VirtualMachine, IsJudgedInTheUnitOfTheOffset) {
  auto other = run();
  other.displacements[0].unit = "mm";
  try {
    VirtualMachine const machine(other, {});
    FAIL() << "not refused";
  } catch (thermal::InputError const& error) {
    EXPECT_STREQ(error.what(), "the run shows 'E_X' in mm; an offset needs a displacement in um");
  }
}

}  // namespace
}  // namespace thermotwin::twin
