#include <cmath>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <vector>

#include "models/metrics.h"
#include "output/dataset.h"
#include "tests/output/temporary_directory.h"
#include "tests/scenarios/refusal.h"
#include "tests/twin/fit_error_model.h"
#include "tests/twin/late_record.h"
#include "twin/error_model_file.h"
#include "twin/error_prediction.h"
#include "twin/fit_error_model.h"

/// A twin that observes its machine by what the sensors show, as the error model that it is fitted as.
namespace thermotwin::twin {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using thermotwin::tests::contents;
using thermotwin::tests::put;
using thermotwin::tests::refusal;

/// A v450 with less grease than its file says, and that file as the twin.
class FitObserver : public FitErrorModel {
 protected:
  FitObserver() { std::filesystem::copy_file(machine_file("v450"), folder_ / "mine.toml"); }
  SavedErrorModel observing(std::filesystem::path const& run, std::string const& method = "twin observer",
                            std::vector<std::string> const& sensors = {}, std::optional<double> sampling = {}) {
    return fitted({{run}, "E_Z", sensors, method, 1, folder_ / "mine.toml", sampling});
  }
  static VectorXd missed(ErrorPrediction const& p) { return p.shown() - p.predicted; }

  static void SetUpTestSuite() {
    train_ = poorly_greased("golden_b_6000");
    test_ = poorly_greased("golden_b_4000");
  }
  static output::Dataset train_, test_;
};
output::Dataset FitObserver::train_, FitObserver::test_;

TEST_F(FitObserver, SeesInTheSensorsWhatTheTwinLacks) {
  auto const train = put_run(train_, "train.h5"), test = put_run(test_, "test.h5");
  auto const saved = observing(train);
  EXPECT_THAT(saved.inputs(), ElementsAre("T1", "T2", "T3", "T4", "T5", "T6", "T7", "T8", "T9"));
  EXPECT_THAT(remarks_, ElementsAre("train.h5: T10 is left out: the twin does not have it on a body"));
  auto const before = predict_error(saved, test), after = predict_error(read_back(saved), test);
  EXPECT_EQ(prediction_csv(before), prediction_csv(after));
  EXPECT_LT(missed(after).norm(), 0.6 * missed(predict_error(observing(train, "twin"), test)).norm());
  auto const same = predict_error(read_back(saved), train);
  EXPECT_EQ(models::metrics(same.run.batch.error, same.predicted.col(0)).rmse, saved.runs[0].rmse);
  EXPECT_TRUE(same.seen_before);
  EXPECT_THAT(error_model_text(read_back(saved)),
              HasSubstr("twin observer of E_Z [um] (tool against table, Z; positive: tool approaches table) on T1, T2, "
                        "T3, T4, T5, T6, T7, T8, T9: extended Kalman filter, nodes err by "));
}

/// By the shape of the error: of a run whose first row is off, all others are off by the same.
TEST_F(FitObserver, BelievesWhatMeetsItsRunsBest) {
  auto const train = put_run(train_, "train.h5");
  auto const saved = observing(train);
  auto const chosen = saved.parts.at(0).observer.value();
  auto const spread = [&](ObserverOptions const& options) {
    auto other = saved;
    other.parts = {observing_part(saved.inputs(), options)};
    VectorXd const rest = missed(predict_error(other, train));
    return (rest.array() - rest.mean()).matrix().norm();
  };
  for (double const heat_noise : {1e-4, 5e-4, 2.5e-3}) {
    auto other = chosen;
    other.heat_noise = heat_noise;
    if (other != chosen) {
      EXPECT_GT(spread(other), spread(chosen)) << heat_noise;
    }
  }
  auto off = train_;
  readings(off, "E_Z")[0] += 4.0;
  EXPECT_EQ(observing(put_run(off, "off.h5")).parts[0].observer, chosen);
}

TEST_F(FitObserver, HasAPartInAMean) {
  auto const train = put_run(train_, "train.h5"), test = put_run(test_, "test.h5");
  auto const mean = read_back(observing(train, "twin observer & ridge & twin & twin ridge", {"T3", "T1"}));
  EXPECT_EQ(mean.method(), "twin observer & ridge & twin & twin ridge");
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(test_.time_s.size(), 1);
  for (auto const* part : {"twin observer", "twin", "twin ridge"})
    sum += predict_error(observing(train, part, {"T3", "T1"}), test).predicted;
  sum += predict_error(fitted({{train}, "E_Z", {"T3", "T1"}, "ridge"}), test).predicted;
  EXPECT_TRUE(predict_error(mean, test).predicted.isApprox(sum / 4.0, 1e-9));
}

/// What it tells of the rows is averaged: told means, at their stretches' starts, it would lack the warming of half of
/// one.
TEST_F(FitObserver, FollowsTheRowsWhereMeansAreFitted) {
  auto const recorded = [&](std::string const& name) {
    auto programme = read_experiment(read_toml(experiment_file(name)), experiment_file(name));
    programme.sampling = 30.0;
    return put_run(run(Machine::read(machine_file("v450")), programme, {}).dataset, name + ".h5");
  };
  auto const train = recorded("golden_b_6000"), test = recorded("golden_b_4000");
  auto const of_rows = observing(train, "twin observer", {"T1", "T3"}),
             of_means = read_back(observing(train, "twin observer", {"T1", "T3"}, 300.0));
  EXPECT_EQ(of_means.parts.at(0).observer, of_rows.parts.at(0).observer);
  auto const rows = predict_error(of_rows, test), means = predict_error(of_means, test);
  auto const rms = [](ErrorPrediction const& p) { return missed(p).norm() / std::sqrt(double(p.predicted.rows())); };
  EXPECT_LT(rms(rows), 0.3);
  EXPECT_NEAR(rms(means), rms(rows), 0.1);
  VectorXd const told = rows.predicted.col(0);
  constexpr Index in_stretch = 10;
  ASSERT_EQ(means.predicted.rows(), (told.size() + in_stretch - 1) / in_stretch);
  for (Index k = 0; k < told.size() / in_stretch; ++k)
    EXPECT_NEAR(means.predicted(k, 0), told.segment(in_stretch * k, in_stretch).mean() - told.head(in_stretch).mean(),
                1e-9)
        << k;
}

TEST_F(FitObserver, FindsItsSensorsByNameAndRefusesARunWithoutOne) {
  auto const saved = read_back(observing(put_run(train_, "train.h5"), "twin observer", {"T3", "T1"}));
  EXPECT_THAT(saved.inputs(), ElementsAre("T3", "T1"));
  auto data = test_;
  auto const predicted = predict_error(saved, put_run(data, "test.h5")).predicted;
  std::reverse(data.readings.begin(), data.readings.end());
  for (auto& channel : data.displacements) channel.values.array() += 40.0;
  EXPECT_EQ(predict_error(saved, put_run(data, "reversed.h5")).predicted, predicted);
  std::erase_if(data.readings, [](auto const& channel) { return channel.name == "T3"; });
  EXPECT_THAT(refusal([&] { (void)predict_error(saved, put_run(data, "poor.h5")); }),
              HasSubstr("poor.h5 has no sensor 'T3'; did you mean 'T"));
  data = test_;
  std::erase_if(data.inputs, [](auto const& channel) { return channel.name == "spindle.speed"; });
  EXPECT_THAT(refusal([&] { (void)predict_error(saved, put_run(data, "blind.h5")); }),
              HasSubstr("blind.h5: the machine 'v450' needs inputs that the data lack: spindle.speed; the data have "
                        "spindle.running, "));
}

TEST_F(FitObserver, IsOfItsMachineOnly) {
  auto const train = put_run(train_, "train.h5");
  auto const saved = observing(train, "twin observer", {"T1"});
  auto other = test_;
  other.provenance["machine.file"] = "name = \"v450_fine\"\n";
  EXPECT_EQ(predict_error(saved, put_run(other, "fine.h5")).predicted.rows(), other.time_s.size());
  other.provenance["machine.file"] = "name = \"g200\"\n";
  auto const refused = HasSubstr("other.h5 is a run of 'g200'; 'twin observer' observes 'v450'");
  EXPECT_THAT(refusal([&] { (void)predict_error(saved, put_run(other, "other.h5")); }), refused);
  EXPECT_THAT(refusal([&] { observing(folder_ / "other.h5", "twin observer", {"T1"}); }), refused);
  auto fitted_elsewhere = saved;
  fitted_elsewhere.runs[0].machine = "g200";
  EXPECT_THAT(refusal([&] { (void)predict_error(fitted_elsewhere, folder_ / "other.h5"); }), refused);
  EXPECT_THAT(predict_error(fitted_elsewhere, train).predicted, predict_error(saved, train).predicted);
  put(folder_ / "mine.toml", contents(folder_ / "mine.toml") + "# changed\n");
  EXPECT_THAT(refusal([&] { (void)predict_error(saved, train); }),
              HasSubstr("mine.toml is no longer the file beside which the model was fitted"));
}

TEST_F(FitObserver, SaysThatItBeginsWithTheRoom) {
  auto const file = put_run(tests::without_first(20, train_), "late.csv");
  auto const remark =
      HasSubstr("late.csv: it begins warm: an observer of fewer than four sensors is not told how warm");
  auto const saved = observing(file, "twin observer", {"T1"});
  EXPECT_THAT(remarks_, Contains(remark));
  EXPECT_THAT(predict_error(saved, file).remarks, Contains(remark));
  EXPECT_THAT(predict_error(saved, put_run(test_, "test.h5")).remarks, Not(Contains(HasSubstr("observer"))));
}

TEST_F(FitObserver, RefusesWhatCannotBeObserved) {
  auto const train = put_run(train_, "train.h5");
  auto const complaint = [&](std::string const& error, std::vector<std::string> const& sensors) {
    return refusal([&] { fitted({{train}, error, sensors, "twin observer", 1, folder_ / "mine.toml"}); });
  };
  EXPECT_THAT(complaint("slope z", {"T1"}), HasSubstr("'slope z': a slope is fitted without a twin"));
  EXPECT_THAT(complaint("E_W", {"T1"}), HasSubstr("the machine has no displacement 'E_W'; did you mean 'E_X'?"));
  EXPECT_THAT(complaint("A", {"T1"}), HasSubstr("'A' of the machine is an angle; the twin observes displacements"));
  EXPECT_THAT(complaint("E_Z", {"T1", "T10"}), HasSubstr("the twin has no sensor 'T10' on a body; did you mean 'T1'?"));
  auto const twice = HasSubstr("batch 'train.h5': sensor 'T1' occurs twice");
  EXPECT_THAT(complaint("E_Z", {"T1", "T3", "T1"}), twice);
  auto saved = observing(train, "twin observer", {"T1"});
  saved.parts[0] = observing_part({"T1", "T1"}, *saved.parts[0].observer);
  EXPECT_THAT(refusal([&] { (void)predict_error(saved, train); }), twice);
  for (auto const* error : {"E_Z", "slope z"})
    EXPECT_THAT(refusal([&] {
                  fitted({{train}, error, {"T1"}, "twin observer & ridge"});
                }),
                HasSubstr(error[0] == 'E' ? "the twin's machine file is missing; give --twin FILE"
                                          : "a slope is fitted without a twin"));
  put(folder_ / "mine.toml", contents(folder_ / "mine.toml") +
                                 "[[chiller]]\nname = \"head\"\ncools = \"head_front\"\ntemperature = \"22 degC\"\n"
                                 "power = \"800 W\"\nhysteresis = \"0.4 K\"\n");
  EXPECT_THAT(complaint("E_Z", {"T1"}),
              HasSubstr("the relay 'chiller.head' switches by itself; the twin observes no machine with relays"));
}

}  // namespace
}  // namespace thermotwin::twin
