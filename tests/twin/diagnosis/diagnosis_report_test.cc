#include "twin/diagnosis/diagnosis_report.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "twin/diagnosis/diagnosis_json.h"

namespace thermotwin::twin {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// 60 W into the bed were found.
DiagnosisReport heat_in_the_bed() {
  Finding finding;
  finding.hypothesis.effect = &effect("heat");
  finding.hypothesis.trial = &finding.hypothesis.effect->trials[0];
  finding.hypothesis.site = finding.hypothesis.body = "bed";
  finding.hypothesis.largest = 300.0;
  finding.amplitude = 60.0;
  finding.weight = 1.0;
  DiagnosisReport report;
  report.diagnosis.verdict = Diagnosis::Verdict::effect;
  report.diagnosis.explanations.push_back({{finding}});
  return report;
}

TEST(DiagnosisReport, TellsNoGainOfADeadDisplacement) {
  ChannelGap const dead{"run1", "E_Z", true, "um", NAN, NAN, NAN}, alive{"run1", "E_Y", true, "um", 8e-6, 2e-6, 5e-6};
  auto report = heat_in_the_bed();
  report.fitted = {dead, alive, {"run1", "T1", false, "K", 20.0, 0.1, 0.2}};
  EXPECT_THAT(report_text(report), HasSubstr("With it, the error of the twin at E_Y on the fitted data falls from 8 to "
                                             "2 um RMS; calibration alone leaves 5."));
  report.fitted = {dead};
  EXPECT_THAT(report_text(report), Not(HasSubstr("the error of the twin at")));
}

TEST(DiagnosisReport, SaysThatRunsHeldOutSpeakAgainstIt) {
  auto report = heat_in_the_bed();
  report.diagnosis.explanations[0].alternatives[0].strength = 20.0;
  report.diagnosis.vote = -8.0;
  std::string const against =
      "The runs held out speak against it, though less than the others for it: they are "
      "likelier by calibration alone, by 8 of 2 ln.";
  EXPECT_THAT(report_text(report), HasSubstr(against));
  EXPECT_EQ(nlohmann::json::parse(report_json(report))["cautions"], nlohmann::json::array({against}));
  report.diagnosis.vote = 8.0;
  EXPECT_THAT(report_text(report), Not(HasSubstr("speak against")));
}

/// 30 W of iron loss in the file, and 135 W needed, is not nothing.
TEST(DiagnosisReport, SilenceWithNumbersFarFromTheFileIsTold) {
  auto report = heat_in_the_bed();
  auto& diagnosis = report.diagnosis;
  diagnosis.explanations.clear();
  diagnosis.verdict = Diagnosis::Verdict::nothing;
  diagnosis.unknowns = {
      {Unknown::Kind::number, "motor_loss.stator.eddy", 0.0, 0.25, -INFINITY, INFINITY, std::size_t{0}, -1}};
  diagnosis.changes = {{.path = "motor_loss.stator.eddy", .text = "135 W", .comment = ""}};
  diagnosis.amended.covariance = Eigen::MatrixXd::Constant(1, 1, 0.01);
  for (double const x : {0.5, 1.5}) {
    diagnosis.written.x = diagnosis.amended.x = Eigen::VectorXd::Constant(1, x);
    EXPECT_THAT(headline(diagnosis), HasSubstr(x < 1.0 ? "Nothing is missing" : "numbers had to go far"));
  }
  EXPECT_THAT(report_text(report), HasSubstr("motor_loss.stator.eddy = 135 W (6.0)"));
}

/// A base that soil keeps cold reads like two sensors that are off; a probe's zero is what it is.
TEST(DiagnosisReport, TellsOffsetsThatNoGoodSensorHas) {
  auto report = heat_in_the_bed();
  auto& diagnosis = report.diagnosis;
  diagnosis.unknowns = {{.kind = Unknown::Kind::offset, .name = "offset of T14", .deviation = 0.3},
                        {.kind = Unknown::Kind::offset, .name = "offset of T15", .deviation = 0.3},
                        {.kind = Unknown::Kind::offset, .name = "zero of E_Z, run 1", .deviation = 1e-6, .run = 0}};
  diagnosis.amended.covariance = 1e-4 * Eigen::MatrixXd::Identity(3, 3);
  diagnosis.written.x = diagnosis.amended.x = Eigen::Vector3d(-1.2, 0.8, 20e-6);
  EXPECT_THAT(report_text(report), AllOf(HasSubstr("prior deviations: offset of T14 = -1.20 K (4.0). Was what"),
                                         Not(HasSubstr("E_Z, run 1"))));
}

/// Beside something that was found, agreement in every part would read like a contradiction.
TEST(DiagnosisReport, SaysThatAFindingMayShowInAllTogetherOnly) {
  auto report = heat_in_the_bed();
  std::string const together = "what was found is evident only in all channels and times together";
  std::string const agrees = "The calibrated twin disagrees significantly with no channel at any time.";
  EXPECT_THAT(report_text(report), AllOf(HasSubstr("Missing: 1 effect"), HasSubstr(together), Not(HasSubstr(agrees))));
  report.diagnosis.explanations.clear();
  report.diagnosis.verdict = Diagnosis::Verdict::nothing;
  EXPECT_THAT(report_text(report), AllOf(HasSubstr(agrees), Not(HasSubstr(together))));
}

/// What no speed shows, an hour may.
TEST(DiagnosisReport, SaysTheHoursWhereNoSpeedDisagrees) {
  auto report = heat_in_the_bed();
  Disagreement cell{"run", "T3", "K", "time", "2-4 h"};
  cell.significant = true;
  cell.power = 4.0;
  report.diagnosis.disagreement = {cell};
  EXPECT_THAT(report_text(report), AllOf(HasSubstr("disagrees most"), HasSubstr("2-4 h")));
  cell.cut = "speed";
  cell.part = "4000 rpm";
  cell.power = 3.0;
  report.diagnosis.disagreement.push_back(cell);
  EXPECT_THAT(report_text(report), AllOf(HasSubstr("4000 rpm"), Not(HasSubstr("2-4 h"))));
}

/// 100 W for an hour, 20 W for three.
TEST(DiagnosisReport, WeighsHeatByTheTimeOfAllRuns) {
  FreeHeat heat;
  heat.site.body = "motor";
  heat.gain = 50.0;
  for (double const hours : {1.0, 3.0}) heat.knots.push_back(Eigen::VectorXd::LinSpaced(2, 0.0, 3600.0 * hours));
  for (double const watts : {100.0, 20.0}) heat.heat.push_back(Eigen::VectorXd::Constant(2, watts));
  heat.spread = Eigen::Vector4d::Constant(2.0);
  auto report = heat_in_the_bed();
  report.diagnosis.verdict = Diagnosis::Verdict::none_known;
  report.diagnosis.unknown_heat = heat;
  report.diagnosis.left = {heat};
  std::string const text = report_text(report);
  EXPECT_THAT(text, HasSubstr("Were it one heat of free course: 40.0 ± 9.1 W on average into motor."));
  EXPECT_THAT(text, HasSubstr("still: 40.0 ± 9.1 W on average into motor."));
  EXPECT_DOUBLE_EQ(nlohmann::json::parse(report_json(report))["heat"]["watts"], 40.0);
  report.diagnosis.unknown_heat->gain = 0.0;  // of effects
  EXPECT_THAT(report_text(report), HasSubstr("What stands in for it brings: 40.0 ± 9.1 W on average into motor."));
}

}  // namespace
}  // namespace thermotwin::twin
