#include "twin/effect_page.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

#include "tests/twin/only.h"

namespace thermotwin::twin {
namespace {

TEST(EffectPage, ShowsTextsAndParametersWithin100Columns) {
  for (auto const& entry : effect_catalogue()) {
    auto const page = effect_page(entry);
    for (auto const& field : entry.parameters) EXPECT_NE(page.find(field.key), std::string::npos) << field.key;
    std::stringstream lines(page + effect_list());
    for (std::string line; std::getline(lines, line);)
      EXPECT_LE(std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; }), 100) << line;
  }
  auto const page = effect_page(effect("fan_cooling"));
  EXPECT_NE(page.find("conductance [W/K]; required, plausible 0.2 W/K to 5 W/K"), std::string::npos) << page;
  EXPECT_NE(page.find("Signature   sink with speed"), std::string::npos) << page;
  EXPECT_NE(page.find("Looks like  bearing, preload"), std::string::npos) << page;
  EXPECT_NE(page.find("Told apart  cooling at standstill"), std::string::npos) << page;
  EXPECT_NE(page.find("Tried       conductance up to 5 W/K at every shaft"), std::string::npos) << page;
  EXPECT_EQ(effect_page(effect("annular_gap")).find("Looks like"), std::string::npos);
}

TEST(EffectPage, ListsEveryEffectOnALineOfItsOwn) {
  std::stringstream lines(effect_list());
  for (auto const& entry : effect_catalogue()) {
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line.substr(0, line.find(' ')), entry.name);
    EXPECT_NE(line.find(entry.meaning), std::string::npos) << line;
  }
}

std::string page_of(std::string const& name) {
  return table_page(tests::only(describe_machine(), [&](auto const& table) { return table.name == name; }));
}

TEST(EffectPage, ShowsTheTablesOfAMachineFile) {
  auto const page = page_of("displacement");
  EXPECT_NE(page.find("segment"), std::string::npos);
  EXPECT_NE(page.find("\n      against"), std::string::npos) << page;
}

TEST(EffectPage, ShowsDefaultsOfListsAndWhatIsRequired) {
  auto const page = page_of("block");
  EXPECT_NE(page.find("list of number; default [10, 10, 10]"), std::string::npos) << page;
  EXPECT_NE(page.find("three times length [m]; required"), std::string::npos) << page;
  EXPECT_NE(page.find("default [\"0 mm\", \"0 mm\", \"0 mm\"]"), std::string::npos) << page;
  EXPECT_NE(page_of("channel").find("face: wall"), std::string::npos);
}

TEST(EffectsMarkdown, IsWhatTheDocumentationHolds) {
  std::ifstream file(std::filesystem::path(THERMOTWIN_SOURCE_DIR) / "docs" / "effects.md");
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_TRUE(text.str() == effects_markdown()) << "write it anew: thermotwin effects --markdown > docs/effects.md";
}

}  // namespace
}  // namespace thermotwin::twin
