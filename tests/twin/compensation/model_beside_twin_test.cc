#include "twin/compensation/model_beside_twin.h"

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

TEST(ModelBesideTwin, TellsLiveWhatThePredictionOfTheRunTells) {
  thermotwin::tests::TemporaryDirectory const folder;
  output::write(other_machine("duty_003_other"), folder / "train.h5");
  auto const duty = other_machine("duty_003");
  output::write(duty, folder / "duty.h5");
  ErrorModelFit fit{{folder / "train.h5"}, "E_X", {"T2", "T10"}};
  fit.twin = machine_file("g200");
  std::vector<std::string> remarks;
  auto const saved = fit_error_model(fit, remarks);
  auto const predicted = predict_error(saved, folder / "duty.h5");

  ModelBesideTwin live(twin_of(*saved.twin), saved.error, SavedModel(saved.model, saved.ranges));
  auto channels = duty.inputs;
  channels.insert(channels.end(), duty.readings.begin(), duty.readings.end());
  for (Eigen::Index row = 0; row < duty.time_s.size(); ++row) {
    std::vector<double> values;
    for (auto const& input : live.inputs())
      values.push_back(std::find_if(channels.begin(), channels.end(), [&](auto const& c) {
                         return c.name == input.name;
                       })->values[row]);
    EXPECT_NEAR(live.error(duty.time_s[row], values), predicted.predicted(row, 0), 0.1) << duty.time_s[row];
  }
}

TEST(ModelBesideTwin, NamesTheSensorThatTheTwinLacks) {
  models::ErrorModel const model{"linear", {"T99"}, 0, 2, models::LinearForm{0, {0}, Eigen::MatrixXd::Ones(1, 1)}, ""};
  EXPECT_THAT(thermotwin::tests::refusal(
                  [&] { ModelBesideTwin const live(Machine::read(machine_file("g200")), "E_X", SavedModel(model)); }),
              HasSubstr("the twin has no sensor 'T99' on a body; did you mean 'T"));
}

}  // namespace
}  // namespace thermotwin::twin
