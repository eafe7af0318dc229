#include "twin/challenge/challenge.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <numeric>
#include <sstream>

#include "output/dataset_file.h"
#include "output/error.h"
#include "scenarios/course.h"
#include "tests/scenarios/refusal.h"
#include "thermal/block.h"
#include "thermal/error.h"
#include "twin/assembly.h"
#include "twin/challenge/challenge_runs.h"
#include "twin/challenge/hidden_heat.h"
#include "twin/challenge/refined_form.h"
#include "twin/experiment_file.h"
#include "twin/file/document.h"
#include "twin/run.h"
#include "twin/sensitivity.h"

namespace thermotwin::twin {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;
using thermotwin::tests::refusal;

Value nominal(std::string const& name) { return read_toml(machine_file(name)); }

double total_capacity(Machine const& machine) {
  auto const& capacity = machine.network().capacity();
  return std::accumulate(capacity.begin(), capacity.end(), 0.0);
}

double capacity_of(Machine const& machine, std::string const& body) {
  auto const& range = machine.network().range(body);
  auto const first = machine.network().capacity().begin() + range.first;
  return std::accumulate(first, first + range.count, 0.0);
}

std::string text_of(std::filesystem::path const& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

class RefinedFormOf : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Machines, RefinedFormOf, testing::Values("v450", "vmc850", "g200"));

TEST_P(RefinedFormOf, HasTenTimesTheNodesAndTheSameHeatCapacities) {
  auto const document = nominal(GetParam());
  Machine const lumped = Machine::build(document), refined = Machine::build(refined_form(document));
  EXPECT_GE(refined.network().nodes(), 10 * lumped.network().nodes());
  for (auto const& range : lumped.network().ranges())
    EXPECT_NEAR(capacity_of(refined, range.name) / capacity_of(lumped, range.name), 1.0, 1e-9) << range.name;
  EXPECT_NEAR(total_capacity(refined), total_capacity(lumped), 10.0);  // plates: 1 J/K each
}

TEST_P(RefinedFormOf, KeepsAreasOfFilmsAndLengthsOfTheLoop) {
  auto const document = nominal(GetParam());
  Value before = document, after = refined_form(document);
  auto const films = tables_of(before, "film"), refined = tables_of(after, "film");
  ASSERT_EQ(films.size(), refined.size());
  for (std::size_t i = 0; i < films.size(); ++i) {
    EXPECT_EQ(name_in(*films[i]), name_in(*refined[i]));
    EXPECT_EQ(number_in(*films[i], "area", dimension::area), number_in(*refined[i], "area", dimension::area));
  }
  Machine const lumped = Machine::build(document), fine = Machine::build(after);
  ASSERT_EQ(lumped.displacements.size(), fine.displacements.size());
  for (std::size_t c = 0; c < lumped.displacements.size(); ++c) {
    auto const growth_of_uniform_warming = [](Displacement const& d) {
      return std::accumulate(d.weights.begin(), d.weights.end(), 0.0,
                             [](double s, auto const& w) { return s + w.second; });
    };
    EXPECT_NEAR(growth_of_uniform_warming(lumped.displacements[c]), growth_of_uniform_warming(fine.displacements[c]),
                1e-12);
  }
}

/// Same room, same heat: the refined machine rises like the lumped one, but not exactly so.
TEST_P(RefinedFormOf, IsTheSameMachineWithAnotherForm) {
  auto const document = nominal(GetParam());
  Machine const lumped = Machine::build(document), refined = Machine::build(refined_form(document));
  auto experiment = challenge_runs(lumped.limits, 3)[0];
  RunOptions const options;
  auto const a = run(lumped, experiment, options), b = run(refined, experiment, options);
  double difference = 0.0, range = 0.0;
  for (std::size_t s = 0; s < a.dataset.truth_readings.size(); ++s) {
    auto const& values = a.dataset.truth_readings[s].values;
    difference += (b.dataset.truth_readings[s].values - values).squaredNorm() / double(values.size());
    range += std::pow(values.maxCoeff() - values.minCoeff(), 2);
  }
  EXPECT_GT(std::sqrt(difference / range), 0.01);
  EXPECT_LT(std::sqrt(difference / range), 0.10);
}

TEST_P(RefinedFormOf, GivesToTheRoomWhatItsSourcesMake) {
  Machine const machine = Machine::build(refined_form(nominal(GetParam())));
  auto const experiment = challenge_runs(machine.limits, 3)[0];
  RunOptions options;
  auto const result = run(machine, experiment, options);
  EXPECT_GT(result.summary.energy.supplied, 1e5);
  EXPECT_LT(result.summary.energy_imbalance(), 1e-9);
}

/// A slab with one watt through one face: the face is L/(3 k A) warmer than the mean, the half cell included.
TEST(RefinedForm, KnowsWhatASlabResists) {
  thermal::Material metal;
  metal.conductivity = 50.0, metal.density = 7000.0, metal.specific_heat = 500.0;
  auto const body = thermal::make_body("slab", thermal::Block{metal, {0, 0, 0}, {0.2, 0.3, 0.4}, {40, 3, 3}, 1.0});
  double const exact = 0.2 / (3.0 * 50.0 * 0.3 * 0.4);
  EXPECT_NEAR(resistance_to_mean(body, site_of(body, "slab.x_max")) / exact, 1.0, 0.02);
}

/// Boxes are for the picture until a hidden world makes blocks of them: a motor inside the bed would have no film.
TEST(RefinedForm, TellsWhichBoxLiesInsideAnother) {
  std::string text = text_of(machine_file("v450"));
  std::string const corner = R"(corner = ["-110 mm", "180 mm", "770 mm"])";
  text.replace(text.find(corner), corner.size(), R"(corner = ["-110 mm", "0 mm", "-480 mm"])");
  EXPECT_THAT(refusal([&] { RefinedForm(parse_toml(text, "mine.toml")); }),
              testing::AllOf(StartsWith("mine.toml:"), HasSubstr("no face of its box is free"), HasSubstr("'motor'")));
}

TEST(RefinedForm, JoinsTwoBlocksWithTheStatedConductanceOrNearlyIt) {
  auto const document = nominal("v450");
  RefinedForm const form(document);
  Value refined = form.document(), before = document;
  for (auto const* joint : tables_of(before, "joint")) {
    auto const stated = number_in(*joint, "conductance", dimension::conductance);
    auto const from = texts_of(*joint, "from").at(0), to = texts_of(*joint, "to").at(0);
    if (!stated || !form.is_block(from) || !form.is_block(to)) continue;
    double resistance = 0.0;
    for (auto const* part : tables_of(refined, "joint"))
      if (auto const name = name_in(*part), whole = name_in(*joint);
          name == whole || name == whole + "_from" || name == whole + "_to")
        resistance += 1.0 / *number_in(*part, "conductance", dimension::conductance);
    EXPECT_LE(resistance * *stated, 1.0 + 1e-9) << name_in(*joint);
    EXPECT_GE(resistance * *stated, 0.05) << name_in(*joint);
  }
}

/// A block on a shaft, with its sensor; what joins them is added.
std::string const block_on_shaft = R"(
name = "block on shaft"

[spindle]
maximum_speed = "6000 rpm"

[[lump]]
name = "bed"
material = "GJL-250"
mass = "300 kg"
corner = ["0 mm", "0 mm", "0 mm"]
size = ["500 mm", "400 mm", "300 mm"]

[[bar]]
name = "shaft"
material = "42CrMo4"
origin = ["60 mm", "90 mm", "0 mm"]
direction = "z"
length = "300 mm"
outer_diameter = "80 mm"
cells = 4

[[displacement]]
name = "E_Z"
segment = [{ of = "shaft" }]

[[temperature_sensor]]
name = "T1"
at = "bed"
)";

