#include "twin/compensation/mean_model.h"

#include <algorithm>
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
output::Dataset other_machine(std::string const& experiment) {
  return tests::simulated(experiment, 60.0,
                          {{"bearing.front.grease_factor", "0.55"}, {"heat.coolant_pump.power", "600 W"}});
}

/// Of what the twin errs by alone, and of its mean with the twin and a regression on the readings themselves.
TEST(MeanModel, TellsLiveWhatThePredictionOfTheRunTells) {
  thermotwin::tests::TemporaryDirectory const folder;
  output::write(other_machine("duty_003_other"), folder / "train.h5");
  auto const duty = other_machine("duty_003");
  output::write(duty, folder / "duty.h5");
  ErrorModelFit fit{{folder / "train.h5"}, "E_X", {"T2", "T10"}};
  fit.twin = machine_file("g200");
  auto channels = duty.inputs;
  channels.insert(channels.end(), duty.readings.begin(), duty.readings.end());
  for (auto const* method : {"linear", "twin", "twin & linear & twin ridge"}) {
    fit.method = method;
    std::vector<std::string> remarks;
    auto const saved = fit_error_model(fit, remarks);
    auto const predicted = predict_error(saved, folder / "duty.h5");
    MeanModel live(saved);
    for (Eigen::Index row = 0; row < duty.time_s.size(); ++row) {
      std::vector<double> values;
      for (auto const& input : live.inputs())
        values.push_back(std::find_if(channels.begin(), channels.end(), [&](auto const& c) {
                           return c.name == input.name;
                         })->values[row]);
      EXPECT_NEAR(live.error(duty.time_s[row], values), predicted.predicted(row, 0), 0.1)
          << method << " at " << duty.time_s[row];
    }
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

TEST(MeanModel, NamesTheSensorThatTheTwinLacks) {
  models::ErrorModel const model{"linear", {"T99"}, 0, 2, models::LinearForm{0, {0}, Eigen::MatrixXd::Ones(1, 1)}, ""};
  EXPECT_THAT(
      thermotwin::tests::refusal([&] {
        MeanModel const live(TwinObserver(Machine::read(machine_file("g200")), "E_X"), {{SavedModel(model), true}});
      }),
      HasSubstr("the twin has no sensor 'T99' on a body; did you mean 'T"));
}

}  // namespace
}  // namespace thermotwin::twin
