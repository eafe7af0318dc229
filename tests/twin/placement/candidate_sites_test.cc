#include "twin/placement/candidate_sites.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "tests/twin/placement/quick_placement.h"
#include "thermal/error.h"
#include "twin/machine.h"
#include "twin/turning_bodies.h"

namespace thermotwin::twin {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> names_of(std::vector<CandidateSite> const& sites) {
  std::vector<std::string> names;
  for (auto const& site : sites) names.push_back(site.name);
  return names;
}

TEST(CandidateSites, AreOnWhatStandsStill) {
  auto const document = v450();
  EXPECT_THAT(turning_bodies(document), testing::UnorderedElementsAre("shaft", "test_bar", "rotor"));
  for (auto const& name : names_of(candidate_sites(document, {}))) {
    EXPECT_FALSE(name.starts_with("shaft")) << name;
    EXPECT_FALSE(name.starts_with("test_bar")) << name;
    EXPECT_FALSE(name.starts_with("rotor")) << name;
  }
}

TEST(CandidateSites, CoverEverySolidWithinTheNumberAllowed) {
  auto const document = read_toml(machine_file("v450_fine"));
  CandidateRules rules;
  rules.most = 60;
  rules.forbidden = {"table"};
  auto const names = names_of(candidate_sites(document, rules));
  EXPECT_EQ(names.size(), 60U);
  for (std::string const body : {"bed", "column", "head", "cartridge", "front_ring", "motor"})
    EXPECT_THAT(names, Contains(testing::StartsWith(body))) << body;
  EXPECT_THAT(names, Contains("ambient"));
  EXPECT_THAT(names, Not(Contains(testing::StartsWith("table"))));
  EXPECT_NO_THROW((void)Machine::build(with_sensors_at(document, candidate_sites(document, rules))));
}

TEST(CandidateSites, AreThoseOfAFileWithTheirCosts) {
  auto const rules = rules_from(
      "budget = 3.5\n[[site]]\nat = \"head_front\"\ncost = 2.5\n[[site]]\nname = \"C\"\nat = \"cartridge[20 mm]\"\n"
      "[[site]]\nat = \"column_rear\"\n");
  auto const sites = candidate_sites(v450(), rules);
  EXPECT_THAT(names_of(sites), testing::ElementsAre("head_front", "C", "column_rear"));
  EXPECT_EQ(sites[0].cost, 2.5);
  auto options = quick(3);
  options.rules = rules;
  EXPECT_LE(place_sensors(v450(), options).recommended.cost, 3.5);
}

/// A site of which the file says no cost has that of its body, the dearest of several.
TEST(CandidateSites, CostWhatTheirBodiesCost) {
  auto const rules = rules_from(
      "[[site]]\nname = \"nose\"\nat = \"cartridge[10 mm]\"\n[[site]]\nat = [\"bed\", \"motor\"]\n[[site]]\nname = "
      "\"ring\"\nat = \"motor\"\ncost = 1.5\n[[body]]\nname = \"motor\"\ncost = 3\n[[body]]\nname = \"bed\"\ncost = "
      "0.5\n");
  auto const sites = candidate_sites(v450(), rules);
  EXPECT_EQ(sites[0].cost, 1.0);
  EXPECT_EQ(sites[1].cost, 3.0);
  EXPECT_EQ(sites[2].cost, 1.5);
  EXPECT_EQ(cost_at({"motor"}, rules), 1.5) << "a site there says so";
  EXPECT_EQ(cost_at({"motor.surface[0 mm]"}, rules), 3.0);
  EXPECT_EQ(cost_at({"bed"}, rules), 0.5);
  EXPECT_EQ(cost_at({"ambient"}, rules), 1.0);
}

TEST(CandidateSites, RefuseWhatIsNotThere) {
  CandidateRules rules;
  rules.forbidden = {"colum_front"};
  auto options = quick(3);
  options.rules = rules;
  EXPECT_THAT(refusal(v450(), options), HasSubstr("did you mean 'column_front'?"));
  EXPECT_THROW((void)rules_from("[[site]]\nname = \"A\"\n"), FileError);
  EXPECT_THROW((void)rules_from("fobidden = [\"head\"]\n"), FileError);
}

TEST(CandidateSites, SayWhereTheirFileIsWrong) {
  auto const complaint = [](std::string const& text) {
    auto options = quick(2);
    options.rules = rules_from(text);
    return refusal(v450(), options);
  };
  EXPECT_THAT(complaint("forbidden = [\"column_front\", \"colum_front\"]\n"),
              HasSubstr("candidates.toml:1:30: unknown body 'colum_front'; did you mean 'column_front'?"));
  EXPECT_THAT(complaint("[[body]]\ncost = 2\nname = \"mottor\"\n"),
              HasSubstr("candidates.toml:3:8: unknown body 'mottor'; did you mean 'motor'?"));
  EXPECT_THAT(complaint("[[body]]\nname = \"motor\"\ncost = 0\n"),
              HasSubstr("candidates.toml:3:8: 'cost' is 0; it must be positive"));
  std::string const motor = "[[site]]\nat = \"motor\"\n";
  EXPECT_THAT(complaint(motor + "[[site]]\nname = \"nose\"\nat = \"cartridge[900 mm]\"\n"),
              HasSubstr("candidates.toml:5:6: 900 mm is outside 'cartridge', which is 320 mm long"));
  EXPECT_THAT(complaint("forbidden = [\"bed\", \"motor\"]\n" + motor),
              HasSubstr("candidates.toml:3:6: a site on 'motor', which 'forbidden' names, too"));
  EXPECT_THAT(complaint(motor + "[[site]]\nat = \"cartrige[20 mm]\"\n"),
              HasSubstr("candidates.toml:4:6: unknown body 'cartrige'; did you mean 'cartridge'?"));
  EXPECT_THAT(complaint("most = 0\n"), HasSubstr("candidates.toml:1:8: 'most' is 0; a mesh has at least one site"));
  EXPECT_THAT(complaint("budget = 0.5\n"),
              HasSubstr("candidates.toml:1:10: a 'budget' of 0.5 buys no sensor: the cheapest, at 'ambient', costs 1"));
}

TEST(CandidateSites, HaveNamesOfTheirOwn) {
  using testing::ThrowsMessage;
  EXPECT_THAT([] { rules_from("[[site]]\nname = \"a\"\nat = \"motor\"\n[[site]]\nname = \"a\"\nat = \"bed\"\n"); },
              ThrowsMessage<thermal::InputError>(HasSubstr("candidates.toml:5:8: the name 'a' is taken")));
  EXPECT_THAT([] { rules_from("[[body]]\nname = \"bed\"\n[[body]]\nname = \"bed\"\ncost = 2\n"); },
              ThrowsMessage<thermal::InputError>(HasSubstr("candidates.toml:4:8: the name 'bed' is taken")));
}

/// Everything may be left out, and so may all of it.
TEST(CandidateSites, OfAnEmptyFileAreThoseOfNoFile) {
  EXPECT_EQ(names_of(candidate_sites(v450(), rules_from(""))), names_of(candidate_sites(v450(), {})));
}

TEST(CandidateSites, HaveRoomForSpares) {
  auto const sites = with_spares({{"a", {"motor"}, 2.0}, {"b", {"bed"}, 1.0}}, 2);
  EXPECT_THAT(names_of(sites), testing::ElementsAre("a", "b", "a (spare)", "b (spare)", "a (spare 2)", "b (spare 2)"));
  EXPECT_EQ(sites[4].cost, 2.0);
  EXPECT_EQ(sites[4].at, sites[0].at);
}

}  // namespace
}  // namespace thermotwin::twin