TEST(RefinedForm, PlacesSensorsByContactJointsAsByJoints) {
  auto const place = [](std::string const& joint) {
    Value refined = refined_form(parse_toml(block_on_shaft + joint, "block.toml"));
    return texts_of(*tables_of(refined, "temperature_sensor").at(0), "at").at(0);
  };
  auto const unjoined = place(""), joined = place(R"(
[[joint]]
name = "seat"
from = "shaft"
to = "bed"
conductance = "1 W/K"
)");
  EXPECT_TRUE(unjoined.starts_with("bed.")) << unjoined;
  EXPECT_NE(joined, unjoined);
  EXPECT_EQ(place(R"(
[[contact_joint]]
name = "seat"
from = "shaft"
to = "bed"
area = "0.01 m2"
pressure = "1 MPa"
)"),
            joined);
}

TEST(HiddenHeat, IsTheHeatOfTheTableThatIsAdded) {
  auto document = nominal("v450");
  RefinedForm const form(document);
  Value with = form.document();
  form.append(
      with, "heat",
      make_table({"", 1'000'000, 1},
                 {{"name", "hidden"}, {"at", "column_rear"}, {"power", "40 W"}, {"while_on", "spindle.running"}}));
  Machine const hidden = Machine::build(with), healthy = Machine::build(form.document());
  auto const experiment = challenge_runs(hidden.limits, 5)[2];
  RunOptions options;
  options.node_temperatures = true;
  auto const heat = hidden_heat(hidden, healthy, experiment, run(hidden, experiment, options).dataset);
  ASSERT_EQ(heat.size(), 1U);
  EXPECT_NEAR(heat.at("column_rear").moving, 40.0, 1e-2);
  EXPECT_NEAR(heat.at("column_rear").standing, 0.0, 1e-2);
}

