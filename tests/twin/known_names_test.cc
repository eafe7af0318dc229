#include "twin/known_names.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>

#include "thermal/fluid.h"
#include "thermal/material.h"

namespace thermotwin::twin {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

TEST(KnownNames, HaveEveryMaterialWithItsNumbersAndMeaning) {
  auto const text = material_list();
  for (auto const& name : thermal::material_names()) EXPECT_THAT(text, HasSubstr("\n  " + name + " "));
  for (auto const& name : thermal::fluid_names()) EXPECT_THAT(text, HasSubstr("\n  " + name + " "));
  EXPECT_THAT(text, ContainsRegex("GJL-250 +7250 +47.5 +500 +10.5  grey cast iron\n"));
  EXPECT_THAT(text, ContainsRegex("water +998.2 +0.598 +4188 +1\n"));
}

TEST(KnownNames, HaveEveryInputChannelWithItsUnitAndMeaning) {
  auto const text = channel_list();
  EXPECT_THAT(text, ContainsRegex("\n  spindle.speed +rad/s +spindle speed\n"));
  EXPECT_THAT(text, ContainsRegex("\n  AXIS.feed +m/s +feed while moving\n"));
  EXPECT_THAT(text, ContainsRegex("\n  ambient.temperature +K +air temperature at the reference height\n"));
  EXPECT_THAT(text, ContainsRegex("\n  coolant.on +1 +1 while the coolant runs\n"));
}

TEST(KnownNames, AreAtMost100ColumnsWide) {
  std::stringstream lines(material_list() + channel_list());
  for (std::string line; std::getline(lines, line);)
    EXPECT_LE(std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; }), 100) << line;
}

}  // namespace
}  // namespace thermotwin::twin
