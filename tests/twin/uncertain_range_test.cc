#include "twin/uncertain_range.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/output/temporary_directory.h"
#include "twin/challenge/hidden_world.h"
#include "twin/machine.h"

namespace thermotwin::twin {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string const& v450_text() {
  static std::string const text = tests::contents(machine_file("v450"));
  return text;
}

Value v450_with(std::string const& tables) { return parse_toml(v450_text() + tables, "mine.toml"); }

std::string range(std::string const& name, std::string const& from, std::string const& to) {
  return fmt::format("\n[[uncertain]]\nname = \"{}\"\nfrom = \"{}\"\nto = \"{}\"\n", name, from, to);
}

std::string refusal(std::string const& table) {
  try {
    (void)ranged_numbers(v450_with(table));
  } catch (FileError const& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(UncertainRange, IsOfANumberOfTheFile) {
  auto const document =
      v450_with(range("joint.head.conductance", "5 W/K", "12 W/K") + range("bearing.front.grease_factor", "0.4", "1"));
  EXPECT_NO_THROW((void)Machine::build(document));
  auto const ranges = ranged_numbers(document);
  ASSERT_EQ(ranges.size(), 2U);
  EXPECT_EQ(ranges[0].number.path, "joint.head.conductance");
  EXPECT_DOUBLE_EQ(ranges[0].low, 5.0);
  EXPECT_DOUBLE_EQ(ranges[0].high, 12.0);
  EXPECT_DOUBLE_EQ(ranges[1].low, 0.4);
  EXPECT_TRUE(ranged_numbers(v450_with("")).empty());
}

/// A challenge hides its effect in a machine of another form, whose motor is a block without a mass of its own.
TEST(UncertainRange, IsNotOfAnotherFormOfTheMachine) {
  auto const document = v450_with(range("lump.motor.mass", "20 kg", "30 kg"));
  EXPECT_EQ(ranged_numbers(document).size(), 1U);
  EXPECT_NO_THROW((void)draw_hidden_world(document, 1, CaseKind::none));
}

TEST(UncertainRange, SaysWhereItIsWrong) {
  auto const lines = std::count(v450_text().begin(), v450_text().end(), '\n');
  auto const at = [&](int line, int column) {
    return HasSubstr(fmt::format("mine.toml:{}:{}: ", lines + line, column));
  };
  EXPECT_THAT(refusal(range("joint.haed.conductance", "5 W/K", "12 W/K")), AllOf(at(3, 8), HasSubstr("'head'")));
  EXPECT_THAT(refusal(range("joint.head.conductence", "5 W/K", "12 W/K")),
              AllOf(at(3, 8), HasSubstr("did you mean 'conductance'?")));
  EXPECT_THAT(refusal(range("joint.head.conductance", "5 W", "12 W/K")), AllOf(at(4, 8), HasSubstr("'5 W'")));
  EXPECT_THAT(refusal(range("joint.head.conductance", "12 W/K", "5 W/K")),
              AllOf(at(4, 8), HasSubstr("the range from '12 W/K' to '5 W/K' is empty")));
  EXPECT_THAT(refusal(range("joint.head.conductance", "8 W/K", "12 W/K")),
              HasSubstr("outside its range from '8 W/K' to '12 W/K'"));
  EXPECT_THAT(
      refusal(range("joint.head.conductance", "5 W/K", "12 W/K") + range("joint.head.conductance", "5 W/K", "9 W/K")),
      HasSubstr("the name 'joint.head.conductance' is taken by another [[uncertain]]"));
}

/// Evenly within its range, while every other number is drawn as without it; also what nothing else draws.
TEST(UncertainRange, IsWhatMachinesAreDrawnFrom) {
  auto const document = v450_with(range("bearing.front.grease_factor", "0.5", "0.7") +
                                  range("material.casting.expansion", "10e-6 1/K", "12e-6 1/K"));
  int low = 0, beyond = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    std::map<std::string, double> drawn, without;
    auto const machine = vary_parameters(document, seed, 1.0, drawn);
    (void)vary_parameters(v450_with(""), seed, 1.0, without);
    double const grease = find_number(machine, "bearing.front.grease_factor").value;
    double const expansion = find_number(machine, "material.casting.expansion").value;
    EXPECT_NEAR(grease, 0.6, 0.1);
    EXPECT_NEAR(expansion, 11e-6, 1e-6);
    low += grease < 0.55;
    beyond += expansion > 11.5e-6;
    EXPECT_EQ(drawn.size(), without.size() + 1);  // the casting's expansion
    without.erase("bearing.front.grease_factor");
    for (auto const& [path, factor] : without) EXPECT_EQ(drawn.at(path), factor) << path;
    EXPECT_TRUE(ranged_numbers(machine).empty());
  }
  EXPECT_NEAR(low, 50, 20);  // a quarter; 3.3 standard deviations
  EXPECT_NEAR(beyond, 50, 20);
}

}  // namespace
}  // namespace thermotwin::twin
