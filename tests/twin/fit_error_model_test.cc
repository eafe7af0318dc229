#include "twin/fit_error_model.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "output/dataset.h"
#include "tests/output/temporary_directory.h"
#include "tests/scenarios/refusal.h"
#include "tests/twin/fit_error_model.h"
#include "twin/error_model_file.h"
#include "twin/error_prediction.h"
#include "twin/machine.h"

/// From files of runs to a saved model, and from that to what it says of other runs.
namespace thermotwin::twin {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using thermotwin::tests::contents;
using thermotwin::tests::put;
using thermotwin::tests::refusal;

constexpr Index rows = 120;

/// Three sensors, of which the error is 3 ΔT1 − 2 ΔT2 [um], and an axis that grows by 10 ΔT1 um/m from 0.1 m on.
output::Dataset warming(double pace, double start = 20.0) {
  output::Dataset data;
  data.time_s = VectorXd::LinSpaced(rows, 0.0, 60.0 * (rows - 1));
  VectorXd const hours = data.time_s / 3600.0;
  VectorXd const first = 8.0 * (1.0 - (-pace * hours.array()).exp()) + 0.3 * (9.0 * hours.array().square()).sin(),
                 second = 3.0 * hours.array().sqrt();
  data.readings = {{"T1", "degC", "", start + first.array()},
                   {"T2", "degC", "", start + 1.0 + second.array()},
                   {"T3", "degC", "", start + (pace * hours.array()).sin()}};
  data.displacements = {{"E_Z", "um", "nose", 5.0 + 3.0 * first.array() - 2.0 * second.array()},
                        {"B_Y", "urad", "tilt", 4.0 * first}};
  output::Positioning laser{"z", VectorXd::LinSpaced(5, 0.0, 400.0), data.time_s(Eigen::seq(0, rows - 1, 4)), {}, {}};
  VectorXd const grown = 10.0 * first(Eigen::seq(0, rows - 1, 4));
  laser.forward_um = grown * (1e-3 * laser.position_mm.array() - 0.1).matrix().transpose();
  laser.backward_um = laser.forward_um;
  data.positioning = {laser};
  return data;
}

TEST_F(FitErrorModel, FindsTheErrorAndSaysOfWhatItIs) {
  auto const file = put_run(warming(1.5), "monday.h5");
  auto const saved = fitted({{file}, "E_Z", {"T2", "T1"}});
  EXPECT_TRUE(coefficients(saved).isApprox(Eigen::RowVector2d(-2.0, 3.0), 1e-9)) << coefficients(saved);
  EXPECT_EQ(saved.unit, "um");
  EXPECT_EQ(saved.title, "nose");
  ASSERT_EQ(saved.runs.size(), 1U);
  EXPECT_EQ(saved.runs[0].file, "monday.h5");
  EXPECT_EQ(saved.runs[0].rows, rows);
  EXPECT_THAT(saved.runs[0].zero, ElementsAre(21.0, 20.0));
  EXPECT_LT(saved.runs[0].largest, 1e-9);
  EXPECT_THAT(remarks_, IsEmpty());
  EXPECT_EQ(fitted({{file}, "B_Y", {"T1"}}).unit, "urad");
  EXPECT_NEAR(coefficients(fitted({{file}, "B_Y", {"T1"}}))(0), 4.0, 1e-9);
}

TEST_F(FitErrorModel, NeedsASensor) {
  auto data = warming(1.5);
  data.readings.clear();
  auto const file = put_run(data, "monday.h5");
  EXPECT_THAT(refusal([&] {
                fitted({{file}, "E_Z"});
              }),
              HasSubstr("monday.h5: no sensor is in it, and an error model follows sensors"));
}

TEST_F(FitErrorModel, PredictsTheSameBytesReadBack) {
  auto const monday = put_run(warming(1.5), "monday.h5"), tuesday = put_run(warming(0.7, 24.0), "tuesday.csv");
  for (auto const* error : {"E_Z", "slope z"})
    for (auto const* method : {"linear", "ridge", "ridge_distributed_lag", "linear & ridge_distributed_lag"}) {
      auto const saved = fitted({{monday}, error, {"T1", "T2", "T3"}, method});
      auto const& test = saved.zero_position ? monday : tuesday;
      auto const before = predict_error(saved, test), after = predict_error(read_back(saved), test);
      EXPECT_EQ(before.predicted, after.predicted) << error << " by " << method;
      EXPECT_EQ(prediction_csv(before), prediction_csv(after));
    }
}

TEST_F(FitErrorModel, FindsItsInputsByNameInWhateverOrder) {
  auto const saved = read_back(fitted({{put_run(warming(1.5), "monday.h5")}, "E_Z", {"T2", "T1"}}));
  EXPECT_THAT(saved.inputs(), ElementsAre("T2", "T1"));
  auto data = warming(0.7);
  auto const in_order = predict_error(saved, put_run(data, "tuesday.h5"));
  std::reverse(data.readings.begin(), data.readings.end());
  EXPECT_EQ(predict_error(saved, put_run(data, "reversed.h5")).predicted, in_order.predicted);
}

TEST_F(FitErrorModel, SlopeIsTheFeedAxisModel) {
  auto const run = put_run(warming(1.5), "monday.h5");
  auto const saved = read_back(fitted({{run}, "slope z", {"T1"}}));
  EXPECT_NEAR(*saved.zero_position, 0.1, 1e-9);
  EXPECT_NEAR(coefficients(saved)(0), 10.0, 1e-9);
  EXPECT_EQ(saved.unit, "um/m");
  auto const other = predict_error(saved, put_run(warming(0.7), "tuesday.h5"));
  EXPECT_TRUE(other.predicted.isApprox(warming(0.7).positioning[0].forward_um, 1e-9));
  EXPECT_EQ(other.unit, "um");
  EXPECT_THAT(prediction_csv(other), testing::StartsWith("time_s,position_mm,error_um,predicted_um\n0,0,"));
  EXPECT_THAT(refusal([&] { fitted({{run}, "slope x", {"T1"}}); }), HasSubstr("no laser measurement of axis 'x'"));
}

/// The same numbers, whoever wrote the table and however its columns are called.
TEST_F(FitErrorModel, TakesTablesAndMeasurementFiles) {
  auto const data = warming(1.5);
  auto const from_h5 = fitted({{put_run(data, "run.h5")}, "E_Z", {"T1", "T2"}});
  auto const from_csv = fitted({{put_run(data, "run.csv")}, "E_Z", {"T1", "T2"}});
  put(folder_ / "run.toml", R"(
    machine = "lathe"
    [[table]]
    file = "run.csv"
    reading = [{column = "T1_degC", sensor = "T1", unit = "degC"}, {column = "T2_degC", sensor = "T2", unit = "degC"},
               {column = "E_Z_um", sensor = "E_Z", unit = "um", factor = -1}])");
  auto const mapped = fitted({{folder_ / "run.toml"}, "E_Z", {"T1", "T2"}});
  EXPECT_EQ(coefficients(from_h5), coefficients(from_csv));
  EXPECT_EQ(from_h5.runs[0].fingerprint, from_csv.runs[0].fingerprint);
  EXPECT_TRUE(coefficients(mapped).isApprox(-coefficients(from_h5), 1e-12));
  EXPECT_EQ(mapped.runs[0].machine, "lathe");
}

TEST_F(FitErrorModel, LeavesOutWhatIsDeadAndSaysSo) {
  auto data = warming(1.5);
  readings(data, "T3").setConstant(21.0);
  auto const file = put_run(data, "run.csv");
  auto const saved = fitted({{file}, "E_Z"});
  EXPECT_THAT(saved.inputs(), ElementsAre("T1", "T2"));
  EXPECT_THAT(remarks_, ElementsAre("run.csv: 'T3' is dead: it never moves", "run.csv: T3 is left out: it is dead"));
  EXPECT_THAT(
      refusal([&] {
        fitted({{file}, "E_Z", {"T1", "T3"}});
      }),
      HasSubstr("run.csv: none of its 120 rows is complete: no value of T3 in 120; 'T3' is dead: it never moves"));
}

/// 3 ΔT1 − 2 ΔT2 with ΔT2 = 0: what stands at a place that did not warm is a reading.
TEST_F(FitErrorModel, PredictsARunInWhichASensorStandsStill) {
  auto const saved = fitted({{put_run(warming(1.5), "monday.csv")}, "E_Z", {"T1", "T2"}});
  auto data = warming(0.7);
  readings(data, "T2").setConstant(21.0);
  auto const prediction = predict_error(saved, put_run(data, "still.csv"));
  VectorXd const first = readings(data, "T1");
  EXPECT_LT((prediction.predicted - 3.0 * (first.array() - first[0]).matrix()).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_THAT(prediction.remarks,
              ElementsAre("still.csv: 'T2' shows 21 degC throughout: its change is taken as 0, unless it is dead"));
  readings(data, "T2").setConstant(-127.0);
  EXPECT_THAT(refusal([&] { (void)predict_error(saved, put_run(data, "dead.csv")); }),
              HasSubstr("no value of T2 in 120; 'T2' reads -127.0 degC in 120 rows"));
}

TEST_F(FitErrorModel, LeavesOutRowsWithoutAReadingOfWhatWasNamed) {
  auto data = warming(1.5);
  readings(data, "T1").segment(10, 5).setConstant(std::nan(""));
  readings(data, "E_Z")[20] = std::nan("");
  auto const file = put_run(data, "run.csv");
  auto const saved = fitted({{file}, "E_Z", {"T1", "T2"}});
  EXPECT_EQ(saved.runs[0].rows, rows - 6);
  EXPECT_TRUE(coefficients(saved).isApprox(Eigen::RowVector2d(3.0, -2.0), 1e-9));
  EXPECT_THAT(remarks_, Contains("run.csv: 6 of 120 rows are left out: no value of T1 in 5, of E_Z in 1"));
  EXPECT_THAT(refusal([&] {
                fitted({{file}, "E_Z", {"T1", "T2"}, "distributed_lag"});
              }),
              HasSubstr("'run.csv': row 11 comes 360 s after the one before, others 60 s; lags need even steps "
                        "(it is the one at 900 s; rows that are left out do not count)"));
  auto const averaged = fitted({{file}, "E_Z", {"T1", "T2"}, "distributed_lag", 1, {}, 600.0});
  EXPECT_EQ(averaged.parts[0].model.sample_period, 600.0);
  EXPECT_EQ(read_back(averaged).sampling, 600.0);
  EXPECT_THAT(refusal([&] {
                fitted({{file}, "E_Z", {"T1"}, "linear", 1, {}, 30.0});
              }),
              HasSubstr("a sampling of 30 s is finer than the 60 s between its rows"));
}

/// A tenth of its readings, as in studies.
TEST_F(FitErrorModel, TakesASensorThatLacksFewReadings) {
  auto data = warming(1.5);
  readings(data, "T1").segment(10, rows / 10).setConstant(std::nan(""));
  EXPECT_THAT(fitted({{put_run(data, "few.csv")}, "E_Z"}).inputs(), ElementsAre("T1", "T2", "T3"));
  EXPECT_THAT(remarks_, Contains("few.csv: 12 of 120 rows are left out: no value of T1 in 12"));
  readings(data, "T1")[9] = std::nan("");
  EXPECT_THAT(fitted({{put_run(data, "more.csv")}, "E_Z"}).inputs(), ElementsAre("T2", "T3"));
  EXPECT_THAT(remarks_, Contains("more.csv: T1 is left out: 13 of 120 readings are missing, more than 10 %"));
}

/// Where the error is missing, nothing can be learnt, with or without a reading.
TEST_F(FitErrorModel, CountsReadingsWhereThereIsAnError) {
  auto data = warming(1.5);
  readings(data, "T1").tail(20).setConstant(std::nan(""));
  readings(data, "E_Z").tail(20).setConstant(std::nan(""));
  EXPECT_THAT(fitted({{put_run(data, "run.csv")}, "E_Z"}).inputs(), ElementsAre("T1", "T2", "T3"));
}

/// T4 is T1 but for a millionth of a kelvin: what is left of the error is put down to that.
TEST_F(FitErrorModel, SaysWhatErrorsOfTheSensorsDo) {
  auto data = warming(1.5);
  VectorXd const number = VectorXd::LinSpaced(rows, 1.0, double(rows));
  readings(data, "E_Z").array() += 0.1 * number.array().square().sin();
  data.readings.push_back(
      {"T4", "degC", "", readings(data, "T1").array() + 1e-6 * (3.0 * number.array().square()).cos()});
  auto const file = put_run(data, "run.h5");
  auto const remark = testing::AllOf(HasSubstr("an error of 0.1 K moves the prediction by "),
                                     HasSubstr("a method with a penalty (ridge)"));
  (void)fitted({{file}, "E_Z", {"T1", "T2", "T4"}});
  EXPECT_THAT(remarks_, Contains(remark));
  (void)fitted({{file}, "E_Z", {"T1", "T2", "T4"}, "ridge"});
  EXPECT_THAT(remarks_, Not(Contains(remark)));
  (void)fitted({{file}, "E_Z", {"T1", "T2"}});
  EXPECT_THAT(remarks_, Not(Contains(remark)));
}

/// Temperatures every minute, the probe every ten: all rows are predicted, those with the probe's are judged, and the
/// first two, which are the lags' history, are not claimed.
TEST_F(FitErrorModel, PredictsRowsWithoutTheError) {
  auto const saved = fitted({{put_run(warming(1.5), "monday.csv")}, "E_Z", {"T1", "T2"}, "distributed_lag"});
  auto data = warming(0.7);
  auto const whole = predict_error(saved, put_run(data, "whole.csv"));
  for (Index i = 0; i < rows; ++i)
    if (i % 10 != 0) readings(data, "E_Z")[i] = std::nan("");
  auto const sparse = predict_error(saved, put_run(data, "sparse.csv"));
  EXPECT_EQ(sparse.predicted, whole.predicted);
  EXPECT_THAT(sparse.remarks, Contains("sparse.csv: 108 of 120 rows show no E_Z; the others are judged"));
  EXPECT_THAT(prediction_text(sparse), HasSubstr("\nless prediction       11  "));
  auto const json = nlohmann::json::parse(predictions_json(saved, {sparse})).at("runs").at(0);
  EXPECT_EQ(json.at("rows"), rows - 2);
  EXPECT_EQ(json.at("judged"), 11);
  EXPECT_THAT(prediction_csv(sparse), testing::StartsWith("time_s,error_um,predicted_um\n0,0,\n60,,\n120,,"));
  EXPECT_THAT(prediction_csv(sparse), Not(HasSubstr("\n120,,\n")));
}

TEST_F(FitErrorModel, PredictsARunWhoseErrorNeverMoves) {
  auto const saved = fitted({{put_run(warming(1.5), "monday.csv")}, "E_Z", {"T1", "T2"}});
  auto data = warming(0.7);
  auto const whole = predict_error(saved, put_run(data, "whole.csv"));
  readings(data, "E_Z").setConstant(3.0);
  auto const constant = predict_error(saved, put_run(data, "constant.csv"));
  EXPECT_EQ(constant.predicted, whole.predicted);
  EXPECT_THAT(constant.remarks, ElementsAre("constant.csv: 'E_Z' is dead: it never moves"));
  EXPECT_THAT(prediction_text(constant), HasSubstr("120 rows predicted; the run does not show the error"));
}

/// The temperatures count from the first row all the same.
TEST_F(FitErrorModel, JudgesAnErrorThatBeginsLate) {
  auto const saved = fitted({{put_run(warming(1.5), "monday.csv")}, "E_Z", {"T1", "T2"}});
  auto data = warming(0.7);
  auto const whole = predict_error(saved, put_run(data, "whole.csv"));
  readings(data, "E_Z").head(20).setConstant(std::nan(""));
  auto const late = predict_error(saved, put_run(data, "late.csv"));
  EXPECT_EQ(late.predicted, whole.predicted);
  EXPECT_LT((late.shown() - whole.shown()).bottomRows(rows - 20).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_FALSE(late.shown().topRows(20).array().isFinite().any());
  EXPECT_THAT(late.remarks, Contains(HasSubstr("late.csv: the error begins in row 21; it counts from the ")));
}

TEST_F(FitErrorModel, KnowsARunAgainThatLacksTheErrorInPart) {
  auto data = warming(1.5);
  readings(data, "E_Z").head(3).setConstant(std::nan(""));
  auto const file = put_run(data, "monday.csv");
  EXPECT_TRUE(predict_error(fitted({{file}, "E_Z", {"T1", "T2"}}), file).seen_before);
}

TEST_F(FitErrorModel, SaysThatTheFirstRowMayBeAnOutlier) {
  auto const saved = fitted({{put_run(warming(1.5), "monday.csv")}, "E_Z", {"T1", "T2"}});
  auto data = warming(0.7);
  EXPECT_THAT(predict_error(saved, put_run(data, "whole.csv")).remarks, IsEmpty());
  readings(data, "E_Z")[0] += 4.0;
  EXPECT_THAT(
      predict_error(saved, put_run(data, "off.csv")).remarks,
      ElementsAre("off.csv: all rows are off by about -4.00 um, from the next one on: row 1, from which changes "
                  "count, may be an outlier"));
}

TEST_F(FitErrorModel, TellsTablesOfPredictionsByTheirHeader) {
  auto const run = put_run(warming(1.5), "monday.h5");
  for (auto const* error : {"E_Z", "slope z"}) {
    auto const table = prediction_csv(predict_error(fitted({{run}, error, {"T1"}}), run));
    EXPECT_TRUE(is_prediction_header(table.substr(0, table.find('\n')))) << error;
  }
  for (auto const* other : {"time_s,T1_degC", "time_s,error_um", "notes"}) EXPECT_FALSE(is_prediction_header(other));
}

/// A sensor of 1/16 K that shows one step up in the fit, and one down later.
TEST_F(FitErrorModel, TakesAStepOfTheReadingsForNoExtrapolation) {
  auto monday = warming(1.5), tuesday = monday;
  for (Index i = 0; i < rows; ++i) {
    readings(monday, "T3")[i] = i * i % 7 == 2 ? 20.0625 : 20.0;
    readings(tuesday, "T3")[i] = i * i % 7 == 2 ? 19.9375 : 20.0;
  }
  auto const saved = fitted({{put_run(monday, "monday.h5")}, "E_Z", {"T1", "T2", "T3"}});
  EXPECT_THAT(predict_error(saved, put_run(tuesday, "tuesday.h5")).remarks, Not(Contains(HasSubstr("extrapolation"))));
  for (double& reading : readings(tuesday, "T3")) reading = 20.0 + 3.0 * (reading - 20.0);
  readings(tuesday, "T3")[5] = 20.0625;
  EXPECT_THAT(predict_error(saved, put_run(tuesday, "wednesday.h5")).remarks, Contains(HasSubstr("extrapolation")));
}

/// The error is 3 ΔT1 − 2 ΔT2 of the changes since the first row: with another zero no coefficients would make it.
/// All sensors and the error from the same row: no intercept makes up for what one of them went through before.
TEST_F(FitErrorModel, CountsFromTheFirstRowThatHasAll) {
  auto data = warming(1.5);
  data.readings[1].values[0] = std::nan("");
  auto const saved = fitted({{put_run(data, "run.csv")}, "E_Z", {"T1", "T2"}});
  EXPECT_EQ(saved.runs[0].rows, rows - 1);
  EXPECT_NEAR(saved.runs[0].zero[0], data.readings[0].values[1], 1e-3);
  EXPECT_NEAR(saved.runs[0].zero[1], data.readings[1].values[1], 1e-3);
  EXPECT_THAT(remarks_, ElementsAre("run.csv: 1 of 120 rows are left out: no value of T2 in 1",
                                    "run.csv: changes count from row 2, the first in which all have a value"));
  auto const whole = fitted({{put_run(warming(1.5), "whole.csv")}, "E_Z", {"T1", "T2"}});
  auto const& form = std::get<models::LinearForm>(saved.parts.at(0).model.form);
  EXPECT_TRUE(coefficients(saved).isApprox(coefficients(whole), 1e-6));
  EXPECT_NEAR(form.intercept, 0.0, 1e-6);
}

TEST_F(FitErrorModel, SaysWhichSensorsOnlySomeRunsHave) {
  auto fewer = warming(0.7);
  fewer.readings.pop_back();
  auto const with = put_run(warming(1.5), "with.csv"), without = put_run(fewer, "without.csv");
  for (auto const& runs : {std::vector{with, without}, std::vector{without, with}}) {
    EXPECT_THAT(fitted({runs, "E_Z"}).inputs(), ElementsAre("T1", "T2"));
    EXPECT_THAT(remarks_, ElementsAre("without.csv: T3 is left out: it is not there"));
  }
}

TEST_F(FitErrorModel, SaysWhichDataItWasGivenTwice) {
  auto const monday = put_run(warming(1.5), "monday.h5"), tuesday = put_run(warming(0.7), "tuesday.h5");
  (void)fitted({{monday, tuesday, put_run(warming(1.5), "again.csv")}, "E_Z", {"T1", "T2"}});
  EXPECT_THAT(remarks_, ElementsAre("again.csv: the same data as monday.h5; they count once more"));
}

TEST_F(FitErrorModel, SaysWhereItExtrapolates) {
  auto const saved = read_back(fitted({{put_run(warming(1.0), "monday.h5")}, "E_Z", {"T1", "T2"}}));
  ASSERT_EQ(saved.parts[0].ranges.size(), 2U);
  EXPECT_EQ(saved.parts[0].ranges[0].lowest, 0.0);
  EXPECT_NEAR(saved.parts[0].ranges[1].highest, 3.0 * std::sqrt(119.0 / 60.0), 1e-3);
  auto inside = warming(1.0, 35.0);  // another room is no extrapolation: the model sees changes
  EXPECT_THAT(predict_error(saved, put_run(inside, "inside.h5")).remarks, IsEmpty());
  auto beyond = inside;
  readings(beyond, "T2").tail(7).array() += 2.0;
  EXPECT_THAT(predict_error(saved, put_run(beyond, "beyond.h5")).remarks,
              ElementsAre("beyond.h5: extrapolation in 7 of 120 rows: T2 changed by 6.22 K; the model was fitted on "
                          "changes of 0.00 K to 4.22 K"));
  auto unknown = saved;
  unknown.parts[0].ranges.clear();
  EXPECT_THAT(predict_error(read_back(unknown), folder_ / "beyond.h5").remarks, IsEmpty());
}

TEST_F(FitErrorModel, NamesTheNearest) {
  auto const file = put_run(warming(1.5), "run.csv");
  EXPECT_THAT(refusal([&] {
                fitted({{file}, "E_Y", {"T1"}});
              }),
              HasSubstr("run.csv has no displacement 'E_Y'; did you mean 'E_Z'"));
  EXPECT_THAT(refusal([&] {
                fitted({{file}, "E_Z", {"T1", "T4"}});
              }),
              HasSubstr("run.csv has no sensor 'T4'; did you mean"));
  EXPECT_THAT(refusal([&] {
                fitted({{file}, "E_Z", {"T1", "T2", "T3", "T4"}});
              }),
              HasSubstr("run.csv has no sensor 'T4'; it has T1, T2, T3"));
  EXPECT_THAT(refusal([&] {
                fitted({{file}, "E_Z,B_Y", {"T1"}});
              }),
              HasSubstr("'E_Z,B_Y': a model is of one error; name one at a time"));
  EXPECT_THAT(refusal([&] { fitted({{file}, "E_Z", {"T1"}, "rigde"}); }), HasSubstr("ridge"));
  EXPECT_THAT(refusal([&] { fitted({{folder_ / "run.txt"}, "E_Z", {"T1"}}); }), HasSubstr("is no measured run"));
}

TEST_F(FitErrorModel, NamesTheRunThatCannotBeFitted) {
  auto data = warming(1.5);
  readings(data, "T3") = readings(data, "T1");
  auto const file = put_run(data, "run.csv");
  EXPECT_THAT(refusal([&] {
                fitted({{file}, "E_Z", {"T1", "T3"}});
              }),
              testing::StartsWith("run.csv: regressor 'T3' is a combination of the ones before it"));
  EXPECT_THAT(refusal([&] {
                fitted({{file}, "E_Z", {"T1"}, "linear", 1, {}, 3.6e5});
              }),
              testing::StartsWith("run.csv, means over 360000 s: sensor 'T1' does not move"));
}

TEST_F(FitErrorModel, SaysThatAnErrorIsThereInAnotherUnit) {
  auto data = warming(1.5);
  data.readings.push_back({"E_Z", "degC", "", readings(data, "E_Z")});
  std::erase_if(data.displacements, [](auto const& channel) { return channel.name == "E_Z"; });
  auto const file = put_run(data, "run.csv");
  EXPECT_THAT(refusal([&] {
                fitted({{file}, "E_Z", {"T1"}});
              }),
              HasSubstr("run.csv has no displacement 'E_Z': it is there in degC"));
  EXPECT_THAT(refusal([&] {
                fitted({{file}, "E_Z", {"B_Y"}});
              }),
              HasSubstr("run.csv has no sensor 'B_Y': it is there in urad"));
}

/// The twin tells most of the error, the model what it errs by.
TEST_F(FitErrorModel, BesideATwinAddsToWhatThatSays) {
  auto const train = put_run(poorly_greased("golden_b_6000"), "train.h5"),
             test = put_run(poorly_greased("golden_b_4000"), "test.h5");
  std::filesystem::copy_file(machine_file("v450"), folder_ / "mine.toml");
  ErrorModelFit fit{{train}, "E_Z", {"T1", "T3"}};
  auto const alone = predict_error(fitted(fit), test);
  fit.twin = folder_ / "mine.toml";
  auto const saved = fitted(fit);
  auto const beside = predict_error(saved, test);
  EXPECT_EQ(beside.predicted, predict_error(read_back(saved), test).predicted);
  EXPECT_TRUE(beside.shown().isApprox(alone.shown(), 1e-12));
  auto const rms = [](ErrorPrediction const& p) { return (p.shown() - p.predicted).norm(); };
  EXPECT_LT(rms(beside), 0.5 * rms(alone));

  fit.method = "twin & linear & twin ridge";
  auto const mean = read_back(fitted(fit));
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(beside.predicted.rows(), 1);
  for (auto const* part : {"twin", "twin ridge"}) {
    fit.method = part;
    sum += predict_error(read_back(fitted(fit)), test).predicted;
  }
  EXPECT_TRUE(predict_error(mean, test).predicted.isApprox((sum + alone.predicted) / 3.0, 1e-12));
  EXPECT_THAT(error_model_text(mean), HasSubstr("the mean of twin & linear & twin ridge of E_Z [um]"));
  EXPECT_THAT(error_model_text(mean), HasSubstr("\nthe twin is mine.toml\n"));

  put(folder_ / "mine.toml", contents(folder_ / "mine.toml") + "# changed\n");
  EXPECT_THAT(refusal([&] { (void)predict_error(saved, test); }),
              HasSubstr("mine.toml is no longer the file beside which the model was fitted"));
  EXPECT_THAT(refusal([&] {
                fitted({{train}, "slope z", {"T1"}, "linear", 1, folder_ / "mine.toml"});
              }),
              HasSubstr("'slope z': a slope is fitted without a twin"));
  EXPECT_THAT(refusal([&] {
                fitted({{train}, "E_Z", {"T1"}, "twin & ridge"});
              }),
              HasSubstr("'twin & ridge': the twin's machine file is missing; give --twin FILE"));
}

TEST_F(FitErrorModel, IsToldToProgramsAsToPeople) {
  auto const saved = fitted({{put_run(warming(1.5), "monday.h5")}, "slope z", {"T1"}});
  auto const json = error_model_json(saved);
  EXPECT_EQ(json.at("method"), "linear");
  EXPECT_EQ(json.at("error"), "slope z");
  EXPECT_EQ(json.at("unit"), "um/m");
  EXPECT_NEAR(json.at("zero_position_mm"), 100.0, 1e-6);
  EXPECT_EQ(json.at("inputs").at(0), "T1");
  EXPECT_EQ(json.at("fitted_to").at(0).at("file"), "monday.h5");
  EXPECT_EQ(json.at("fitted_to").at(0).at("zero_degC").at(0), 20.0);
}

TEST_F(FitErrorModel, IsJudgedOnOtherRuns) {
  auto monday = warming(1.5);
  monday.provenance["machine.file"] = "name = \"v450\"\n";
  auto const saved = read_back(fitted({{put_run(monday, "monday.h5")}, "E_Z", {"T1"}}));
  EXPECT_EQ(saved.runs[0].machine, "v450");
  auto const same = predict_error(saved, folder_ / "monday.h5");
  EXPECT_TRUE(same.seen_before);
  EXPECT_NEAR((same.shown() - same.predicted).norm() / std::sqrt(double(rows)), saved.runs[0].rmse, 1e-9);
  EXPECT_THAT(prediction_text(same), HasSubstr("the model was fitted to these very data"));

  auto other = warming(0.7);
  other.provenance["machine.file"] = "name = \"g200\"\n";
  auto const unlike = predict_error(saved, put_run(other, "other.h5"));
  EXPECT_FALSE(unlike.seen_before);
  EXPECT_THAT(unlike.remarks, ElementsAre("other.h5: of 'g200'; the model was fitted to 'v450'"));

  auto bare = warming(0.7);
  bare.displacements.clear();
  EXPECT_THAT(prediction_text(predict_error(saved, put_run(bare, "bare.csv"))),
              HasSubstr("120 rows predicted; the run does not show the error"));
  EXPECT_EQ(predict_error(saved, folder_ / "bare.csv").predicted, unlike.predicted);
  bare.readings.erase(bare.readings.begin());
  EXPECT_THAT(refusal([&] { (void)predict_error(saved, put_run(bare, "poor.csv")); }),
              HasSubstr("poor.csv has no sensor 'T1'; did you mean 'T2'"));
}

}  // namespace
}  // namespace thermotwin::twin