TEST(HiddenWorld, DrawsParametersAroundTheNominalOnes) {
  std::map<std::string, double> drawn;
  auto const document = refined_form(nominal("v450"));
  Value const varied = vary_parameters(document, 11, 1.0, drawn);
  double coefficients = 0.0, capacities = 0.0;
  int count = 0, heavy = 0;
  for (auto const& [path, factor] : drawn) {
    EXPECT_GT(factor, 0.4) << path;
    EXPECT_LT(factor, 2.5) << path;
    bool const capacity = path.ends_with("solidity") || path.ends_with("mass") || path.ends_with("weight");
    (capacity ? capacities : coefficients) += std::pow(std::log(factor), 2);
    ++(capacity ? heavy : count);
  }
  EXPECT_GT(count, 25);
  EXPECT_NEAR(std::sqrt(coefficients / count), 0.2, 0.06);
  EXPECT_NEAR(std::sqrt(capacities / heavy), 0.1, 0.04);
  std::map<std::string, double> same, none;
  Value const again = vary_parameters(document, 11, 1.0, same);
  for (auto const& [path, factor] : drawn)
    EXPECT_EQ(find_number(again, path).value, find_number(varied, path).value) << path;
  EXPECT_EQ(same, drawn);
  EXPECT_TRUE(vary_parameters(document, 11, 0.0, none).is_table());
  for (auto const& [path, factor] : none) EXPECT_DOUBLE_EQ(factor, 1.0) << path;
}

TEST(HiddenWorld, KindsComeInTheSharesOfTheBenchmark) {
  std::map<CaseKind, int> kinds;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) ++kinds[case_kind(seed)];
  EXPECT_EQ(kinds[CaseKind::one], 500);
  EXPECT_EQ(kinds[CaseKind::none], 200);
  EXPECT_EQ(kinds[CaseKind::outside], 100);
  EXPECT_EQ(kinds[CaseKind::two], 100);
  EXPECT_EQ(kinds[CaseKind::sensor], 100);
}

class ChallengeFolder : public testing::Test {
 protected:
  ChallengeFolder() { std::filesystem::remove_all(root_); }
  ~ChallengeFolder() override { std::filesystem::remove_all(root_); }

