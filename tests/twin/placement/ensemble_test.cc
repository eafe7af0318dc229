#include "twin/placement/ensemble.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/output/temporary_directory.h"
#include "tests/twin/placement/quick_placement.h"
#include "twin/machine.h"

namespace thermotwin::twin {
namespace {

using testing::HasSubstr;

/// Of a machine whose file states what is uncertain, no more is: of a bearing that may have any friction, much more.
TEST(Ensemble, IsDrawnFromTheRangesOfTheFile) {
  std::string const text = tests::contents(machine_file("v450"));
  auto const told = [&](std::string const& from, std::string const& to) {
    auto options = quick(2);
    options.rules = rules_from("most = 30\n");
    return place_sensors(parse_toml(text + fmt::format("\n[[uncertain]]\nname = \"bearing.front.grease_factor\"\n"
                                                       "from = \"{}\"\nto = \"{}\"\n",
                                                       from, to),
                                    "mine.toml"),
                         options);
  };
  auto const known = told("0.549", "0.551"), unknown = told("0.1", "2");
  EXPECT_EQ(known.ranged, 1U);
  EXPECT_GT(known.numbers, 30U);
  EXPECT_LT(known.floor_um, unknown.floor_um);
  EXPECT_THAT(placement_text(known), HasSubstr("1 number drawn within the file's own ranges, "));
  EXPECT_EQ(nlohmann::json::parse(placement_json(known))["numbers_drawn"]["within_stated_ranges"], 1);
}

/// Readings are the temperatures at the sites: every site's own column, and the same whatever stands beside it.
TEST(Ensemble, IsTheSameForTheSameSeed) {
  EnsembleOptions options;
  options.members = 2;
  auto const document = v450();
  std::vector<CandidateSite> const two = {{"a", {"head_front"}}, {"b", {"cartridge[10 mm]"}}}, one = {two[1]};
  auto const a = draw_ensemble(document, two, options), b = draw_ensemble(document, one, options);
  EXPECT_EQ(a.rise.col(1), b.rise.col(0));
  EXPECT_EQ(a.displacement, b.displacement);
  EXPECT_EQ(a.runs.size(), 4U);
  EXPECT_TRUE(a.rise.row(0).isZero());
  EXPECT_THAT(a.channels, testing::ElementsAre("E_X", "E_Y", "E_Z"));
}

/// Whoever draws again with the next seed sees other machines, all of them.
TEST(Ensemble, OfAnotherSeedSharesNoMachine) {
  EnsembleOptions options;
  options.members = 2;
  auto const document = v450();
  std::vector<CandidateSite> const sites = {{"a", {"head_front"}}};
  auto const first = draw_ensemble(document, sites, options);
  options.seed = 2;
  auto const second = draw_ensemble(document, sites, options);
  for (auto const& one : first.runs)
    for (auto const& other : second.runs)
      EXPECT_NE(first.displacement.middleRows(one.first, one.rows),
                second.displacement.middleRows(other.first, other.rows));
}

}  // namespace
}  // namespace thermotwin::twin
