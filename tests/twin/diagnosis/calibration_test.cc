#include "twin/diagnosis/calibration.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>

#include "output/dataset_file.h"
#include "tests/output/temporary_directory.h"
#include "tests/scenarios/refusal.h"
#include "tests/twin/diagnosis/diagnosis_bench.h"
#include "tests/twin/only.h"
#include "twin/diagnosis/estimate_text.h"

/// A machine whose grease and whose motor's cooling are not what its file says.
namespace thermotwin::twin {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;
using thermotwin::tests::contents;
using thermotwin::tests::refusal;
using thermotwin::tests::TemporaryDirectory;

class CalibrationTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = std::make_unique<TemporaryDirectory>();
    thermotwin::tests::put(*folder / "mine.toml", contents(machine_file("v450")));
    Value truth = read_toml(machine_file("v450"));
    set_parameter(truth, "bearing.front.grease_factor", "0.7");
    set_parameter(truth, "film.motor.coefficient", "18 W/(m2 K)");
    output::write(run(Machine::build(truth), tests::two_speeds(), {}).dataset, *folder / "run.h5");
    CalibrateFiles files{*folder / "mine.toml", {*folder / "run.h5"}, *folder / "calibrated.toml"};
    files.watch = [](int step, double misfit) {
      if (step == 1) told.emplace_back();
      told.back().push_back(misfit);
    };
    files.show = [&](Calibration const& found) {
      EXPECT_FALSE(std::filesystem::exists(files.output));  // what was found outlives that it cannot be written
      shown = calibration_table(found);
    };
    calibration = calibrate_files(files);
  }
  static void TearDownTestSuite() { folder.reset(); }

  static CalibratedNumber const& number(std::string const& path) {
    auto const it = std::find_if(calibration.numbers.begin(), calibration.numbers.end(),
                                 [&](auto const& n) { return n.number.path == path; });
    if (it == calibration.numbers.end()) throw std::out_of_range(path);
    return *it;
  }

  static std::unique_ptr<TemporaryDirectory> folder;
  static Calibration calibration;
  static std::string shown;
  static std::vector<std::vector<double>> told;  ///< misfits before each step, of each fit
};

std::unique_ptr<TemporaryDirectory> CalibrationTest::folder;
Calibration CalibrationTest::calibration;
std::string CalibrationTest::shown;
std::vector<std::vector<double>> CalibrationTest::told;

TEST_F(CalibrationTest, NumbersThatTheDataKnowAreFoundWithinTheirErrors) {
  auto const& grease = number("bearing.front.grease_factor");
  EXPECT_TRUE(grease.identified);
  EXPECT_NEAR(grease.estimate(), 0.7, 3.0 * grease.standard_error());
  EXPECT_LT(grease.standard_error(), 0.1);
  auto const& film = number("film.motor.coefficient");
  EXPECT_NEAR(film.estimate(), 18.0, 3.0 * film.standard_error());
}

TEST_F(CalibrationTest, NumbersThatTheDataDoNotKnowAreNotIdentified) {
  auto const& bed = number("lump.bed.mass");
  EXPECT_FALSE(bed.identified);
  EXPECT_NEAR(bed.deviation, 0.10, 0.02);  // the prior's
}

TEST_F(CalibrationTest, IsShownAsItIsGivenBack) { EXPECT_EQ(shown, calibration_table(calibration)); }

TEST_F(CalibrationTest, TellsHowItsFitsGo) {
  ASSERT_EQ(told.size(), 2u);  // of all numbers, then of those identified
  for (auto const& fit : told) {
    ASSERT_GT(fit.size(), 1u);
    EXPECT_TRUE(std::is_sorted(fit.rbegin(), fit.rend()));
    EXPECT_LT(fit.back(), 0.5 * fit.front());
    EXPECT_GE(fit.back(), calibration.misfit);  // priors count, too
  }
}

TEST_F(CalibrationTest, EndsWhenItIsStopped) {
  auto const stop = [](int, double) { throw Interrupted("stopped"); };
  EXPECT_THROW((void)calibrate_files({*folder / "mine.toml", {*folder / "run.h5"}, *folder / "stopped.toml", stop}),
               Interrupted);
  EXPECT_FALSE(std::filesystem::exists(*folder / "stopped.toml"));
}

