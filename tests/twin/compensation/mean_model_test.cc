#include "twin/compensation/mean_model.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "output/dataset_file.h"
#include "tests/output/temporary_directory.h"
#include "tests/scenarios/refusal.h"
#include "tests/twin/compensation/closed_loop.h"
#include "twin/error_prediction.h"
#include "twin/fit_error_model.h"

namespace thermotwin::twin {
namespace {

using testing::HasSubstr;

/// A machine with less grease and a stronger pump than its file says.
output::Dataset other_machine(std::string const& experiment, double sampling = 60.0) {
  return tests::simulated(experiment, sampling,
                          {{"bearing.front.grease_factor", "0.55"}, {"heat.coolant_pump.power", "600 W"}});
}

/// A row of a run in the order of a model's inputs.
std::vector<double> values_of(output::Dataset const& data, Eigen::Index row, MeanModel const& model) {
  std::vector<double> values;
  for (auto const& input : model.inputs())
    values.push_back(find_channel(input.sensor ? data.readings : data.inputs, input.name)->values[row]);
  return values;
}

/// Of what the twin errs by alone, and of its mean with the twin and a regression on the readings themselves.
TEST(MeanModel, TellsLiveWhatThePredictionOfTheRunTells) {
  thermotwin::tests::TemporaryDirectory const folder;
  output::write(other_machine("duty_003_other"), folder / "train.h5");
  auto const duty = other_machine("duty_003");
  output::write(duty, folder / "duty.h5");
  ErrorModelFit fit{{folder / "train.h5"}, "E_X", {"T2", "T10"}};
  fit.twin = machine_file("g200");
  for (auto const* method : {"linear", "twin", "twin & linear & twin ridge"}) {
    fit.method = method;
    std::vector<std::string> remarks;
    auto const saved = fit_error_model(fit, remarks);
    auto const predicted = predict_error(saved, folder / "duty.h5");
    MeanModel live(saved);
    for (Eigen::Index row = 0; row < duty.time_s.size(); ++row)
      EXPECT_NEAR(live.error(duty.time_s[row], values_of(duty, row, live)), predicted.predicted(row, 0), 0.1)
          << method << " at " << duty.time_s[row];
  }
}

TEST(MeanModel, IsTheMeanOfItsModels) {
  auto const constant = [](double value) {
    return SavedModel({"linear", {"T1"}, 0, 2, models::LinearForm{value, {0}, Eigen::MatrixXd::Ones(1, 1)}, ""},
                      {{0.0, 1.0}});
  };
  MeanModel live(std::nullopt, {{constant(1.0)}, {constant(4.0)}});
  ASSERT_EQ(live.inputs().size(), 1U);
  EXPECT_EQ(live.error(0.0, std::vector{20.0}), 2.5);
  EXPECT_EQ(live.error(1.0, std::vector{23.0}), 5.5);
  EXPECT_TRUE(live.extrapolated().contains("T1"));
}

/// In rows of a longest step, so that the observer lives through the same instants in both.
TEST(MeanModel, ObservesLiveAsInThePredictionOfTheRun) {
  thermotwin::tests::TemporaryDirectory const folder;
  output::write(other_machine("duty_003_other"), folder / "train.h5");
  auto const duty = other_machine("duty_003", 30.0);
  output::write(duty, folder / "duty.h5");
  ErrorModelFit fit{{folder / "train.h5"}, "E_X", {"T10", "T2"}};
  fit.twin = machine_file("g200");
  for (std::string const method : {"twin observer", "twin observer & linear"}) {
    fit.method = method;
    std::vector<std::string> remarks;
    auto const saved = fit_error_model(fit, remarks);
    auto const predicted = predict_error(saved, folder / "duty.h5").predicted;
    MeanModel live(saved);
    EXPECT_TRUE(live.runs_a_twin());
    for (auto const& input : live.inputs()) EXPECT_EQ(input.required, !input.sensor || method.ends_with("linear"));
    EXPECT_EQ((live.inputs().end() - 2)->name, "T10");
    for (Eigen::Index row = 0; row < duty.time_s.size(); ++row)
      EXPECT_NEAR(live.error(duty.time_s[row], values_of(duty, row, live)), predicted(row, 0), 1e-6) << method;
  }
}

/// A sensor that fails costs it a correction, as the twin that `compensate --observer` runs.
TEST(MeanModel, ObservesWithoutASensor) {
  auto const duty = other_machine("duty_003");
  SavedErrorModel saved;
  saved.error = "E_X";
  saved.twin = twin_beside(machine_file("g200"));
  saved.parts = {observing_part({"T2", "T10"}, {})};
  MeanModel live(saved);
  TwinObserver observer(Machine::read(machine_file("g200")), "E_X", {}, saved.inputs());
  for (Eigen::Index row = 0; row < duty.time_s.size(); ++row) {
    auto values = values_of(duty, row, live);
    if (row > 40) values.back() = std::nan("");
    double const error = live.error(duty.time_s[row], values);
    ASSERT_TRUE(std::isfinite(error));
    ASSERT_EQ(error, observer.error(duty.time_s[row], values));
  }
}

/// A twin beside which a model reads, and one that is corrected.
TEST(MeanModel, NamesTheSensorThatTheTwinLacks) {
  SavedErrorModel saved;
  saved.error = "E_X";
  saved.twin = twin_beside(machine_file("g200"));
  models::ErrorModel const model{"linear", {"T99"}, 0, 2, models::LinearForm{0, {0}, Eigen::MatrixXd::Ones(1, 1)}, ""};
  for (auto const& part : {ModelPart{model, true, {}}, observing_part({"T99"}, {})}) {
    saved.parts = {part};
    EXPECT_THAT(thermotwin::tests::refusal([&] { MeanModel const live(saved); }),
                HasSubstr("the twin has no sensor 'T99' on a body; did you mean 'T"));
  }
}

}  // namespace
}  // namespace thermotwin::twin