  [[nodiscard]] std::filesystem::path write(std::string const& name, std::uint64_t seed, CaseKind kind) const {
    write_challenge({"v450", seed, kind, root_ / name, {}});
    return root_ / name;
  }
  std::filesystem::path root_ =
      std::filesystem::path(testing::TempDir()) /
      ("thermotwin_challenge_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
};

TEST_F(ChallengeFolder, HasTheSameBytesFromTheSameSeed) {
  auto const a = write("a", 17, CaseKind::one), b = write("b", 17, CaseKind::one), c = write("c", 18, CaseKind::one);
  for (std::string const file : {"machine.toml", "run1.h5", "run2.h5", "unseen.h5", "sealed_unseen.h5", "sealed.json"})
    EXPECT_EQ(text_of(a / file), text_of(b / file)) << file;
  EXPECT_NE(text_of(a / "run1.h5"), text_of(c / "run1.h5"));
}

TEST_F(ChallengeFolder, GivesAwayNothingButWhatWasMeasured) {
  auto const folder = write("leak", 23, CaseKind::one);
  EXPECT_EQ(text_of(folder / "machine.toml"), text_of(machine_file("v450")));
  for (std::string const file : {"run1.h5", "run2.h5", "unseen.h5"}) {
    auto const data = output::read(folder / file);
    EXPECT_TRUE(data.truth_readings.empty() && data.truth_displacements.empty() && data.heat.empty()) << file;
    EXPECT_TRUE(data.provenance.empty()) << file;
    EXPECT_FALSE(data.node_temperatures) << file;
    EXPECT_EQ(text_of(folder / file).find("hidden"), std::string::npos) << file;
    EXPECT_EQ(text_of(folder / file).find("plate"), std::string::npos) << file;
    EXPECT_GE(data.time_s[data.time_s.size() - 1], 12.0 * 3600.0);
  }
}

/// Noise that came twice would be taken for what the machine does.
TEST_F(ChallengeFolder, GivesEveryFurtherRunNoiseOfItsOwn) {
  auto const folder = write("further", 12, CaseKind::none);
  auto const experiment = experiment_file("separate_switches");
  std::vector<output::Dataset> runs;
  for (std::string const name : {"monday", "tuesday"}) {
    auto const file = root_ / (name + ".toml");
    std::filesystem::copy_file(experiment, file);
    write_challenge({"v450", 12, CaseKind::none, folder, file});
    runs.push_back(output::read(folder / (name + ".h5")));
  }
  auto const alike = [](std::vector<output::Channel> const& a, std::vector<output::Channel> const& b) {
    double most = 0.0;  // correlation of changes
    for (std::size_t c = 0; c < a.size(); ++c) {
      auto const n = a[c].values.size() - 1;
      Eigen::VectorXd const u = a[c].values.tail(n) - a[c].values.head(n),
                            v = b[c].values.tail(n) - b[c].values.head(n);
      most = std::max(most, u.dot(v) / (u.norm() * v.norm()));
    }
    return most;
  };
  EXPECT_LT(alike(runs[0].readings, runs[1].readings), 0.3);
  EXPECT_LT(alike(runs[0].displacements, runs[1].displacements), 0.3);
}

TEST_F(ChallengeFolder, SealsTheUnseenRunWithoutItsNoise) {
  auto const folder = write("quiet", 31, CaseKind::one);
  auto const seen = output::read(folder / "unseen.h5"), was = output::read(folder / "sealed_unseen.h5");
  auto const rms = [](Eigen::VectorXd const& v) { return std::sqrt(v.squaredNorm() / double(v.size())); };
  for (std::size_t c = 0; c < was.displacements.size(); ++c) {  // 0.3 and 0.1 um or, of a rotation, twice that in urad
    double const size = was.displacements[c].unit == "urad" ? 2.0 : 1.0;
    EXPECT_NEAR(rms(seen.displacements[c].values - was.displacements[c].values) / size, 0.32, 0.1)
        << was.displacements[c].name;
  }
  for (std::size_t c = 0; c < was.readings.size(); ++c)  // 0.1 K and the step of a reading
    EXPECT_NEAR(rms(seen.readings[c].values - was.readings[c].values), 0.1, 0.04) << was.readings[c].name;
}

TEST_F(ChallengeFolder, TakesOneMoreRunOfTheSameWorld) {
  auto const folder = write("more", 29, CaseKind::none);
  std::ofstream(root_ / "idle.toml") << "machine = \"v450\"\nduration = \"2 h\"\nsampling = \"60 s\"\n";
  write_challenge({{}, {}, {}, folder, root_ / "idle.toml"});
  auto const idle = output::read(folder / "idle.h5");
  EXPECT_TRUE(idle.provenance.empty() && idle.truth_readings.empty());
  EXPECT_EQ(idle.time_s[idle.time_s.size() - 1], 7200.0);
  auto const truth = nlohmann::json::parse(text_of(folder / "sealed.json"));
  for (auto const& reading : idle.readings) {  // the same specimens, by their offsets, and a machine at rest at 20 °C
    double const offset = truth.at("drawn").at("temperature_sensor." + reading.name + ".offset");
    EXPECT_NEAR(reading.values.mean(), 20.0 + offset, 0.12) << reading.name;
  }
  EXPECT_THROW(write_challenge({{}, {}, {}, folder, root_ / "idle.toml"}), thermal::InputError);
}

/// A folder of another machine than the default one: a further run is of that one.
TEST_F(ChallengeFolder, TakesOneMoreRunOfItsOwnMachineOnly) {
  auto const folder = root_ / "screw", file = root_ / "idle.toml";
  write_challenge({"vmc850", 12, CaseKind::none, folder, {}});
  std::ofstream(file) << "machine = \"vmc850\"\nduration = \"2 h\"\nsampling = \"60 s\"\n";
  auto const complaint = [&](ChallengeOptions options) -> std::string {
    options.folder = folder;
    options.further_run = file;
    try {
      return write_challenge(options);
    } catch (thermal::InputError const& error) {
      return error.what();
    }
  };
  std::string const has = "the challenge in '" + folder.string() + "' has the ";
  EXPECT_EQ(complaint({"v450", 12, {}, {}, {}}), has + "machine vmc850 of " + (folder / "machine.toml").string() +
                                                     ", not v450; without --machine it goes on with its own");
  EXPECT_EQ(complaint({"vmc850", 13, {}, {}, {}}), has + "seed 12, not 13; without --seed it goes on with its own");
  EXPECT_EQ(complaint({{}, {}, CaseKind::one, {}, {}}),
            has + "kind none, not one; without --kind it goes on with its own");
  EXPECT_FALSE(std::filesystem::exists(folder / "idle.h5"));
  write_challenge({{}, {}, {}, folder, file});
  auto const names = [](output::Dataset const& data) {
    std::vector<std::string> all;
    for (auto const& reading : data.readings) all.push_back(reading.name);
    return all;
  };
  EXPECT_EQ(names(output::read(folder / "idle.h5")), names(output::read(folder / "run1.h5")));
  std::filesystem::copy_file(file, root_ / "again.toml");
  write_challenge({"vmc850", 12, CaseKind::none, folder, root_ / "again.toml"});  // as script/challenge asks for it
  EXPECT_EQ(names(output::read(folder / "again.h5")), names(output::read(folder / "idle.h5")));
}

TEST_F(ChallengeFolder, IsOfAMachineThatCanHideSomething) {
  auto const complaint = [&](std::string const& machine) -> std::string {
    std::string const written = refusal([&] { write_challenge({machine, 1, CaseKind::none, root_ / "none", {}}); });
    EXPECT_EQ(refusal([&] { (void)challenge_key({machine, 1, CaseKind::none, {}, {}}); }), written);
    EXPECT_FALSE(std::filesystem::exists(root_ / "none"));
    return written;
  };
  auto const fine = complaint("v450_fine"), board = complaint("tclab");
  EXPECT_THAT(fine, StartsWith("there is no challenge of 'v450_fine': the hidden machine is a finer form of it"));
  EXPECT_THAT(fine, EndsWith("did you mean 'v450'?"));
  EXPECT_THAT(board, HasSubstr("it needs the input 'heater"));
  EXPECT_THAT(board, HasSubstr("known: "));
  EXPECT_THAT(board, HasSubstr("'g200'"));
}

TEST_F(ChallengeFolder, RefusesToOverwrite) {
  std::filesystem::create_directories(root_ / "full");
  std::ofstream(root_ / "full" / "mine.txt") << "mine";
  EXPECT_THROW(static_cast<void>(write("full", 1, CaseKind::none)), output::OutputError);
  EXPECT_EQ(text_of(root_ / "full" / "mine.txt"), "mine");
}

}  // namespace
}  // namespace thermotwin::twin
