#include "twin/placement/sensor_placement.h"

#include <algorithm>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "models/placement.h"
#include "tests/output/temporary_directory.h"
#include "tests/twin/random_machine.h"
#include "thermal/error.h"
#include "twin/experiment_file.h"
#include "twin/machine.h"
#include "twin/placement/snapshot_moments.h"
#include "twin/turning_bodies.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

Value v450() { return read_toml(machine_file("v450")); }

PlacementOptions quick(int sensors) {
  PlacementOptions options;
  options.sensors = sensors;
  options.design.members = 10;
  options.unseen_members = 6;
  return options;
}

std::string refusal(Value const& document, PlacementOptions const& options) {
  try {
    (void)place_sensors(document, options);
  } catch (thermal::InputError const& error) {
    return error.what();
  }
  return "";
}

CandidateRules rules_from(std::string const& text) {
  tests::TemporaryDirectory const directory;
  auto const path = directory.path() / "candidates.toml";
  std::ofstream(path) << text;
  return read_candidate_rules(path);
}

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

/// A sensor in every place that moves the tool leaves what the uncertain growth of the parts and its noise leave.
TEST(SnapshotMoments, ForetellTheErrorOnMachinesThatTookNoPart) {
  RandomMachine const machine(5);
  auto const document = parse_toml(machine.text(), "random");
  std::vector<CandidateSite> sites;
  for (auto const& body : machine.bodies()) sites.push_back({body, {body}});
  EnsembleOptions options;
  options.members = 60;
  auto const design = draw_ensemble(document, sites, options);
  options.seed = 5000;
  auto const unseen = draw_ensemble(document, sites, options);
  SnapshotMoments const moments(design, 0.1);
  auto const problem = moments.problem(Index(sites.size()));
  auto const set = models::place(problem, 4).sensors;
  double const predicted = moments.cross_validated(set).mean_square.sum();
  double const realised = error_on(unseen, moments.estimate(set), moments.noise_variance()).mean_square.sum();
  EXPECT_NEAR(predicted / realised, 1.0, 0.25);  // 60 machines, so 20 % of chance
  EXPECT_GT(predicted, models::remaining_variance(problem, set));
  EXPECT_NEAR(error_on(design, moments.estimate(set), moments.noise_variance()).mean_square.sum(),
              models::remaining_variance(problem, set), 1e-6 * problem.prior());
}

/// A displacement that follows one site, in every machine with a gain of its own: trained on the machine, a sensor
/// there leaves little more than its noise; one estimate for all machines is left with what the gains differ by.
TEST(SnapshotMoments, OfMachinesThatTeachThemselvesKnowTheirGains) {
  constexpr Index rows = 60, members = 8;
  Ensemble ensemble;
  ensemble.channels = {"E"};
  ensemble.rise.resize(rows * members, 1);
  ensemble.displacement.resize(rows * members, 1);
  for (Index m = 0; m < members; ++m) {
    for (int run = 0; run < 2; ++run) ensemble.runs.push_back({int(m), "", m * rows + run * (rows / 2), rows / 2});
    for (Index r = 0; r < rows; ++r) {
      ensemble.rise(m * rows + r, 0) = 10.0 * std::sin(0.3 * double(r));
      ensemble.displacement(m * rows + r, 0) = (2.0 + 0.2 * double(m % 2)) * ensemble.rise(m * rows + r, 0);
    }
  }
  SnapshotMoments const family(ensemble, 0.1), machine(ensemble, 0.1, Teacher::machine);
  EXPECT_EQ(machine.groups().size(), std::size_t(members));
  Index const site = 0;
  double const noise = 0.1 * 2.1, spread = 0.1 * 10.0 * std::sqrt(0.5);
  EXPECT_NEAR(std::sqrt(models::remaining_variance(machine.problem(1), {&site, 1})), noise, 0.02 * noise);
  EXPECT_NEAR(std::sqrt(models::remaining_variance(family.problem(1), {&site, 1})), std::hypot(noise, spread),
              0.05 * spread);
  EXPECT_NEAR(std::sqrt(machine.cross_validated({&site, 1}).mean_square.sum()), noise, 0.05 * noise);
  EXPECT_NEAR(std::sqrt(machine.unseen(ensemble, {&site, 1}).of_members[3]), 0.1 * 2.2, 0.05 * noise);
  ensemble.runs.resize(1);
  EXPECT_THROW(SnapshotMoments(ensemble, 0.1, Teacher::machine), thermal::InputError);
}

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