TEST_F(CalibrationTest, DoubtsOfTheDataAreToldFirst) {
  EXPECT_TRUE(calibration.doubts.empty());
  Calibration doubted = calibration;
  doubted.doubts = {{"run", "E_Z", "E_Z moves against the machine"}};
  EXPECT_THAT(calibration_table(doubted), StartsWith(doubt_lines(doubted.doubts)));
  EXPECT_THAT(calibration_json(doubted), HasSubstr(R"("text": "E_Z moves against the machine")"));
}

TEST_F(CalibrationTest, GapShrinksThoughOnlyIdentifiedNumbersChange) {
  auto const sum = whole(calibration.gaps);
  EXPECT_LT(sum.after, 0.5 * sum.before);
  EXPECT_LT(calibration.misfit, 1.2);
}

/// A range holds where a kind would not: the data want a motor film of 18 W/(m2 K), and get no less than 20; what is
/// written is a machine again.
TEST_F(CalibrationTest, RangesOfTheFileHold) {
  thermotwin::tests::put(*folder / "ranged.toml", contents(machine_file("v450")) +
                                                      "\n[[uncertain]]\nname = \"film.motor.coefficient\"\n"
                                                      "from = \"20 W/(m2 K)\"\nto = \"40 W/(m2 K)\"\n");
  auto const ranged = calibrate_files({*folder / "ranged.toml", {*folder / "run.h5"}, *folder / "ranged_fit.toml"});
  auto const film =
      tests::only(ranged.numbers, [](auto const& n) { return n.number.path == "film.motor.coefficient"; });
  EXPECT_NEAR(film.estimate(), 20.0, 0.01);
  EXPECT_NO_THROW((void)calibrate_files({*folder / "ranged_fit.toml", {*folder / "run.h5"}, *folder / "again.toml"}));
}

/// A cabinet of 60 W at the column, of which the file says nothing: the tilt that it makes is beyond what the numbers
/// of the loop may be.
TEST_F(CalibrationTest, SaysWhereNumbersAloneDoNotDo) {
  EXPECT_FALSE(calibration.falls_short());
  Value const plain = read_toml(machine_file("v450"));
  Machine const machine = Machine::build(plain);
  auto const all = hypotheses(plain, machine);
  auto const heat = std::find_if(
      all.begin(), all.end(), [](Hypothesis const& h) { return h.effect->name == "heat" && h.body == "column_rear"; });
  ASSERT_NE(heat, all.end());
  Machine const shop = Machine::build(with_hypothesis(plain, *heat, "cabinet", 60.0));
  output::write(run(shop, tests::two_speeds(), {}).dataset, *folder / "shop.h5");
  auto const measured = read_measured_run(*folder / "shop.h5", machine);
  auto const short_of = calibrate(plain, {bin(measured, fitting_interval(measured))});
  EXPECT_TRUE(short_of.falls_short());
  EXPECT_THAT(calibration_table(short_of), HasSubstr("prior deviations from the file"));
  EXPECT_THAT(calibration_table(short_of), HasSubstr("ask `diagnose` what is missing"));
  auto const json = nlohmann::json::parse(calibration_json(short_of));
  EXPECT_TRUE(json.at("falls_short").get<bool>());
  std::string const reason = json.at("shortcomings").at(0);
  EXPECT_THAT(reason, StartsWith("from the file by more than 3 prior deviations: "));
  EXPECT_THAT(reason, HasSubstr("rotation.A.segment.0.growth_factor by "));
  EXPECT_THAT(calibration_table(short_of), HasSubstr("numbers alone do not explain the data (" + reason));
}

TEST_F(CalibrationTest, TellsWhatFallsShortBesideTheMisfit) {
  EXPECT_THAT(calibration.shortcomings(), IsEmpty());
  Calibration worse = calibration;
  for (auto& gap : worse.gaps) std::swap(gap.before, gap.after);
  worse.expected_gap = 2.0 * whole(worse.gaps).after;
  EXPECT_THAT(worse.shortcomings(), IsEmpty());  // both are noise
  worse.expected_gap = 0.0;
  EXPECT_THAT(worse.shortcomings(), ElementsAre("the calibrated file is further from the data than yours"));
  worse.misfit = 2.5;
  EXPECT_THAT(calibration_table(worse),
              HasSubstr("misfit: 2.50 of what the expected noise makes; numbers alone do not explain the data (the "
                        "misfit is above 2; the calibrated file is further from the data than yours): ask `diagnose` "
                        "what is missing\n"));
}

