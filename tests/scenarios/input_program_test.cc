#include "scenarios/input_program.h"

#include <gtest/gtest.h>

#include "tests/scenarios/refusal.h"

namespace thermotwin::scenarios {
namespace {

TEST(InputProgram, HoldsItsLastValue) {
  DrivenChannel const heater = driven_channel({"heater1.duty", {{60.0, "70 %"}, {60.0, "20 %"}}}, 600.0);
  EXPECT_EQ(heater.channel.name, "heater1.duty");
  EXPECT_EQ(heater.channel.unit, "1");
  EXPECT_DOUBLE_EQ(heater.signal.at(0.0), 0.7);
  EXPECT_DOUBLE_EQ(heater.signal.at(60.0), 0.2);
  EXPECT_DOUBLE_EQ(heater.signal.at(600.0), 0.2);
}

TEST(InputProgram, TakesItsUnitFromItsValues) {
  DrivenChannel const inlet = driven_channel({"water.inlet_temperature", {{60.0, "35 degC"}}}, 60.0);
  EXPECT_EQ(inlet.channel.unit, "K");
  EXPECT_DOUBLE_EQ(inlet.signal.at(0.0), 308.15);
}

TEST(InputProgram, RefusesWhatCannotBe) {
  auto const refused = [](InputProgram const& program) {
    return tests::refusal([&] { driven_channel(program, 60.0); });
  };
  EXPECT_EQ(refused({"a", {{60.0, "1 K"}, {60.0, "1 W"}}}),
            "blocks[1].value: '1 W' is a power, the first block's value a temperature difference");
  EXPECT_EQ(refused({"a", {{60.0, "1 rmp"}}}), "blocks[0].value: '1 rmp': unknown unit 'rmp'; did you mean 'rpm'?");
  EXPECT_EQ(refused({"a", {{0.0, "1 K"}}}), "blocks[0].duration: 0 min must be above 0 s");
  EXPECT_EQ(refused({"a", {}}), "blocks: they are empty; write at least one");
  EXPECT_EQ(refused({}), "channel: the name of an input channel is due");
}

}  // namespace
}  // namespace thermotwin::scenarios
