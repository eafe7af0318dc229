#include "twin/study/study_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "tests/twin/study/small_study.h"
#include "twin/study/study_runs.h"

namespace thermotwin::twin {
namespace {

using testing::HasSubstr;

TEST(Study, MistakesAreNamedWhereTheyStand) {
  auto const with = [](std::string text, std::string const& what, std::string const& instead) {
    text.replace(text.find(what), what.size(), instead);
    return SmallStudy(text).complaint();
  };
  std::string const all = head + world;
  EXPECT_THAT(with(all, "forward 2", "foward 2"), HasSubstr("small.toml:4:22: no selection method 'foward'; did you"));
  EXPECT_THAT(with(all, "forward 2", "forward two"), HasSubstr("a number of sensors from 1 on is due"));
  EXPECT_THAT(with(all, "forward 2", "all 2"), HasSubstr("all sensors have no number"));
  EXPECT_THAT(with(all, "forward 2", "sensors T1, T1"), HasSubstr("small.toml:4:22: 'sensors T1, T1': 'T1' is given"));
  for (auto const* gap : {"sensors", "sensors T1,, T8", "sensors T1,"})
    EXPECT_THAT(with(all, "forward 2", gap), HasSubstr("after 'sensors', names with commas between them are due"));
  EXPECT_THAT(with(all, "\"ridge\"", "\"rigde\""),
              HasSubstr("small.toml:5:21: no model 'rigde'; did you mean 'ridge'?"));
  EXPECT_THAT(with(all, "\"ridge\"", "\"twin rigde\""),
              HasSubstr("small.toml:5:21: no model 'rigde'; did you mean 'ridge'?"));
  EXPECT_THAT(with(all, "\"ridge\"", "\"twins\""),
              HasSubstr("small.toml:5:21: no model 'twins'; did you mean 'twin'?"));
  EXPECT_THAT(with(all, "\"ridge\"", "\"twin observe\""),
              HasSubstr("small.toml:5:21: no model 'observe'; did you mean 'observer'?"));
  EXPECT_THAT(with(all, "forward 2", "al"),
              HasSubstr("small.toml:4:22: no selection method 'al'; did you mean 'all'?"));
  EXPECT_THAT(with(all, "\"ridge\"", "\"linear\""), HasSubstr("small.toml:5:21: 'linear' is given twice"));
  EXPECT_THAT(with(all, "\"ridge\"", "\"linear & rigde\""),
              HasSubstr("small.toml:5:21: no model 'rigde'; did you mean 'ridge'?"));
  EXPECT_THAT(with(all, "\"ridge\"", "\"linear & \""), HasSubstr("small.toml:5:21: no model ''; known: "));
  EXPECT_THAT(with(all, "\"ridge\"", "\"ridge & ridge\""),
              HasSubstr("small.toml:5:21: 'ridge & ridge' has a model twice"));
  EXPECT_THAT(with(all, "test = [\"slow.toml\"]", "split = \"0 min\""), HasSubstr("'split' is 0 s; a time after"));
  EXPECT_THAT(with(all, "seeds = 5", "seeds = 3"), HasSubstr("'seeds' is 3; allowed is 5 to 1000"));
  EXPECT_THAT(with(all, "E_Z", "E_W"),
              HasSubstr("small.toml:10:9: world 'v450': the machine has no displacement 'E_W'; did you mean"));
  EXPECT_THAT(with(all, "\"T9\"", "\"T19\""),
              HasSubstr("small.toml:11:24: world 'v450': the machine has no sensor 'T19'; did you mean"));
  EXPECT_THAT(with(all, "error =", "eror ="), HasSubstr("small.toml:10:1: unknown key 'eror'; did you mean 'error'"));
  EXPECT_THAT(SmallStudy(all + "[screening]\nnormalisation = \"over_tim\"\n").complaint(),
              HasSubstr("small.toml:15:17: 'normalisation' is 'over_tim'; did you mean 'over_time'?"));
  EXPECT_THAT(SmallStudy(all + "[[claim]]\nsays = \"x\"\ncombination = \"all + linear\"\nat_most = 1\ntolerance = 5\n")
                  .complaint(),
              HasSubstr("small.toml:18:13: a 'tolerance' says no worse than another combination; give 'than'"));
  auto const claimed = [&](std::string const& keys) {
    return SmallStudy(all + "[[claim]]\nsays = \"x\"\n" + keys).complaint();
  };
  EXPECT_THAT(claimed("combination = \"all + linear\"\nat_most = 1\nshare = 0.5\n"),
              HasSubstr("small.toml:18:9: a 'share' is of another combination; give 'than', and no 'improvement'"));
  EXPECT_THAT(
      claimed("combination = \"all + linear\"\nthan = \"best of paper\"\nshare = 0.5\n"),
      HasSubstr("small.toml:17:8: the study has no combination 'best of paper'; did you mean 'best of papers'?"));
  EXPECT_THAT(claimed("combination = \"chosen by cross-validation\"\nat_most = 1\n"),
              HasSubstr("small.toml:16:15: there is no cross-validation to choose by; give 'folds'"));
  EXPECT_THAT(claimed("combination = \"all + linear\"\nat_most = 1\nworld = \"mean of worlds\"\n"),
              HasSubstr("small.toml:18:9: no world 'mean of worlds'; "));
  EXPECT_THAT(with(all, "error =", "sampling = \"0 s\"\nerror ="),
              HasSubstr("small.toml:10:12: 'sampling' is 0 s; an interval of more than 0 is due"));
  EXPECT_THAT(with(all, "test =", "instant = [{ experiment = \"slow.toml\", time = \"60 min\" }]\ntest ="),
              HasSubstr("small.toml:13:12: an 'instant' judges the error over an axis, but 'error' is 'E_Z'; give a "
                        "slope, for example \"slope z\""));
  EXPECT_THAT(with(all, "slow.toml", "missing.toml"),
              HasSubstr("small.toml:13:9: world 'v450': 'missing.toml' is not there: "));
  EXPECT_THAT(with(all, "slow.toml", "fast.toml"), HasSubstr("'fast.toml' is in 'train', too"));
  EXPECT_THAT(with(all, "test = [\"slow.toml\"]", ""), HasSubstr("has nothing to test on; give 'test' or 'split'"));
  EXPECT_THAT(with("reference = \"all + liner\"\n" + all, "Small", "Small"),
              HasSubstr("small.toml:1:13: the study has no combination 'all + liner'; did you mean 'all + linear'?"));
  EXPECT_THAT(with(all, "error = \"E_Z\"", "error = \"slope z\""), HasSubstr("no laser measurement of axis 'z'"));
}

TEST(Study, RefusesClaimsOfFiguresThatItCannotHave) {
  auto const claimed = [&](std::string const& keys) {
    return SmallStudy(head + world + "[[claim]]\nsays = \"x\"\ncombination = \"all + linear\"\n" + keys).complaint();
  };
  EXPECT_THAT(claimed("figure = \"cross.rms\"\nat_most = 1\n"),
              HasSubstr("small.toml:17:10: a study has no figure 'cross.rms'; did you mean 'cross.rmse'?"));
  EXPECT_THAT(claimed("figure = \"validation.rmse\"\nat_most = 1\n"),
              HasSubstr("small.toml:17:10: a study has no figure 'validation.rmse'; give 'folds', which it is of"));
  EXPECT_THAT(claimed("figure = \"feed_8000 at 60 min.rmse\"\nat_most = 1\n"),
              HasSubstr("small.toml:17:10: a study has no figure 'feed_8000 at 60 min.rmse'; "));
  EXPECT_THAT(claimed("than = \"all + ridge\"\nimprovement = 200\n"),
              HasSubstr("small.toml:18:15: an 'improvement' by 200 % leaves less than nothing of the other's "
                        "'cross.rmse'; 100 % is all"));
  EXPECT_THAT(claimed("than = \"all + ridge\"\nfigure = \"cross.r_squared\"\nshare = 0.5\n"),
              HasSubstr("small.toml:19:9: a 'share' is at most so much of the other's figure, but of 'cross.r_squared' "
                        "more is better; give 'improvement' or 'tolerance'"));
  auto second = world;
  second.replace(second.find("\"v450\""), 6, "\"twin\"");
  EXPECT_THAT(SmallStudy(head + world + second +
                         "[[claim]]\nsays = \"x\"\ncombination = \"all + linear\"\nat_most = 1\n"
                         "world = \"mean of worlds\"\nfigure = \"cross.mae\"\n")
                  .complaint(),
              HasSubstr("a study has no figure 'cross.mae' in the mean of worlds; did you mean 'cross.rmse'?"));
}

/// What a report has, a claim may be of.
TEST(Study, MayClaimAnyFigureThatItHas) {
  auto const text = "folds = 2\n" + head + world;
  auto const report = SmallStudy(text).report();
  for (auto const& row : report.rows)
    for (auto const& [figure, values] : figures_of(report, row)) {
      SmallStudy const claiming(text + "[[claim]]\nsays = \"x\"\ncombination = \"all + linear\"\nat_most = 1\n" +
                                fmt::format("figure = \"{}\"\n", figure));
      EXPECT_NO_THROW((void)read_study(claiming.file())) << figure;
    }
}

/// Where the study names the run, and not where it names the machine.
TEST(Study, ChecksThatTheMachineHasItsMeasuredRuns) {
  auto text = head + world;
  text.replace(text.find("fast.toml"), 9, "fast.csv");
  SmallStudy const study(text);
  std::string rows = "time_s,T1_degC,T8_degC,T9_degC,E_Z_um\n";
  for (int row = 0; row < 12; ++row)
    rows += fmt::format("{},{},{},{},{}\n", 600 * row, 20 + 2 * row, 20 + row, 21 + row, 3 * row);
  tests::put(study.experiment_path("fast.csv"), rows);
  try {
    check_worlds(read_study(study.file()));
    FAIL() << "no complaint";
  } catch (FileError const& error) {
    EXPECT_THAT(error.what(), HasSubstr("small.toml:12:10: world 'v450': "));
    EXPECT_THAT(error.what(), HasSubstr("fast.csv: the machine 'v450' needs inputs that the data lack: "));
    EXPECT_THAT(error.what(), testing::EndsWith("; without 'machine' the world is its readings alone"));
  }
}

TEST(Study, OfNoMachineSimulatesAndChangesNothing) {
  auto text = head + world;
  text.replace(text.find("machine = \"v450\"\n"), 17, "");
  EXPECT_THAT(SmallStudy(text).complaint(),
              HasSubstr("small.toml:11:10: world 'v450': 'fast' is an experiment; give the 'machine' that is put "
                        "through it"));
  EXPECT_THAT(SmallStudy(text + "set = [\"bearing.front.grease_factor=2\"]\n").complaint(),
              HasSubstr("small.toml:13:7: 'set' changes a machine; give 'machine', too"));
}

std::string const bare_world = R"(
[[world]]
name = "bare"
error = "E_Z"
train = ["monday.csv"]
test = ["tuesday.csv"]
)";

TEST(Study, OfNoMachineAtAllHasNoPhysics) {
  auto const with = [](std::string const& more, std::string const& from, std::string const& to) {
    auto text = more + head + bare_world;
    return SmallStudy(text.replace(text.find(from), from.size(), to)).complaint();
  };
  EXPECT_THAT(with("", "\"ridge\"", "\"twin ridge\""),
              HasSubstr("small.toml:5:21: 'twin ridge' needs a machine, and no [[world]] names one; give 'machine'"));
  EXPECT_THAT(with("", "forward 2", "thermal_modes 2"),
              HasSubstr("small.toml:4:22: 'thermal_modes 2' needs a machine, and no [[world]] names one"));
  EXPECT_THAT(with("also = [\"all + ridge & twin\"]\n", "Small", "Small"),
              HasSubstr("small.toml:1:9: 'all + ridge & twin' needs a machine, and no [[world]] names one"));
}

/// Beside a world that has a machine, one without refuses what needs one in each row that such a claim looks at.
TEST(Study, RefusesClaimsOfWhatItsWorldRefuses) {
  auto const claimed = [](std::string const& keys) {
    return SmallStudy("also = [\"all + twin\", \"thermal_modes + linear\"]\n" + head + world + bare_world +
                      "[[claim]]\nsays = \"x\"\n" + keys)
        .complaint();
  };
  EXPECT_THAT(claimed("combination = \"all + twin\"\nthan = \"all + linear\"\nworld = \"bare\"\n"),
              HasSubstr("small.toml:23:15: 'all + twin' needs a machine, and the world 'bare' names none"));
  EXPECT_THAT(claimed("combination = \"all + linear\"\nthan = \"all + twin\"\nworld = \"mean of worlds\"\n"),
              HasSubstr("small.toml:24:8: 'all + twin' needs a machine, and the world 'bare' names none"));
  EXPECT_THAT(claimed("combination = \"all + linear\"\nthan = \"best of papers\"\nworld = \"bare\"\n"),
              HasSubstr("small.toml:24:8: 'best of papers' is of none: the study has no combination of a selection of "
                        "the papers that needs no machine (mutual_information, "));
  EXPECT_THAT(claimed("combination = \"all + twin\"\nthan = \"best of papers\"\nworld = \"v450\"\n"),
              HasSubstr("'monday.csv' is not there"));  // the claim is none's mistake
}

TEST(Study, RefusesClaimsAgainstPapersThatItDoesNotStudy) {
  EXPECT_THAT(
      SmallStudy(head + world + "[[claim]]\nsays = \"x\"\ncombination = \"all + ridge\"\nthan = \"best of papers\"\n")
          .complaint(),
      testing::AllOf(HasSubstr("small.toml:17:8: 'best of papers' is of none: the study has no combination of "
                               "a selection of the papers (mutual_information, "),
                     HasSubstr("grey_relational) and a model of theirs (linear, support_vector, ")));
}

/// What `check` complains of without a run, as `study` does.
std::string complaint_before_runs(SmallStudy const& study) {
  try {
    check_worlds(read_study(study.file()));
  } catch (FileError const& error) {
    return error.what();
  } catch (thermal::InputError const& error) {
    return error.what();
  }
  return "no complaint";
}

/// A table of that many hours, as `export` writes it, of two sensors and an error.
void put_record(SmallStudy const& study, std::string const& name, int hours) {
  std::string rows = "time_s,T1_degC,T8_degC,E_Z_um\n";
  for (int row = 0; row <= 6 * hours; ++row)
    rows += fmt::format("{},{},{},{}\n", 600 * row, 20 + 0.02 * row, 20 + 0.01 * row, 0.1 * row);
  tests::put(study.experiment_path(name), rows);
}

TEST(Study, KnowsItsSensorsBeforeItRuns) {
  auto text = head + world;
  text.replace(text.find("\"T9\""), 4, "\"T19\"");
  EXPECT_THAT(complaint_before_runs(SmallStudy(text)),
              HasSubstr("small.toml:11:24: world 'v450': the machine has no sensor 'T19'; did you mean"));
  SmallStudy const measured(head + bare_world + "sensors = [\"T1\", \"T9\"]\n");
  for (auto const* name : {"monday.csv", "tuesday.csv"}) put_record(measured, name, 3);
  EXPECT_THAT(complaint_before_runs(measured),
              HasSubstr("small.toml:12:18: world 'bare': monday.csv has no sensor 'T9'; did you mean"));
}

TEST(Study, KnowsBeforeItRunsThatNoLaserMeasuredASlope) {
  auto const slope = [](std::string text, std::string const& axis) {
    return text.replace(text.find("\"E_Z\""), 5, "\"slope " + axis + "\"");
  };
  EXPECT_THAT(complaint_before_runs(SmallStudy(slope(head + world, "z"))),
              HasSubstr("small.toml:12:10: world 'v450': 'fast.toml': the experiment has no laser measurement of axis "
                        "'z', which 'slope z' is of; the machine has no ball_screw that one could measure"));
  std::string feed =
      "\n[[world]]\nname = \"axis\"\nmachine = \"vmc850\"\nerror = \"E_Z\"\n"
      "train = [\"feed_8000\"]\ntest = [\"feed_12000\"]\n";
  EXPECT_THAT(complaint_before_runs(SmallStudy(slope(head + feed, "x"))),
              HasSubstr("small.toml:11:10: world 'axis': 'feed_8000.toml': the experiment has no laser measurement of "
                        "axis 'x', which 'slope x' is of; its [laser] can measure, by the machine: z"));
  EXPECT_EQ(complaint_before_runs(SmallStudy(slope(head + feed, "z"))), "no complaint");
  SmallStudy const measured(slope(head + bare_world, "z"));
  for (auto const* name : {"monday.csv", "tuesday.csv"}) put_record(measured, name, 3);
  EXPECT_THAT(complaint_before_runs(measured),
              HasSubstr("small.toml:10:10: world 'bare': 'monday.csv' was measured, and a slope is of simulated "
                        "experiments only; give a displacement as 'error' in place of 'slope z'"));
}

TEST(Study, KnowsBeforeItRunsThatASplitIsBehindTheEnd) {
  auto const split = [](std::string text, std::string const& test) {
    return text.replace(text.find("test = " + test), 7 + test.size(), "split = \"30 h\"");
  };
  EXPECT_THAT(
      complaint_before_runs(SmallStudy(split(head + world, "[\"slow.toml\"]"))),
      HasSubstr("small.toml:13:9: world 'v450': 'split' is 30 h, but fast.toml ends at 90 min; a time before is "
                "due"));
  SmallStudy const measured(split(head + bare_world, "[\"tuesday.csv\"]"));
  put_record(measured, "monday.csv", 12);
  EXPECT_THAT(complaint_before_runs(measured),
              HasSubstr("small.toml:11:9: world 'bare': 'split' is 30 h, but monday.csv ends at 12 h"));
  put_record(measured, "monday.csv", 48);
  EXPECT_EQ(complaint_before_runs(measured), "no complaint");
}

TEST(Study, SaysOnceWhereAChangeIsWrong) {
  auto const complaint = SmallStudy(head + world + "set = [\"bearing.front.torque=2\"]\n").complaint();
  EXPECT_THAT(complaint, HasSubstr("small.toml:7:1: world 'v450': parameter bearing.front.torque: unknown key"));
  EXPECT_EQ(complaint.find("world 'v450'"), complaint.rfind("world 'v450'"));
}

/// As `describe study` shows it.
TEST(Study, CanChangeWhatItsDescriptionChanges) {
  for (auto const& field : list_fields<StudyWorld>()) {
    if (field.key != "set") continue;
    auto const change = field.description.substr(field.description.find('"'));
    SmallStudy const study(head + world + "set = [" + change + "]\n");
    EXPECT_NO_THROW(check_worlds(read_study(study.file()))) << change;
  }
}

/// What stands in `also` is "selection + model", of names that are known, and none of the cross product.
TEST(Study, MistakesOfSingleCombinationsAreNamedWhereTheyStand) {
  auto const complaint = [](std::string const& second) {
    return SmallStudy("also = [\"all + distributed_lag\", \"" + second + "\"]\n" + head + world).complaint();
  };
  EXPECT_THAT(complaint("al + twin observer"),
              HasSubstr("small.toml:1:34: no selection method 'al'; did you mean 'all'?"));
  EXPECT_THAT(complaint("all + twin observr"),
              HasSubstr("small.toml:1:34: no model 'observr'; did you mean 'observer'?"));
  EXPECT_THAT(complaint("all & twin observer"),
              HasSubstr("small.toml:1:34: 'all & twin observer' is no combination; write \"selection + model\""));
  EXPECT_THAT(complaint("forward 2 + ridge"),
              HasSubstr("small.toml:1:34: 'forward 2 + ridge' is there already, of 'selections' and 'models'"));
  EXPECT_THAT(complaint("all + distributed_lag"), HasSubstr("small.toml:1:34: 'all + distributed_lag' is given twice"));
  EXPECT_THAT(complaint("sensors T1, T18 + linear"),
              HasSubstr("small.toml:1:34: 'sensors T1, T18 + linear': no world of the study has a sensor 'T18'"));
  EXPECT_THAT(SmallStudy("also = [\"all + twin\"]\nreference = \"all + twn\"\n" + head + world).complaint(),
              HasSubstr("small.toml:2:13: the study has no combination 'all + twn'; did you mean 'all + twin'?"));
}

TEST(Study, LeavesOutNothingWhereEveryRunPredictsEveryOther) {
  auto text = "folds = 3\n" + head + world;
  text.replace(text.find("train = [\"fast.toml\"]"), 21,
               "fit = \"each\"\ntrain = [\"spindle_constant_25\", \"spindle_constant_50\", \"spindle_constant_75\"]");
  text.replace(text.find("test = [\"slow.toml\"]"), 20, "");
  EXPECT_THAT(SmallStudy(text).complaint(),
              HasSubstr("'fit' is each: every run predicts every other, and 'folds' have"));
}

TEST(Study, JudgesInstantsByOneModelOfAllRuns) {
  std::string const each = R"(
[[world]]
name = "axis"
machine = "vmc850"
error = "slope z"
fit = "each"
train = ["feed_8000", "feed_12000", "feed_16000"]
instant = [{ experiment = "feed_12000", time = "150 min" }]
)";
  EXPECT_THAT(SmallStudy(head + each).complaint(),
              HasSubstr("small.toml:13:12: an 'instant' is judged by the one model of all of 'train', but 'fit' is "
                        "each; give fit = \"together\", or no 'instant'"));
}

}  // namespace
}  // namespace thermotwin::twin