/// A conductance whose estimate is the file's, while beside numbers at nominal fifty times it fits best.
TEST_F(CalibrationTest, TellsWhatIsIdentifiedAndYetImplausible) {
  for (auto const& n : calibration.numbers) EXPECT_FALSE(n.implausible()) << n.number.path;
  EXPECT_EQ(calibration_table(calibration).find("implausible"), std::string::npos);
  Calibration odd = calibration;
  auto it = std::find_if(odd.numbers.begin(), odd.numbers.end(), [](auto const& n) { return n.identified; });
  ASSERT_NE(it, odd.numbers.end());
  auto const settled = *it;
  it->written = 3.1 * it->number.deviation;
  EXPECT_TRUE(it->implausible());
  *it = settled;
  it->number.of_either_sign = true;  // a weight
  it->number.nominal = 0.0;
  it->number.deviation = 1.0;
  it->deviation = 0.1;
  it->written = -0.2;
  it->logarithm = 0.2;
  EXPECT_FALSE(it->implausible());
  it->logarithm = 0.4;
  EXPECT_TRUE(it->implausible());
  EXPECT_THAT(calibration_table(odd), HasSubstr("what is missing: " + it->number.path + "\n"));
  EXPECT_THAT(calibration_json(odd), HasSubstr("\"implausible\": true"));
  it->identified = false;
  it->written = 0.0;
  EXPECT_FALSE(it->implausible());
}

TEST_F(CalibrationTest, ZerosHaveTheUnitOfTheirChannel) {
  std::map<std::string, std::string> units;
  for (auto const& instrument : calibration.instruments) units[instrument.unknown.name] = instrument.unit;
  EXPECT_EQ(units.at("zero of A, run 1"), "urad");
  EXPECT_EQ(units.at("zero of E_Z, run 1"), "um");
  EXPECT_EQ(units.at("offset of T1"), "K");
  EXPECT_EQ(units.at("lag of T1"), "s");
}

/// A record that begins after 80 min of work.
TEST_F(CalibrationTest, AWarmStartIsCountedInDeviationsOfItsFields) {
  auto const whole_run = run(Machine::build(read_toml(machine_file("v450"))), tests::two_speeds(), {}).dataset;
  output::write(tests::without_rows(whole_run, -1.0, 4800.0), *folder / "warm.h5");
  auto const warm = calibrate_files({*folder / "mine.toml", {*folder / "warm.h5"}, *folder / "warm_fit.toml"});
  int fields = 0;
  for (auto const& instrument : warm.instruments) {
    if (instrument.unknown.kind != Unknown::Kind::warmth) continue;
    EXPECT_EQ(instrument.unit, "1") << instrument.unknown.name;
    ++fields;
  }
  EXPECT_GT(fields, 0);
}

TEST_F(CalibrationTest, FileHasTheIdentifiedNumbersAndNoOthers) {
  Value const written = read_toml(*folder / "calibrated.toml");
  Value given = read_toml(*folder / "mine.toml");
  for (auto const& n : calibration.numbers) {
    auto const [table, key] = find_parameter(given, n.number.path);
    if (!n.identified && !table->find(key)) continue;  // left to its default
    double const expected = n.number.value(n.written);
    EXPECT_EQ(n.identified, n.written != 0.0) << n.number.path;
    EXPECT_NEAR(find_number(written, n.number.path).value, expected, 1e-5 * expected) << n.number.path;
  }
  EXPECT_THAT(contents(*folder / "calibrated.toml"), HasSubstr("# Calibrated from run.h5."));
  EXPECT_NEAR(find_number(written, "temperature_sensor.T6.lag").value,
              find_number(calibration.document, "temperature_sensor.T6.lag").value, 1e-3);
  EXPECT_EQ(contents(*folder / "mine.toml"), contents(machine_file("v450")));
}

TEST_F(CalibrationTest, FilesThatAreReadAreNeverWritten) {
  for (auto const* name : {"mine.toml", "run.h5"})
    EXPECT_THAT(refusal([&] {
                  (void)calibrate_files({*folder / "mine.toml", {*folder / "run.h5"}, *folder / name});
                }),
                HasSubstr("never overwritten"));
}

