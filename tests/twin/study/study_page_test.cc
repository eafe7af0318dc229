#include "twin/study/study_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/twin/study/small_study.h"

namespace thermotwin::twin {
namespace {

using testing::HasSubstr, testing::Not;

/// Of three seeds, with the reference: both are explained. What was measured once has no interval; what is compared
/// with a combination that was refused has no column.
TEST(StudyPage, ExplainsWhatItsTablesHave) {
  StudyReport report;
  report.description.worlds.resize(1);
  report.description.reference = "all + linear";
  report.units = {"um"};
  report.repetitions = {3};
  report.rows = {
      {"", "all", "linear", {{"cross.rmse", {1.0, 2.0, 3.0}}, {"improvement", {0.0, 0.0, 0.0}}}, {}, {}, {}}};
  EXPECT_THAT(study_text(report),
              HasSubstr("\n\nintervals: 95 % over the seeds; better: rmse of cross-prediction against "
                        "all + linear\n0 runs"));
  report.rows.front().figures.erase("improvement");
  EXPECT_THAT(study_text(report), HasSubstr("\n\nintervals: 95 % over the seeds\n0 runs"));
  report.repetitions = {1};
  EXPECT_THAT(study_text(report), Not(HasSubstr("intervals")));
  report.rows.front().figures["improvement"] = {0.0};
  EXPECT_THAT(study_text(report), HasSubstr("\n\nbetter: rmse of cross-prediction against all + linear\n0 runs"));
}

/// Of the best combination with a selection; where its name says which, or where they are too many, the table does not.
TEST(StudyPage, NamesTheSensorsThatWereChosen) {
  StudyReport report;
  report.description.worlds.resize(1);
  report.units = {"um"};
  report.repetitions = {1};
  auto const add = [&](std::string const& selection, std::string const& model, double rmse,
                       std::vector<std::string> const& sensors) {
    report.rows.push_back({"", selection, model, {{"cross.rmse", {rmse}}}, sensors, {}, {}});
  };
  add("forward 2", "linear", 2.0, {"T1", "T8"});
  add("forward 2", "ridge", 1.0, {"T1", "T9"});
  add("sensors T4", "ridge", 1.0, {"T4"});
  add("all", "ridge", 1.0, {"T1", "T4"});
  add("d_optimal", "ridge", 1.0, std::vector<std::string>(20, "T10"));
  for (auto const* selection : {"forward 2", "sensors T4", "all", "d_optimal"})
    report.selections.push_back({"", selection, {{"count", {2.0}}}, "", {}});
  auto const text = study_text(report);
  EXPECT_THAT(text, HasSubstr("  chosen: T1 T9\n"));
  EXPECT_EQ(text.find("  chosen: "), text.rfind("  chosen: "));
  EXPECT_THAT(text, HasSubstr("\nchosen: for the first training set, with the first seed\n"));
}

/// The reference is refused in one draw: no combination is compared with it, and the page does not say so.
TEST(StudyPage, NamesNoReferenceThatWasRefused) {
  auto text = head + world;
  text.replace(text.find("\"linear\", \"ridge\""), 17, "\"linear\", \"distributed_lag\"");
  text.replace(text.find("sensors = [\"T1\", \"T8\", \"T9\"]\n"), 29, "");  // thirty regressors are too many
  text = "reference = \"all + distributed_lag\"\n" + text;
  auto const page = study_text(SmallStudy(text).report());
  EXPECT_THAT(page, HasSubstr("refused: "));
  EXPECT_THAT(page, Not(HasSubstr("better")));
}

}  // namespace
}  // namespace thermotwin::twin
