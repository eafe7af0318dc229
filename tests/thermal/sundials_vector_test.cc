#include "thermal/sundials_vector.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace thermotwin::thermal {
namespace {

/// Short vectors are gone over at once, long ones late; both must be what Eigen makes of the same.
class VectorOfCvodes : public testing::TestWithParam<std::ptrdiff_t> {
 protected:
  VectorOfCvodes() {
    SUNContext_Create(nullptr, &context_);
    vectors_.push_back(make_vector(GetParam(), context_));
    while (vectors_.size() < 4) vectors_.push_back(N_VClone(vectors_[0]));
    for (auto* v : vectors_) {
      expected_.emplace_back(Eigen::ArrayXd::Random(GetParam()));
      std::copy(expected_.back().begin(), expected_.back().end(), data(v));
    }
  }
  ~VectorOfCvodes() override {
    for (auto* v : vectors_) N_VDestroy(v);
    SUNContext_Free(&context_);
  }
  void expect_all() {
    for (std::size_t k = 0; k < vectors_.size(); ++k)
      EXPECT_TRUE(expected_[k].isApprox(Eigen::Map<Eigen::ArrayXd const>(data(vectors_[k]), GetParam()), 1e-14)) << k;
  }

  SUNContext context_ = nullptr;
  std::vector<N_Vector> vectors_;
  std::vector<Eigen::ArrayXd> expected_;
};

TEST_P(VectorOfCvodes, AddsUpInTheOrderInWhichItWasAsked) {
  auto& v = vectors_;
  auto& x = expected_;
  N_VLinearSum(1.0, v[0], 1.0, v[1], v[0]);  // each reads what the one before wrote, as a prediction does
  x[0] += x[1];
  N_VLinearSum(2.0, v[1], -3.0, v[0], v[2]);
  x[2] = 2.0 * x[1] - 3.0 * x[0];
  N_VScale(0.5, v[2], v[1]);
  x[1] = 0.5 * x[2];
  N_VConst(7.0, v[2]);  // after it was read
  x[2] = 7.0;
  expect_all();
}

TEST_P(VectorOfCvodes, CombinesAndAddsToMany) {
  auto& v = vectors_;
  auto& x = expected_;
  std::array factors{0.3, -2.0, 5.0};
  std::array from{v[0], v[1], v[2]};
  N_VLinearCombination(3, factors.data(), from.data(), v[0]);
  x[0] = 0.3 * x[0] - 2.0 * x[1] + 5.0 * x[2];
  std::array to{v[1], v[2]};
  N_VScaleAddMulti(2, factors.data(), v[3], to.data(), to.data());
  x[1] += 0.3 * x[3];
  x[2] -= 2.0 * x[3];
  factors.fill(0.0);  // these were the caller's
  expect_all();
}

TEST_P(VectorOfCvodes, NormIsThatOfWhatWasAskedFor) {
  N_VLinearSum(3.0, vectors_[0], 1.0, vectors_[1], vectors_[2]);
  Eigen::ArrayXd const sum = 3.0 * expected_[0] + expected_[1];
  EXPECT_NEAR(N_VWrmsNorm(vectors_[2], vectors_[3]), std::sqrt((sum * expected_[3]).square().mean()), 1e-13);
  expected_[2] = sum;
  expect_all();
}

TEST_P(VectorOfCvodes, MayGoWithWorkLeft) {
  N_Vector gone = N_VClone(vectors_[0]);
  N_VScale(2.0, vectors_[0], gone);
  N_VLinearSum(1.0, gone, 1.0, vectors_[1], vectors_[1]);
  N_VDestroy(gone);
  expected_[1] += 2.0 * expected_[0];
  expect_all();
}

/// One block and a part of one; the shortest long one; many blocks.
INSTANTIATE_TEST_SUITE_P(ShortAndLong, VectorOfCvodes, testing::Values(7, 4097, 65536, 200'005));

}  // namespace
}  // namespace thermotwin::thermal