TEST_F(CalibrationTest, TwoBearingsAtOnePlaceAreInseparableAndNeitherIsIdentified) {
  EXPECT_TRUE(calibration.inseparable.empty());
  Value document = read_toml(machine_file("v450"));
  auto& bearings = std::get<Value::List>(document.find("bearing")->content);
  bearings.push_back(bearings[0]);
  bearings.back().find("name")->content = std::string("double");
  std::string known;  // what the sum of both hangs on
  auto const know = [&](std::string const& path, std::string const& from, std::string const& to) {
    known += "[[uncertain]]\nname = \"" + path + "\"\nfrom = \"" + from + "\"\nto = \"" + to + "\"\n";
  };
  for (std::string const bar : {"test_bar", "shaft"}) know("bar." + bar + ".capacity_factor", "0.99", "1.01");
  for (std::string const name : {"front", "double", "rear"}) {
    if (name != "rear") set_parameter(document, "bearing." + name + ".grease_factor", "0.3");
    set_parameter(document, "bearing." + name + ".viscous_exponent", "0.6667");
    know("bearing." + name + ".viscous_exponent", "0.66", "0.67");
  }
  document = tests::with_table(document, known);
  auto const run = read_measured_run(*folder / "run.h5", Machine::build(document));
  auto const both = calibrate(document, {bin(run, fitting_interval(run))});
  EXPECT_THAT(both.inseparable,
              Contains(testing::UnorderedElementsAre("bearing.front.grease_factor", "bearing.double.grease_factor")));
  for (auto const& n : both.numbers) {
    bool const is_tied =
        n.number.path == "bearing.front.grease_factor" || n.number.path == "bearing.double.grease_factor";
    EXPECT_FALSE(is_tied && n.identified) << n.number.path;
  }
}

TEST_F(CalibrationTest, CollinearityIsThatOfTheIdentifiedNumbers) {
  EXPECT_GT(calibration.collinearity, 1.0);
  EXPECT_FALSE(calibration.weakest.empty());
  for (auto const& path : calibration.weakest) EXPECT_TRUE(number(path).identified) << path;
}

TEST_F(CalibrationTest, JsonHoldsEveryNumber) {
  auto const json = nlohmann::json::parse(calibration_json(calibration));
  EXPECT_EQ(json.at("numbers").size(), calibration.numbers.size());
  EXPECT_EQ(json.at("instruments").size(), calibration.instruments.size());
  EXPECT_NEAR(json.at("gap").at("after"), whole(calibration.gaps).after, 1e-12);
}

/// 0.6 W/K are no 60 % of 0 W/K.
TEST_F(CalibrationTest, PriorsOfEitherSignHaveTheUnitOfTheNumber) {
  Calibration both;
  both.numbers.push_back({{"bearing.front.conductance_speed", 0.0, thermal::dimension::conductance, 0.6, "W/K", true}});
  both.numbers.push_back({{"bearing.front.grease_factor", 0.55, thermal::dimension::dimensionless, 0.3}});
  both.numbers[0].deviation = 0.56;
  auto const table = calibration_table(both);
  EXPECT_THAT(table, testing::ContainsRegex("conductance_speed +0 W/K +0 W/K +0.56 W/K +0.6 W/K +0 W/K  not"));
  EXPECT_THAT(table, testing::ContainsRegex("grease_factor +0.55 +0.55 +0 +30 % +0.55  not"));
  auto const json = nlohmann::json::parse(calibration_json(both)).at("numbers");
  EXPECT_EQ(json[0].at("prior_deviation"), 0.6);
  EXPECT_EQ(json[0].at("deviation"), 0.56);
  EXPECT_FALSE(json[0].contains("prior_deviation_of_logarithm"));
  EXPECT_EQ(json[1].at("prior_deviation_of_logarithm"), 0.3);
  EXPECT_FALSE(json[1].contains("prior_deviation"));
}

TEST(EstimateText, UnitsAreTheAuthors) {
  EXPECT_EQ(written_value(0.5156583, "m2"), "0.515658 m2");
  EXPECT_EQ(written_value(0.5156583, ""), "0.515658");
  EXPECT_EQ(written_interval(0.5, "W/K"), "± 0.98 W/K");
  EXPECT_EQ(readable_unit(237.0, thermal::dimension::power), "W");
  EXPECT_EQ(readable_unit(16.0, thermal::dimension::time), "s");
  EXPECT_EQ(readable_unit(90.0, thermal::dimension::time), "min");
  EXPECT_EQ(readable_unit(2.4e4, thermal::dimension::power), "kW");
  UncertainNumber const bed{"lump.bed.mass", 900.0, thermal::dimension::mass, 0.1, "kg"};
  auto const change = changed_value(bed, std::log(1.1), 0.05);
  EXPECT_EQ(change.text, "990 kg");
  EXPECT_EQ(change.comment, "± 97 kg");
}

}  // namespace
}  // namespace thermotwin::twin
