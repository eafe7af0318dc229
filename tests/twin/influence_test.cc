#include "twin/influence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sstream>

#include "tests/output/temporary_directory.h"
#include "tests/scenarios/refusal.h"
#include "thermal/block.h"
#include "twin/elastic_block.h"
#include "twin/influence_file.h"
#include "twin/needed_solution.h"

namespace thermotwin::twin {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using thermotwin::tests::refusal;

thermal::Material iron() { return thermal::material("GJL-300"); }

thermal::Body column() { return thermal::make_body("column", {iron(), {0, 0, 0}, {0.4, 0.5, 1.0}, {1, 1, 2}, 1.0}); }

InfluenceDescription on_top(Eigen::Vector3d const& point, double weight) {
  InfluenceDescription influence;
  influence.body = "column";
  influence.fixed = "z_min";
  influence.loaded = "z_max";
  influence.point = point;
  influence.weight = weight;
  return influence;
}

std::string key(int load) {
  return solution_key(elastic_block(column(), iron().poisson_ratio, "z_min", "z_max"), load);
}

std::vector<std::pair<int, double>> weights_of(std::filesystem::path const& machine,
                                               InfluenceDescription const& influence, std::string const& direction,
                                               bool rotation = false) {
  std::vector<std::pair<int, double>> weights;
  add_influence(weights, machine, influence, direction, column(), iron(), 7, rotation);
  return weights;
}

TEST(Influence, WeightsAreExpansionTimesForceAndLeversTimesSolutions) {
  tests::TemporaryDirectory const directory;
  write_solutions(directory / "mill.weights", {{key(2), {"force", {1.0, 2.0}}}, {key(4), {"moment", {30.0, -0.125}}}});
  auto const weights = weights_of(directory / "mill.toml", on_top({0.2 + 0.1, 0.25, 5.0}, -1.0), "-z");
  double const alpha = iron().expansion;
  ASSERT_EQ(weights.size(), 2u);
  EXPECT_EQ(weights[0].first, 7);
  EXPECT_EQ(weights[1].first, 8);
  EXPECT_NEAR(weights[0].second, alpha * (1.0 - 0.1 * 30.0), 1e-15);
  EXPECT_NEAR(weights[1].second, alpha * (2.0 + 0.1 * 0.125), 1e-15);
  auto const tilt = weights_of(directory / "mill.toml", on_top({0, 0, 0}, 1.0), "y", true);
  EXPECT_NEAR(tilt[0].second, alpha * 30.0, 1e-15);
}

TEST(Influence, SolutionsAreFoundBesideTheMachineOrItsNeighbours) {
  tests::TemporaryDirectory const directory;
  EXPECT_FALSE(find_solution(directory / "mill.toml", key(0)));
  write_solutions(directory / "lathe.weights", {{key(0), {"", {1.5e-7, -2.0}}}});
  EXPECT_EQ(find_solution(directory / "mill.toml", key(0)), (std::vector<double>{1.5e-7, -2.0}));
  write_solutions(directory / "mill.weights", {{key(0), {"", {3.0, 4.0}}}});
  EXPECT_EQ(find_solution(directory / "mill.toml", key(0)), (std::vector<double>{3.0, 4.0}));
}

TEST(Influence, MissingOrDamagedSolutionsNameTheCommandThatMakesThem) {
  tests::TemporaryDirectory const directory;
  auto const machine = directory / "mill.toml";
  auto const read = [&] { (void)weights_of(machine, on_top({0.2, 0.25, 1.0}, 1.0), "z"); };
  EXPECT_THAT(refusal(read), AllOf(HasSubstr("no influence weights for 'column'"), HasSubstr("force_z"),
                                   HasSubstr("thermotwin weights " + machine.string())));
  tests::put(directory / "mill.weights", key(2) + ",1.0,tw");
  EXPECT_THAT(refusal(read), AllOf(HasSubstr("damaged after 1 numbers"), HasSubstr("mill.weights")));
  tests::put(directory / "mill.weights", key(2) + ",1.0,2.0,3.0");
  EXPECT_THAT(refusal(read), AllOf(HasSubstr("3 numbers"), HasSubstr("2 cells")));
}

TEST(Influence, ClosingLengthIsTheWayBetweenTheFaces) {
  EXPECT_NEAR(closing_length(on_top({9, 9, 9}, 1.0), "z", column()), 1.0, 1e-15);
  EXPECT_NEAR(closing_length(on_top({9, 9, 9}, -2.0), "-z", column()), 2.0, 1e-15);
  EXPECT_NEAR(closing_length(on_top({9, 9, 9}, 1.0), "x", column()), 0.0, 1e-15);
}

constexpr char const* machine = R"(
name = "mill"
[[material]]
name = "iron"
like = "GJL-300"
poisson_ratio = 0.2
[[block]]
name = "column"
material = "iron"
size = ["400 mm", "500 mm", "1000 mm"]
cells = [1, 1, 2]
[[displacement]]
name = "E_X"
direction = "x"
influence = [{ body = "column", fixed = "z_min", loaded = "z_max", point = ["200 mm", "250 mm", "1100 mm"] }]
[[displacement]]
name = "E_Z"
influence = [{ body = "column", fixed = "z_min", loaded = "z_max", point = ["200 mm", "0 mm", "1100 mm"] }]
[[rotation]]
name = "B"
direction = "y"
influence = [{ body = "column", fixed = "z_min", loaded = "z_max" }]
)";

