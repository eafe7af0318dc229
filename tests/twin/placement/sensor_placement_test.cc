#include "twin/placement/sensor_placement.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tests/twin/placement/quick_placement.h"
#include "tests/twin/random_machine.h"
#include "twin/experiment_file.h"
#include "twin/machine.h"

namespace thermotwin::twin {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

TEST(PlaceSensors, ForAModelTrainedOnTheMachineLeavesLess) {
  auto options = quick(3);
  auto const one_for_all = place_sensors(v450(), options);
  options.teacher = Teacher::machine;
  options.map = true;
  auto const report = place_sensors(v450(), options);
  EXPECT_LT(report.recommended.model_um, one_for_all.recommended.model_um);
  EXPECT_GE(report.recommended.predicted_um, report.recommended.model_um);
  EXPECT_LT(report.recommended.unseen_um, 2.0 * report.recommended.predicted_um);
  EXPECT_LE(report.map->beside_um.maxCoeff<Eigen::PropagateNumbers>(), report.recommended.model_um);
  EXPECT_THAT(placement_text(report), HasSubstr("trained on itself"));
  EXPECT_TRUE(nlohmann::json::parse(placement_json(report))["trained_on_the_machine"]);
}

TEST(PlaceSensors, TellsWhatSensorsAreWorth) {
  auto options = quick(4);
  options.proposed = {"T1", "T2", "T3", "T6"};
  options.map = true;
  auto const report = place_sensors(v450(), options);
  auto const& best = report.recommended;
  ASSERT_EQ(best.sensors.size(), 4U);
  EXPECT_LT(best.model_um, report.prior_um);
  EXPECT_GE(best.model_um, report.floor_um);
  EXPECT_GE(best.model_um, report.bound_um * (1.0 - 1e-9));
  EXPECT_GE(report.fewer->model_um, best.model_um);
  EXPECT_LE(report.more->model_um, best.model_um);
  auto const& proposed = report.proposed.value();
  EXPECT_GE(proposed.set.model_um, best.model_um);
  double least = INFINITY;
  for (auto const& sensor : proposed.set.sensors) least = std::min(least, sensor.error_without_um);
  EXPECT_NEAR(proposed.fewer->model_um, least, 1e-9 * least);
  EXPECT_LE(proposed.more->model_um, proposed.set.model_um);
  EXPECT_LE(best.unseen_low_um, best.unseen_high_um);
  for (auto const& sensor : best.sensors) EXPECT_GE(sensor.error_without_um, best.model_um);
  auto const machine = Machine::build(v450());
  ASSERT_EQ(report.map->alone_um.size(), machine.network().nodes());
  EXPECT_GE(report.map->alone_um.minCoeff<Eigen::PropagateNumbers>(), 0.0);
  EXPECT_LE(report.map->alone_um.maxCoeff<Eigen::PropagateNumbers>(), report.prior_um);
}

/// T6 sits on head_front: one of the two tells nothing that the other does not.
TEST(PlaceSensors, FindsTheIdleSensorOfAProposal) {
  auto options = quick(3);
  options.proposed = {"head_front", "T6", "column_front"};
  auto const report = place_sensors(v450(), options);
  std::vector<std::string> idle;
  for (auto const& sensor : report.proposed->set.sensors)
    if (sensor.idle) idle.push_back(sensor.site.name);
  EXPECT_THAT(idle, testing::ElementsAre(testing::AnyOf("head_front", "T6")));
}

/// Of three sensors at one place, two are idle: the third and the one elsewhere would do.
TEST(PlaceSensors, SaysHowManySensorsWouldDo) {
  auto options = quick(4);
  options.rules.sites = {{"a", {"head_front"}}, {"b", {"head_front"}}, {"c", {"head_front"}}, {"d", {"column_front"}}};
  auto const all = place_sensors(v450(), options);
  EXPECT_THAT(all.remarks,
              testing::ElementsAre("2 would do: without the 2 idle ones the error is less than 1 % larger"));
  EXPECT_THAT(placement_text(all), HasSubstr(all.remarks.front()));
  options.sensors = 3;
  EXPECT_THAT(place_sensors(v450(), options).remarks,
              testing::ElementsAre("2 would do: without the idle one the error is less than 1 % larger"));
  options.sensors = 2;
  auto const two = place_sensors(v450(), options);
  EXPECT_THAT(two.remarks, testing::IsEmpty());
  EXPECT_LT(two.recommended.model_um, 1.01 * all.recommended.model_um);
  options.sensors = 4;
  options.dead = 1;  // the others are spares then
  EXPECT_THAT(place_sensors(v450(), options).remarks, testing::IsEmpty());
}

/// The best set of all is what one more sensor makes of all but one of it.
TEST(PlaceSensors, FindsTheSensorThatAProposalLacks) {
  auto options = quick(3);
  auto const best = place_sensors(v450(), options).recommended;
  options.proposed = {best.sensors[0].site.name, best.sensors[2].site.name};
  auto const report = place_sensors(v450(), options);
  EXPECT_EQ(report.proposed->with, best.sensors[1].site.name);
  EXPECT_NEAR(report.proposed->more->model_um, best.model_um, 1e-9 * best.model_um);
  EXPECT_THAT(placement_text(report), HasSubstr("proposed + " + best.sensors[1].site.name));
}

TEST(PlaceSensors, TellsMissingEffectsApart) {
  RandomMachine const machine(3, 4, 1);
  auto options = quick(2);
  options.design.members = options.unseen_members = 3;
  options.distinguish = true;
  auto const report = place_sensors(parse_toml(machine.text(), "random"), options);
  auto const& distinction = report.distinction.value();
  EXPECT_GT(distinction.effects, 5U);
  EXPECT_GE(distinction.recommended, distinction.for_displacement);
  EXPECT_GT(distinction.recommended, 0.0);
  EXPECT_LT(distinction.recommended, 1.5708);
  EXPECT_TRUE(distinction.proved);
  EXPECT_TRUE(distinction.fewer && distinction.more);
  EXPECT_THAT(placement_text(report), HasSubstr("no set of 2 has a wider one: all were looked at"));
}

/// What a proposal sees, and no candidate, is not what the others are chosen and judged by.
TEST(PlaceSensors, TellsEffectsApartRegardlessOfWhatIsProposed) {
  Value const document = parse_toml(RandomMachine(3, 4, 1).text(), "random");
  auto options = quick(2);
  options.design.members = options.unseen_members = 3;
  options.distinguish = true;
  options.rules.sites = {{"a", {"loop_0"}}, {"b", {"loop_1"}}, {"c", {"loop_2"}}};
  auto const alone = place_sensors(document, options);
  options.proposed = {"loop_3", "beside_0"};
  auto const beside = place_sensors(document, options);
  EXPECT_EQ(beside.distinction->effects, alone.distinction->effects);
  EXPECT_EQ(beside.distinction->pairs, alone.distinction->pairs);
  EXPECT_NEAR(beside.distinction->recommended, alone.distinction->recommended, 1e-6);
  EXPECT_NEAR(beside.distinction->of_all, alone.distinction->of_all, 1e-6);
}

/// Without the sites that tell effects apart best, which nobody can pay.
TEST(PlaceSensors, TellsMissingEffectsApartWithinTheBudget) {
  Value const document = parse_toml(RandomMachine(3, 4, 1).text(), "random");
  auto options = quick(2);
  options.design.members = options.unseen_members = 3;
  options.distinguish = true;
  auto const any = place_sensors(document, options);
  options.rules.sites = candidate_sites(document, {});
  options.rules.budget = 2.0;
  for (auto const& sensor : any.recommended.sensors)
    for (auto& site : options.rules.sites)
      if (site.name == sensor.site.name) site.cost = 3.0;
  auto const report = place_sensors(document, options);
  EXPECT_LE(report.recommended.cost, 2.0);
  EXPECT_EQ(report.recommended.sensors.size(), 2U);
  auto const json = nlohmann::json::parse(placement_json(report));
  EXPECT_FALSE(json["all_sets_looked_at"]) << "they were for the error, which was not asked for";
  EXPECT_FALSE(json.contains("above_bound"));
}

/// A third sensor is not to be had for the money, and the second, in the room, widens no angle: that is said of both.
TEST(PlaceSensors, WidensNoAngleBeyondTheBudget) {
  auto options = quick(3);
  options.design.members = options.unseen_members = 3;
  options.distinguish = true;
  options.rules.budget = 2.0;
  options.rules.sites = {{"head", {"head_front"}, 2.0},
                         {"column", {"column_rear"}, 1.0},
                         {"ring", {"cartridge[90 mm]"}, 5.0},
                         {"motor", {"motor"}, 1.0},
                         {"room", {"ambient"}, 0.5}};
  auto const report = place_sensors(v450(), options);
  ASSERT_EQ(report.recommended.sensors.size(), 2U);
  auto const& distinction = report.distinction.value();
  EXPECT_FALSE(distinction.more);
  EXPECT_NEAR(distinction.fewer.value(), distinction.recommended, 0.01 * distinction.recommended);
  EXPECT_THAT(distinction.idle, testing::ElementsAre("room"));
  EXPECT_THAT(report.remarks, Contains("without room the smallest angle is less than 1 % narrower"));
  auto const json = nlohmann::json::parse(placement_json(report))["distinction"];
  EXPECT_FALSE(json.contains("one_more_deg"));
  EXPECT_EQ(json["idle"], std::vector<std::string>{"room"});
}

/// Every one of the sites has room for the sensor and two spares.
TEST(PlaceSensors, MayBeMoreThanSitesWithSpares) {
  auto options = quick(5);
  options.dead = 2;
  options.rules.sites = {{"head", {"head_front"}}, {"column", {"column_front"}}};
  auto const report = place_sensors(v450(), options);
  EXPECT_EQ(report.recommended.sensors.size(), 5U);
  EXPECT_THAT(placement_text(report), testing::StartsWith("5 sensors for 2 sites on v450"));
  EXPECT_THAT(report.taken, Contains("T1"));
  options.sensors = 7;
  EXPECT_THAT(refusal(v450(), options), HasSubstr("7 sensors, but only 2 candidate sites with room for 3 each"));
}

/// By the author's names where the machine has no sensor of that name.
TEST(PlaceSensors, KeepTheNamesOfTheirSites) {
  PlacementReport report;
  report.taken = {"T1", "P1"};
  for (CandidateSite const& site : {CandidateSite{"nose", {"cartridge[10 mm]"}}, {"T1", {"motor"}}, {"bed", {"bed"}}})
    report.recommended.sensors.push_back({site, {}, 0.0, false});
  std::vector<std::string> names;
  Value const tables = parse_toml(sensor_tables(report), "sensors.toml");
  for (auto const& table : std::get<Value::List>(tables.find("temperature_sensor")->content))
    names.push_back(std::get<std::string>(table.find("name")->content));
  EXPECT_THAT(names, testing::ElementsAre("nose", "P2", "P3"));
}

TEST(PlaceSensors, PutsSparesBesideSensorsThatAreThere) {
  auto options = quick(4);
  options.dead = 1;
  options.rules.sites = {
      {"head", {"head_front"}}, {"column", {"column_front"}}, {"ring", {"front_ring"}}, {"bed", {"bed"}}};
  auto const report = place_sensors(v450(), options);
  std::vector<std::string> names;
  for (auto const& sensor : report.recommended.sensors) names.push_back(sensor.site.name);
  for (auto const& name : names) EXPECT_THAT(names, Contains(name.substr(0, name.find(" (spare)"))));
  EXPECT_LE(report.recommended.model_um, report.recommended.worst_um);
}

TEST(PlaceSensors, SpeaksToPeopleAndPrograms) {
  auto options = quick(2);
  options.dead = 1;
  auto const report = place_sensors(v450(), options);
  auto const text = placement_text(report);
  EXPECT_THAT(text, HasSubstr("recommended"));
  EXPECT_THAT(text, HasSubstr("with any 1 of them dead"));
  EXPECT_THAT(text, HasSubstr("no set of 2, all at work, has less than"));
  auto const json = nlohmann::json::parse(placement_json(report));
  EXPECT_EQ(json["recommended"]["sensors"].size(), 2U);
  EXPECT_NEAR(json["recommended"]["model_um"], report.recommended.model_um, 1e-9);
  auto document = v450();
  std::string const file = "name = \"x\"\n" + sensor_tables(report);
  EXPECT_EQ(std::get<Value::List>(parse_toml(file, "tables").find("temperature_sensor")->content).size(), 2U);
}

/// Long names, air that has no place, and a set that is no better than another by what is printed.
TEST(PlaceSensors, TabulatesSets) {
  auto options = quick(2);
  options.rules.sites = {{"in the room", {"ambient"}}, {"nose, left of the front ring", {"cartridge[10 mm]"}}};
  options.proposed = {"in the room"};
  auto const text = placement_text(place_sensors(v450(), options));
  EXPECT_THAT(text, HasSubstr(" room air "));
  EXPECT_THAT(text, Not(HasSubstr("-0.0 %")));
  std::set<std::size_t> ends;
  std::istringstream lines(text.substr(text.find("all displacements")));
  for (std::string line; std::getline(lines, line) && !line.empty();)
    if (line.ends_with(" %")) ends.insert(line.size());
  EXPECT_EQ(ends.size(), 1U) << text;
  EXPECT_THAT(text, HasSubstr("proposed + nose, left of the front ring "));
}

TEST(PlaceSensors, SaysWhatABudgetLeavesOf) {
  auto options = quick(4);
  options.rules.budget = 2.0;
  options.rules.forbidden = {"bed"};
  options.proposed = {"T1", "T2", "bed"};
  auto const report = place_sensors(v450(), options);
  EXPECT_EQ(report.recommended.sensors.size(), 2U);
  ASSERT_TRUE(report.fewer);
  EXPECT_EQ(report.fewer->sensors.size(), 1U);
  EXPECT_GT(report.fewer->model_um, report.recommended.model_um);
  EXPECT_FALSE(report.more) << "no money is left";
  EXPECT_THAT(report.remarks,
              testing::ElementsAre("4 were asked for; the budget of 2 has room for no better set than these 2",
                                   "the proposed set sits on what is forbidden: bed",
                                   "the proposed set costs 3, more than the budget of 2"));
  EXPECT_THAT(placement_text(report), HasSubstr(report.remarks.front()));
}

/// A room that does not move: nothing ends the set but what sites tell.
TEST(PlaceSensors, SaysWhereNoOtherSiteTellsMore) {
  auto options = quick(2);
  options.rules.sites = {{"head", {"head_front"}}, {"room", {"ambient"}}};
  auto const spectrum = experiment_file("golden_b_4000");
  options.design.experiments = {read_experiment(read_toml(spectrum), spectrum)};
  auto const report = place_sensors(v450(), options);
  ASSERT_EQ(report.recommended.sensors.size(), 1U);
  EXPECT_THAT(report.remarks,
              testing::ElementsAre("2 were asked for; beside this one, no other site tells anything more"));
}

/// T6 sits on head_front, T8 on the motor.
TEST(PlaceSensors, PricesASensorByItsBody) {
  auto options = quick(1);
  options.rules.budget = 3.0;
  options.rules.bodies = {{"head_front", 4.0}, {"motor", 2.0}};
  options.rules.forbidden = {"motor"};
  options.proposed = {"T6", "T8"};
  auto const report = place_sensors(v450(), options);
  EXPECT_EQ(report.proposed->set.cost, 6.0);
  EXPECT_THAT(report.remarks, testing::ElementsAre("the proposed set sits on what is forbidden: motor",
                                                   "the proposed set costs 6, more than the budget of 3"));
}

TEST(PlaceSensors, SaysWhichSitesTurn) {
  auto options = quick(1);
  options.rules = rules_from("[[site]]\nname = \"nose\"\nat = \"shaft[20 mm]\"\n[[site]]\nat = \"bed\"\n");
  auto const report = place_sensors(v450(), options);
  ASSERT_EQ(report.recommended.sensors[0].site.name, "nose");
  EXPECT_THAT(report.remarks, Contains("the recommended set sits on what turns: shaft; its signals need a way out"));
}

TEST(PlaceSensors, RefusesWhatCannotBe) {
  EXPECT_THAT(refusal(v450(), quick(0)), HasSubstr("at least 1"));
  EXPECT_THAT(refusal(v450(), quick(500)), HasSubstr("candidate sites"));
  auto options = quick(3);
  options.dead = 3;
  EXPECT_THAT(refusal(v450(), options), HasSubstr("3 of 3 sensors dead"));
  options.dead = 1;
  options.distinguish = true;
  EXPECT_THAT(refusal(v450(), options), HasSubstr("either to outlive dead ones or to tell effects apart"));
  options = quick(3);
  options.proposed = {"T1", "haed_front"};
  EXPECT_THAT(refusal(v450(), options), HasSubstr("did you mean 'head_front'?"));
  options.proposed = {"T1", "motor", "T1"};
  EXPECT_THAT(refusal(v450(), options), HasSubstr("'T1' is proposed twice"));
  options.proposed = {"cartridge[900 mm]"};
  EXPECT_THAT(refusal(v450(), options), HasSubstr("900 mm is outside 'cartridge'"));
  EXPECT_THAT(refusal(read_toml(machine_file("water_pipe")), quick(1)), HasSubstr("no displacement"));
  EXPECT_THAT(refusal(read_toml(machine_file("spindle_5probe")), quick(1)),
              HasSubstr("no step of its structural loop has a weight"));
}

}  // namespace
}  // namespace thermotwin::twin
