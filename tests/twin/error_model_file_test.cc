#include "twin/error_model_file.h"

#include <Eigen/Core>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/output/temporary_directory.h"
#include "thermal/error.h"
#include "twin/study/judgement.h"

namespace thermotwin::twin {
namespace {

using models::Batch;
using models::ErrorModel;
using testing::HasSubstr;

/// Two sensors with numbers that need all their digits.
Batch run() {
  constexpr Eigen::Index instants = 60;
  Batch batch{"run",
              Eigen::VectorXd::LinSpaced(instants, 0, 180.0 * (instants - 1)),
              {"T2 \"front\"", "T4"},
              {"spindle", "head"},
              Eigen::MatrixXd(instants, 2),
              Eigen::VectorXd(instants)};
  for (Eigen::Index t = 0; t < instants; ++t) {
    double const hours = 0.05 * double(t);
    batch.temperature_rise.row(t) << 12.0 * (1 - std::exp(-hours / 0.4)) + 0.2 * std::sin(40.0 * hours * hours),
        7.0 * (1 - std::exp(-hours / 1.3)) + 0.1 * std::sin(25.0 * hours * hours);
    batch.error(t) = 2.0 * batch.temperature_rise(t, 0) + std::sin(7.0 * batch.temperature_rise(t, 1)) / 3.0;
  }
  return batch;
}

/// Of everything that a file can say.
SavedErrorModel saved(ErrorModel const& model) {
  SavedErrorModel all;
  all.error = "E_Z";
  all.title = "spindle nose, \"axial\"";
  all.version = "0.1.0";
  all.commit = "1fdea30";
  all.sampling = 60.0;
  all.runs = {{"monday.h5", "v450", "8c", 60, {20.1, 19.98}, 0.1, 1.0 / 3.0},
              {"tuesday.csv", "", "9d", 41, {7, 8}, 0, 0}};
  all.parts = {{model, false, {{-0.125, 7.8}, {0.0, 3.251}}}};
  return all;
}

class SavedModel : public testing::TestWithParam<std::string> {
 protected:
  tests::TemporaryDirectory directory_;
};

std::vector<std::string> names() {
  std::vector<std::string> result;
  for (auto const& method : models::model_methods()) result.emplace_back(method.name);
  return result;
}

INSTANTIATE_TEST_SUITE_P(Methods, SavedModel, testing::ValuesIn(names()), [](auto const& info) { return info.param; });

TEST_P(SavedModel, PredictsTheSameBytes) {
  auto const batch = run();
  auto const fitted = models::model_method(GetParam()).fit(std::span(&batch, 1), {});
  write_error_model(directory_ / "model.toml", saved(fitted));
  auto const whole = read_error_model(directory_ / "model.toml");
  ASSERT_EQ(whole.parts.size(), 1U);
  auto const& read = whole.parts[0].model;
  EXPECT_EQ(read.predict(batch), fitted.predict(batch));
  EXPECT_EQ(whole.error, "E_Z");
  EXPECT_EQ(whole.title, "spindle nose, \"axial\"");
  EXPECT_EQ(whole.sampling, 60.0);
  EXPECT_EQ(whole.runs[0].largest, 1.0 / 3.0);
  EXPECT_EQ(whole.parts[0].ranges, (std::vector<InputRange>{{-0.125, 7.8}, {0.0, 3.251}}));
  EXPECT_EQ(read.method, fitted.method);
  EXPECT_EQ(read.inputs, fitted.inputs);
  EXPECT_EQ(read.parameters, fitted.parameters);
  EXPECT_EQ(read.sample_period, fitted.sample_period);
  EXPECT_EQ(read.remark, fitted.remark);
  EXPECT_EQ(read.unclaimed_instants(), fitted.unclaimed_instants());
  write_error_model(directory_ / "again.toml", whole);
  EXPECT_EQ(tests::contents(directory_ / "again.toml"), tests::contents(directory_ / "model.toml"));
}

class ErrorModelFile : public testing::Test {
 protected:
  std::string complaint(std::string const& text) {
    tests::put(directory_ / "model.toml", text);
    try {
      static_cast<void>(read_error_model(directory_ / "model.toml"));
    } catch (thermal::InputError const& error) {
      return error.what();
    }
    return "";
  }
  static std::string linear(std::string const& form) {
    return predicts + "[model]\nmethod = \"ridge\"\ninputs = [\"T2\", \"T4\"]\n[model.linear]\n" + form;
  }
  static std::string whole(std::string const& head) {
    return head + "[model]\nmethod = \"ridge\"\ninputs = [\"T2\"]\n" +
           "[model.linear]\nintercept = 1\nlag = [{ samples = 0, coefficients = [1] }]\n";
  }
  static inline std::string const predicts = "predicts = { error = \"E_X\" }\n";
  tests::TemporaryDirectory directory_;
};

TEST_F(ErrorModelFile, RefusesWhatIsNoModel) {
  EXPECT_THAT(complaint("title = \"run\"\n"), HasSubstr("model.toml:1:1: no table [model]"));
  EXPECT_THAT(complaint("[model]\nmethod = \n"), HasSubstr("model.toml:2:"));
}

TEST_F(ErrorModelFile, NamesTheNearestMethod) {
  EXPECT_THAT(complaint(predicts + "[model]\nmethod = \"rigde\"\ninputs = [\"T2\"]\n"),
              HasSubstr("model.toml:3:10: no model 'rigde'; did you mean 'ridge'?"));
}

TEST_F(ErrorModelFile, WantsExactlyOneForm) {
  EXPECT_THAT(complaint(predicts + "[model]\nmethod = \"ridge\"\ninputs = [\"T2\"]\n"), HasSubstr("exactly one of"));
  EXPECT_THAT(complaint(predicts + "[model]\nmethod = \"ridge\"\n[model.linear]\nintercept = 1\n"),
              HasSubstr("'inputs' is missing"));
}

TEST_F(ErrorModelFile, CountsTheNumbersOfEachLag) {
  EXPECT_EQ(complaint(linear("intercept = 1\nlag = [{ samples = 0, coefficients = [1, 2] }]\n")), "");
  EXPECT_THAT(complaint(linear("intercept = 1\nlag = [{ samples = 0, coefficients = [1] }]\n")),
              HasSubstr("model.toml:5:1: 'coefficients' has 1 numbers; the model has 2 inputs"));
  EXPECT_THAT(complaint(linear("intercept = 1\nlag = [{ samples = 2, coefficients = [1, 2] }, "
                               "{ samples = 1, coefficients = [1, 2] }]\n")),
              HasSubstr("lags ascend"));
  EXPECT_THAT(complaint(linear("intercept = 1\nlag = [{ samples = 2, coefficients = [1, 2] }]\n")),
              HasSubstr("model.toml:5:1: lags count samples, and 'sample_period' of the model is missing"));
  EXPECT_THAT(complaint(linear("intercept = 1\n")), HasSubstr("'lag' is missing"));
  EXPECT_THAT(complaint(linear("lag = [{ samples = 0, coefficients = [1, 2] }]\n")),
              HasSubstr("'intercept' is missing"));
  EXPECT_THAT(complaint(linear("intercept = nan\nlag = [{ samples = 0, coefficients = [1, 2] }]\n")),
              HasSubstr("must be finite"));
  EXPECT_THAT(complaint(linear("intercept = 1\nlagg = []\n")), HasSubstr("unknown key 'lagg'; did you mean 'lag'?"));
}

TEST_F(ErrorModelFile, SaysWhatItPredicts) {
  EXPECT_EQ(complaint(whole(predicts)), "");
  EXPECT_THAT(complaint(whole("")), HasSubstr("no table [predicts]: an error model of an earlier version"));
  EXPECT_THAT(complaint(whole("predicts = { unit = \"um\" }\n")), HasSubstr("model.toml:1:12: 'error' is missing"));
  EXPECT_THAT(complaint(whole("predicts = { error = \"E_X\", unit = \"mm\" }\n")),
              HasSubstr("model.toml:1:36: 'unit' is 'mm'; did you mean 'um'?"));
  EXPECT_THAT(complaint(whole("predicts = { error = \"E_X\", unit = \"um/m\" }\n")),
              HasSubstr("the unit of 'E_X' is 'um' or 'urad', not 'um/m'"));
  EXPECT_THAT(complaint(whole("predicts = { error = \"E_X\", zero_position = \"3 mm\" }\n")),
              HasSubstr("'zero_position' is of a slope only"));
  EXPECT_THAT(complaint(whole("predicts = { error = \"slope z\", unit = \"um/m\" }\n")),
              HasSubstr("'zero_position' of the slope is missing"));
  EXPECT_THAT(complaint(whole("predicts = { error = \"slope z\", unit = \"um/m\", zero_position = \"3 mm\" }\n"
                              "twin = { machine = \"a.toml\", fingerprint = \"8c\" }\n")),
              HasSubstr("model.toml:2:8: a slope stands beside no twin"));
  EXPECT_THAT(complaint(whole(predicts + "twin = { machine = \"a.toml\", fingerprint = \"8c\" }\n")),
              HasSubstr("model.toml:2:8: no model stands beside this twin; write for example method = \"twin ridge\""));
  EXPECT_THAT(complaint(whole(predicts + "fit = { run = [{ file = \"a.h5\", rmse = 1, largest = 2 }] }\n")),
              HasSubstr("model.toml:2:16: 'zero_degC' has 0 temperatures; the model has 1 inputs"));
}

TEST_F(ErrorModelFile, KnowsTheRangeOfEachInputOrOfNone) {
  auto const ranged = [](std::string const& ranges) {
    auto text = whole(predicts);
    return text.insert(text.find("[model.linear]"), ranges);
  };
  EXPECT_EQ(complaint(ranged("lowest_K = [0]\nhighest_K = [3]\n")), "");
  EXPECT_THAT(complaint(ranged("lowest_K = [0, 1]\nhighest_K = [3, 4]\n")),
              HasSubstr("model.toml:2:1: 'lowest_K' has 2 numbers and 'highest_K' 2; the model has 1 input"));
  EXPECT_THAT(complaint(ranged("lowest_K = [0]\n")), HasSubstr("'lowest_K' has 1 numbers and 'highest_K' 0"));
  EXPECT_THAT(complaint(ranged("lowest_K = [4]\nhighest_K = [3]\n")),
              HasSubstr("model.toml:5:12: 'lowest_K' 4 is above 'highest_K' 3"));
}

/// A mean of what the twin errs by and of a network, with the twin itself: all three, and the same bytes again.
TEST_F(ErrorModelFile, HoldsTheMeanOfSeveralModels) {
  auto const batch = run();
  auto all = saved(models::model_method("ridge_distributed_lag").fit(std::span(&batch, 1), {}));
  all.parts[0].beside_twin = true;
  all.parts.push_back({models::model_method("back_propagation").fit(std::span(&batch, 1), {}), false, {}});
  all.parts.push_back({nothing_more(batch.sensors), true, {}});
  all.twin = {directory_ / "mine.toml", "8c"};
  write_error_model(directory_ / "model.toml", all);
  auto const read = read_error_model(directory_ / "model.toml");
  EXPECT_EQ(read.method(), "twin ridge_distributed_lag & back_propagation & twin");
  EXPECT_EQ(read.inputs(), batch.sensors);
  EXPECT_EQ(read.unclaimed_instants(), all.unclaimed_instants());
  ErrorModelRun seen;
  seen.batch = batch;
  seen.said = batch;
  seen.said->temperature_rise *= 0.9;
  EXPECT_EQ(read.predict(seen), all.predict(seen));
  Eigen::VectorXd const own = all.parts[0].model.predict(seen.less_twin()) + all.parts[1].model.predict(batch);
  EXPECT_TRUE(Eigen::VectorXd(read.predict(seen)).isApprox((own + 2.0 * batch.error) / 3.0, 1e-12));
  write_error_model(directory_ / "again.toml", read);
  EXPECT_EQ(tests::contents(directory_ / "again.toml"), tests::contents(directory_ / "model.toml"));
}

/// With numbers that need all their digits; its mean with a regression takes what it told, and the regression's own.
TEST_F(ErrorModelFile, HoldsWhatAnObserverBelieves) {
  auto const batch = run();
  ObserverOptions const options{1.0 / 3000.0, 0.1 * std::sqrt(30.0), 90.0 / 7.0};
  auto all = saved({});
  all.parts = {observing_part(batch.sensors, options)};
  all.twin = {directory_ / "mine.toml", "8c"};
  write_error_model(directory_ / "model.toml", all);
  auto const read = read_error_model(directory_ / "model.toml");
  EXPECT_EQ(read.method(), "twin observer");
  EXPECT_EQ(read.inputs(), batch.sensors);
  EXPECT_EQ(read.parts[0].observer, options);
  EXPECT_EQ(read.parts[0].model.remark, "extended Kalman filter, nodes err by 0.000333333 K in a second");
  write_error_model(directory_ / "again.toml", read);
  EXPECT_EQ(tests::contents(directory_ / "again.toml"), tests::contents(directory_ / "model.toml"));

  all.parts.push_back({models::model_method("ridge").fit(std::span(&batch, 1), {}), false, {}});
  write_error_model(directory_ / "model.toml", all);
  auto const mean = read_error_model(directory_ / "model.toml");
  EXPECT_EQ(mean.method(), "twin observer & ridge");
  EXPECT_EQ(mean.parts[0].observer, options);
  ErrorModelRun seen;
  seen.batch = seen.said.emplace(batch);
  seen.observed = 3.0 * batch.error;
  Eigen::VectorXd const own = 0.5 * (3.0 * batch.error + all.parts[1].model.predict(batch));
  EXPECT_TRUE(Eigen::VectorXd(mean.predict(seen)).isApprox(own, 1e-12));
}

TEST_F(ErrorModelFile, RefusesAnObserverThatIsNone) {
  std::string const twin = "twin = { machine = \"a.toml\", fingerprint = \"8c\" }\n";
  auto const model = [&](std::string const& text, std::string const& method = "twin observer") {
    return complaint(predicts + twin + "[model]\nmethod = \"" + method + "\"\ninputs = [\"T2\"]\n" + text);
  };
  std::string const heat = "[model.observer]\nheat_noise = 5e-4\n", noise = "sensor_noise = 0.5\n",
                    step = "longest_step = \"30 s\"\n";
  std::string const form = "[model.linear]\nintercept = 1\nlag = [{ samples = 0, coefficients = [1] }]\n";
  EXPECT_EQ(model(heat + noise + step), "");
  EXPECT_THAT(model(""), HasSubstr("model.toml:3:1: 'observer' of the twin observer is missing; write for example "
                                   "observer = { heat_noise = 5e-4, sensor_noise = 0.5, longest_step = \"30 s\" }"));
  EXPECT_THAT(model(heat + noise + step + form), HasSubstr("model.toml:3:1: an observer has no form"));
  EXPECT_THAT(model(heat + noise + step + form, "twin ridge"),
              HasSubstr("model.toml:6:1: 'observer' is of the method \"twin observer\", not of 'twin ridge'"));
  EXPECT_THAT(model(heat + noise + step, "twin"), HasSubstr("is of the method \"twin observer\", not of 'twin'"));
  EXPECT_THAT(model(heat + noise), HasSubstr("model.toml:6:1: 'longest_step' is missing"));
  EXPECT_THAT(model(heat + step), HasSubstr("model.toml:6:1: 'sensor_noise' is missing"));
  EXPECT_THAT(model("[model.observer]\nheat_nois = 5e-4\n" + noise + step),
              HasSubstr("model.toml:7:1: unknown key 'heat_nois'; did you mean 'heat_noise'?"));
  EXPECT_THAT(model("[model.observer]\nheat_noise = -1\n" + noise + step),
              HasSubstr("model.toml:7:14: 'heat_noise' is -1; it must not be negative"));
  EXPECT_THAT(model(heat + "sensor_noise = 0\n" + step),
              HasSubstr("model.toml:8:16: 'sensor_noise' is 0; it must be positive"));
  EXPECT_THAT(model(heat + noise + "longest_step = \"0 s\"\n"),
              HasSubstr("model.toml:9:16: 'longest_step' is \"0 s\"; it must be positive"));
  EXPECT_THAT(model(heat + noise + "longest_step = 30\n"), HasSubstr("model.toml:9:16: 'longest_step': "));
  EXPECT_THAT(complaint(predicts + "[model]\nmethod = \"twin observer\"\ninputs = [\"T2\"]\n" + heat + noise + step),
              HasSubstr("'twin observer' stands beside a twin, and [twin] is missing"));
  EXPECT_THAT(complaint(predicts + twin + "[model]\nmethod = \"twin observer\"\n" + heat + noise + step),
              HasSubstr("model.toml:3:1: 'inputs' is missing or empty"));
  std::string const part =
      "[[part]]\nmethod = \"twin observer\"\ninputs = [\"T2\"]\nobserver = { heat_noise = 5e-4, "
      "sensor_noise = 0.5, longest_step = \"30 s\" }\n";
  EXPECT_THAT(complaint(predicts + twin + part + part),
              HasSubstr("model.toml:7:1: a second 'twin observer'; a mean has one at most"));
}

TEST_F(ErrorModelFile, RefusesPartsThatMakeNoMean) {
  auto const part = [](std::string const& method, std::string const& input, std::string const& form) {
    return "[[part]]\nmethod = \"" + method + "\"\ninputs = [\"" + input + "\"]\n" + form;
  };
  std::string const form = "linear = { intercept = 1, lag = [{ samples = 0, coefficients = [1] }] }\n";
  std::string const twin = "twin = { machine = \"a.toml\", fingerprint = \"8c\" }\n";
  EXPECT_EQ(complaint(predicts + part("ridge", "T2", form) + part("linear", "T2", form)), "");
  EXPECT_EQ(complaint(predicts + twin + part("ridge", "T2", form) + part("twin", "T2", "")), "");
  EXPECT_THAT(complaint(predicts + part("ridge", "T2", form) + part("linear", "T4", form)),
              HasSubstr("model.toml:6:1: other 'inputs' than those of the first [[part]]; all have the same"));
  EXPECT_THAT(complaint(predicts + part("ridge", "T2", form) + part("twin", "T2", "")),
              HasSubstr("'twin' stands beside a twin, and [twin] is missing"));
  EXPECT_THAT(complaint(predicts + twin + part("twin", "T2", form)), HasSubstr("the twin alone has no form"));
  EXPECT_THAT(complaint(predicts + part("ridge", "T2", form) + whole("")),
              HasSubstr("the mean of several models has only [[part]]"));
  EXPECT_THAT(complaint(predicts + twin + part("twin rigde", "T2", form)),
              HasSubstr("model.toml:4:10: no model 'rigde'; did you mean 'ridge'?"));
}

TEST_F(ErrorModelFile, IsReadWithoutItsFit) {
  EXPECT_EQ(complaint(whole(predicts)), "");
  auto const read = read_error_model(directory_ / "model.toml");
  EXPECT_EQ(read.error, "E_X");
  EXPECT_TRUE(read.runs.empty());
  EXPECT_THAT(error_model_text(read), HasSubstr("its file does not say what it was fitted to"));
}

TEST_F(ErrorModelFile, DoesNotSaveWhatIsNoNumber) {
  ErrorModel model{"ridge", {"T2"}, 0, 2, models::LinearForm{std::nan(""), {0}, Eigen::MatrixXd::Ones(1, 1)}, ""};
  EXPECT_THROW(write_error_model(directory_ / "model.toml", saved(model)), thermal::InputError);
  EXPECT_TRUE(directory_.files().empty());
}

}  // namespace
}  // namespace thermotwin::twin