TEST(NeededSolution, OfAllChannelsOfABlockEachUnitLoadOnce) {
  auto const needed = needed_solutions(parse_toml(machine, "mill.toml"));
  std::vector<std::string> loads;
  for (auto const& one : needed) loads.emplace_back(unit_loads[std::size_t(one.load)]);
  EXPECT_THAT(loads, testing::UnorderedElementsAre("force_x", "moment_y", "force_z", "moment_x"));
  EXPECT_EQ(needed[0].block.poisson_ratio, 0.2);
  EXPECT_THAT(needed[0].remark(), AllOf(HasSubstr("column: "), HasSubstr("z_max"), HasSubstr("held at")));
}

TEST(NeededSolution, UnknownBlockIsAnErrorWithItsLine) {
  std::string text = machine;
  text.replace(text.find("body = \"column\""), 15, "body = \"colum\"");
  EXPECT_THAT(refusal([&] { (void)needed_solutions(parse_toml(text, "mill.toml")); }),
              AllOf(HasSubstr("mill.toml:12"), HasSubstr("'colum'"), HasSubstr("'column'")));
}

TEST(NeededSolution, NothingIsWrittenWhereNothingIsDue) {
  tests::TemporaryDirectory const directory;
  tests::put(directory / "mill.toml", "name = \"mill\"\n");
  std::ostringstream progress;
  EXPECT_EQ(write_weights(directory / "mill.toml", progress), 0);
  EXPECT_THAT(progress.str(), HasSubstr("mill.toml: no displacement rests on a block: nothing to compute"));
  EXPECT_EQ(directory.files(), std::vector<std::string>{"mill.toml"});
}

TEST(NeededSolution, WhatIsKnownIsNotSolvedAgain) {
  tests::TemporaryDirectory const directory;
  tests::put(directory / "mill.toml", machine);
  std::map<std::string, Solution> known;
  for (auto const& one : needed_solutions(parse_toml(machine, "mill.toml"))) known[one.key] = {"", {0.25, 0.5}};
  write_solutions(directory / "neighbour.weights", known);
  std::ostringstream progress;
  EXPECT_EQ(write_weights(directory / "mill.toml", progress), 0);
  EXPECT_THAT(progress.str(), HasSubstr("0 of 4 solutions are new"));
  std::filesystem::remove(directory / "neighbour.weights");
  EXPECT_EQ(find_solution(directory / "mill.toml", known.begin()->first), (std::vector<double>{0.25, 0.5}));
}

}  // namespace
}  // namespace thermotwin::twin
