#include "models/error_model.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>

#include "models/training_set.h"
#include "tests/models/simulated_batch.h"

namespace thermotwin::models {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::AllOf;
using testing::HasSubstr;

class EveryMethod : public testing::TestWithParam<std::string> {
 protected:
  ErrorModel fit(Batch const& batch) { return method_.fit(std::span(&batch, 1), {}); }
  std::string complaint(std::vector<Batch> const& batches) {
    try {
      method_.fit(batches, {});
    } catch (std::invalid_argument const& error) {
      return error.what();
    }
    return "";
  }
  ModelMethod const& method_ = model_method(GetParam());
};

std::vector<std::string> names() {
  std::vector<std::string> result;
  for (auto const& method : model_methods()) result.emplace_back(method.name);
  return result;
}

INSTANTIATE_TEST_SUITE_P(Models, EveryMethod, testing::ValuesIn(names()), [](auto const& info) { return info.param; });

TEST_P(EveryMethod, ExplainsMostOfWhatItWasFittedTo) {
  auto const batch = random_walks(1, 80, 3);
  auto const model = fit(batch);
  double const spread = (batch.error.array() - batch.error.mean()).square().sum();
  EXPECT_LT((model.predict(batch) - batch.error).squaredNorm(), 0.5 * spread);
  EXPECT_EQ(model.method, GetParam());
  EXPECT_GT(model.parameters, 0);
  EXPECT_FALSE(model.remark.empty());
}

TEST_P(EveryMethod, FindsItsInputsByNameWhateverTheirOrder) {
  auto const batch = random_walks(2, 60, 3);
  auto const model = fit(batch);
  EXPECT_EQ(model.inputs, batch.sensors);
  auto more = with_sensors(batch, std::vector<Eigen::Index>{2, 0, 1});
  more.sensors.push_back("air");
  more.components.push_back("room");
  more.temperature_rise.conservativeResize(Eigen::NoChange, 4);
  more.temperature_rise.col(3).setConstant(1.0);
  EXPECT_EQ(model.predict(more), model.predict(batch));
}

TEST_P(EveryMethod, RefusesABatchWithoutItsInputs) {
  auto const batch = random_walks(3, 60, 3);
  auto const model = fit(batch);
  try {
    static_cast<void>(model.predict(with_sensors(batch, std::vector<Eigen::Index>{0, 2})));
    FAIL();
  } catch (std::invalid_argument const& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("no sensor 'T2'"), HasSubstr("T1, T3")));
  }
}

TEST_P(EveryMethod, GivesTheSameBytesTwice) {
  auto const batch = random_walks(4, 60, 2);
  EXPECT_EQ(fit(batch).predict(batch), fit(batch).predict(batch));
}

TEST_P(EveryMethod, NamesASensorThatDoesNotMove) {
  auto batch = random_walks(5, 60, 3);
  batch.temperature_rise.col(1).setConstant(0.5);
  EXPECT_THAT(complaint({batch}), HasSubstr("sensor 'T2' does not move: 0.5 K in all 60 samples"));
}

TEST_P(EveryMethod, RefusesFewerSamplesThanItNeeds) {
  EXPECT_THAT(complaint({random_walks(6, 2, 3)}),
              testing::AnyOf(HasSubstr("2 samples are too few"), HasSubstr("2 samples; lags of 2 samples need more")));
}

TEST_P(EveryMethod, RefusesBatchesWhoseSensorsDiffer) {
  auto const batch = random_walks(7, 60, 3);
  auto other = batch;
  other.name = "other";
  other.sensors[2] = "T9";
  EXPECT_THAT(complaint({batch, other}), AllOf(HasSubstr("batch 'other'"), HasSubstr("T1, T2, T9")));
}

TEST_P(EveryMethod, NamesTheSensorAndTheRowOfWhatIsNoNumber) {
  auto batch = random_walks(8, 60, 3);
  batch.temperature_rise(16, 2) = std::nan("");
  EXPECT_THAT(complaint({batch}), HasSubstr("sensor 'T3' has no number in row 17"));
  batch = random_walks(8, 60, 3);
  batch.error(4) = INFINITY;
  EXPECT_THAT(complaint({batch}), HasSubstr("the error in row 5 is no number"));
  batch = random_walks(8, 60, 3);
  batch.before = MatrixXd::Constant(2, 3, std::nan(""));
  EXPECT_THAT(complaint({batch}), HasSubstr("a reading before it is no number"));
  batch.before = MatrixXd::Zero(2, 2);
  EXPECT_THAT(complaint({batch}), HasSubstr("3 columns of temperatures, 2 of those before it"));
}

TEST_P(EveryMethod, RefusesNoBatch) { EXPECT_THAT(complaint({}), HasSubstr("no batch at all")); }

TEST_P(EveryMethod, RefusesAnotherSamplePeriodWhereLagsCount) {
  auto const batch = random_walks(9, 60, 2);
  auto const model = fit(batch);
  auto slower = batch;
  slower.time *= 2.0;
  auto const* form = std::get_if<LinearForm>(&model.form);
  if (form && form->lags.back() > 0) {
    EXPECT_EQ(model.sample_period, 60.0);
    EXPECT_THROW(static_cast<void>(model.predict(slower)), std::invalid_argument);
    EXPECT_THAT(complaint({batch, slower}), HasSubstr("every 120 s"));
    auto uneven = batch;
    uneven.time.tail(10).array() += 20.0;
    EXPECT_THAT(complaint({uneven}), HasSubstr("row 51 comes 80 s after"));
  } else {
    EXPECT_EQ(model.sample_period, 0.0);
    EXPECT_EQ(model.predict(slower), model.predict(batch));
  }
}

TEST(LinearForm, RestsBeforeTheFirstInstant) {
  ErrorModel const model{"ridge", {"T1"}, 60.0, 3.0, LinearForm{1.0, {0, 2}, Eigen::RowVector2d(10.0, 100.0)}, ""};
  auto const batch = batch_of(Eigen::Vector4d(0.5, 1, 2, 3), Eigen::Vector4d::Zero());
  EXPECT_EQ(model.predict(batch), Eigen::Vector4d(56, 61, 71, 131));
}

TEST(LinearForm, RefusesASensorThatRepeatsAnother) {
  auto batch = random_walks(10, 60, 3);
  batch.temperature_rise.col(2) = 2.0 * batch.temperature_rise.col(0);
  for (auto const* name : {"linear", "distributed_lag"})
    EXPECT_THROW(model_method(name).fit(std::span(&batch, 1), {}), std::invalid_argument) << name;
  EXPECT_NO_THROW(model_method("ridge").fit(std::span(&batch, 1), {}));
}

TEST(Catalogue, NamesAreDifferentAndStrangersAreRefused) {
  auto const all = names();
  EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), all.size());
  try {
    model_method("ridge_distributed_lug");
    FAIL();
  } catch (std::invalid_argument const& error) {
    EXPECT_THAT(error.what(), HasSubstr("did you mean 'ridge_distributed_lag'"));
  }
}

}  // namespace
}  // namespace thermotwin::models
