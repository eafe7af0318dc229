#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <vector>

#include "tests/twin/volumetric/example_machine.h"
#include "thermal/error.h"
#include "twin/volumetric/compensation_table.h"
#include "twin/volumetric/field_prediction.h"
#include "twin/volumetric/identification.h"
#include "twin/volumetric/verification.h"
#include "twin/volumetric/volumetric_study.h"

/// Prediction, compensation and verification. (methods.md §5.6, rows C3 and D5)
namespace thermotwin::twin {
namespace {

using testing::HasSubstr;
using tests::mill;
using tests::perfect_laser;
using tests::perfect_setup;
using tests::pose_of;

/// The paper's mill as drawn by a seed: laser noise 0.2 µm, mirrors and beams out by 0.1 mrad.
VolumetricMachine drawn_mill(std::uint64_t seed) {
  VolumetricMachine machine;
  machine.workspace = mill();
  machine.cold = draw_errors(mill(), {}, seed);
  machine.laser.noise = 0.2e-6;
  machine.description.measurement.passes = 3;
  return machine;
}

TEST(CompensationTable, CorrectsItsPointsAndIsTrilinearBetween) {
  auto const functions = nine_functions_of(pose_of(draw_errors(mill(), {.angular = 0.0}, 3)), mill(), 10);
  VolumeGrid const grid{mill(), {11, 11, 11}};
  auto const table = compensation_table(functions, grid, 0.0);
  auto const positions = grid.positions();
  for (Eigen::Index i = 0; i < positions.cols(); i += 97)
    EXPECT_LT((table.at(positions.col(i)) + functions.error(positions.col(i))).norm(), 1e-15);
  Eigen::Vector3d const between(0.0331, 0.1777, 0.0444);
  EXPECT_LT((table.at(between) + functions.error(between)).norm(), 1e-15) << "a sum of functions of one coordinate";
  EXPECT_EQ(table.at({-1.0, 0.1, 0.5}), table.at({0.0, 0.1, 0.12})) << "held beyond the ends";
}

TEST(CompensationTable, IsRoundedToTheController) {
  auto const functions = nine_functions_of(pose_of(draw_errors(mill(), {}, 3)), mill(), 10);
  auto const table = compensation_table(functions, {mill(), {5, 5, 5}}, 1e-6);
  for (double const c : table.corrections.reshaped()) EXPECT_NEAR(std::remainder(c, 1e-6), 0.0, 1e-12);
}

TEST(CompensationTable, CrossErrorTablesAddUpToTheGrid) {
  auto const functions = nine_functions_of(pose_of(draw_errors(mill(), {.angular = 0.0}, 3)), mill(), 10);
  auto const text = cross_error_tables(functions, {mill(), {11, 11, 11}}, 0.1e-6);
  for (std::string const line : {"$AN_CEC_INPUT_AXIS[5]=(AX2)", "$AN_CEC_OUTPUT_AXIS[5]=(AX3)", "$AN_CEC_STEP[8]=12",
                                 "$AN_CEC_MAX[0]=200", "$AN_CEC[0,0]=0.000000"})
    EXPECT_THAT(text, HasSubstr(line));
  auto const value = [&](int number, int point) {
    std::string const key = "$AN_CEC[" + std::to_string(number) + "," + std::to_string(point) + "]=";
    return std::stod(text.substr(text.find(key) + key.size()));
  };
  for (int output = 0; output < 3; ++output) {
    double const sum = value(output, 10) + value(3 + output, 10) + value(6 + output, 10);
    EXPECT_NEAR(1e-3 * sum, -functions.error(mill().to)[output], 0.2e-6);
  }
}

/// Without angles, noise and misalignment nothing is left but what the table's points leave between them.
TEST(Compensation, OfAKnownMachineIsWhole) {
  auto const pose = pose_of(draw_errors(mill(), {.angular = 0.0}, 4));
  auto const found = identify_plain(measure_diagonals(pose, mill(), perfect_laser(), perfect_setup(), 1)).functions;
  VolumeGrid const grid{mill(), {11, 11, 11}};
  auto const better = compensated(pose, compensation_table(found, grid, 0.0));
  auto const before = without_rigid_motion(sample(error_of(pose, mill().from), grid.positions()));
  auto const after = without_rigid_motion(sample(error_of(better, mill().from), grid.positions()));
  EXPECT_GT(before.largest(), 10e-6);
  EXPECT_LT(after.largest(), 0.02e-6) << "the table is asked at the command, the error made at the corrected one";
}

/// Row D5 and bar 1: every diagonal below 10 µm and the largest error on the grid at least 80 % less.
TEST(Compensation, OfThePapersMillPassesTheBar) {
  VolumetricOptions options;
  auto const study = study_volume(drawn_mill(1), options);
  EXPECT_EQ(study.joint.rank, 14);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_GT(study.verification.before.diagonals[k], 10e-6);
    EXPECT_LT(study.verification.after.diagonals[k], 10e-6);
  }
  EXPECT_GE(study.verification.reduction(), 0.8);
  EXPECT_FALSE(study.verification.misleading());
}

/// Not of one machine: of twenty, every diagonal below 10 µm. Angular errors, which no nine functions hold, decide how
/// much of the volume's error is left.
TEST(Compensation, OfTwentyMills) {
  VolumetricOptions options;
  options.method = "ls_svm";
  double mean = 0.0;
  int reached = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    options.seed = seed;
    auto const v = study_volume(drawn_mill(seed), options).verification;
    EXPECT_LT(v.after.largest_diagonal(), 10e-6) << seed;
    EXPECT_LT(v.after.largest, v.before.largest) << seed;
    mean += v.reduction() / 20;
    reached += v.reduction() >= 0.8;
  }
  RecordProperty("mean_reduction", std::to_string(mean));
  RecordProperty("machines_with_80_percent", reached);
  EXPECT_GT(mean, 0.8);
}

/// A good machine, and mirrors out by 0.1 mrad so that their closures nearly cancel: the plain identification makes the
/// diagonals better and the volume twice as bad, and is told so.
TEST(Verification, FlagsWhatOnlyTheDiagonalsLike) {
  VolumetricMachine machine;
  machine.workspace = mill();
  machine.cold = draw_errors(mill(), {.linear = 4e-6, .straightness = 1e-6, .angular = 0.0, .squareness = 10e-6}, 30);
  machine.laser = perfect_laser();
  machine.description.measurement = perfect_setup();
  machine.description.measurement.mirror_misalignment = 0.1e-3;
  machine.description.measurement.steps = 5;
  VolumetricOptions options;
  options.seed = 30;
  options.plain = true;
  auto const study = study_volume(machine, options);
  EXPECT_LT(study.verification.after.largest_diagonal(), study.verification.before.largest_diagonal());
  EXPECT_GT(study.verification.after.largest, 1.5 * study.verification.before.largest);
  EXPECT_TRUE(study.verification.misleading());
  EXPECT_THAT(study.remarks, testing::Contains(HasSubstr("volume worse")));
  options.plain = false;
  auto const joint = study_volume(machine, options);
  EXPECT_FALSE(joint.verification.misleading());
  EXPECT_GT(joint.verification.reduction(), 0.9);
}

TEST(Compensation, RefusesAResolutionBelowZero) {
  VolumetricOptions options;
  options.resolution = -1e-6;
  EXPECT_THAT([&] { (void)study_volume(drawn_mill(1), options); },
              testing::ThrowsMessage<thermal::InputError>(HasSubstr("the controller's resolution is -1 um")));
}

/// methods.md §5.6: three points, γ = 56.2, σ² = 0.2 on inputs from 0 to 1; here from −1 to 1, where the kernel of
/// neighbours is exp(−1/0.4).
TEST(FieldPrediction, IsTheMachineOfThePaper) {
  NineFunctions points{mill(), {}};
  for (auto& values : points.values) values = Eigen::Matrix3Xd::Zero(3, 3);
  points.values[0](0, 1) = 1.0;
  auto const predicted = prediction_method("ls_svm").predict(points, 1).functions;
  double const near = std::exp(-1.0 / 0.4), far = std::exp(-4.0 / 0.4), ridge = 1.0 + 1.0 / 56.2;
  Eigen::Matrix4d system;
  system << 0, 1, 1, 1, 1, ridge, near, far, 1, near, ridge, near, 1, far, near, ridge;
  Eigen::Vector4d const solution = system.lu().solve(Eigen::Vector4d(0, 0, 1, 0));
  Eigen::Vector4d const at_middle(1, near, 1, near);
  EXPECT_NEAR(predicted.at(0, 0.1)[0], solution.dot(at_middle), 1e-12);
}

TEST(FieldPrediction, InterpolationKeepsThePoints) {
  auto const points = nine_functions_of(pose_of(draw_errors(mill(), {}, 3)), mill(), 10);
  auto const predicted = prediction_method("interpolation").predict(points, 1).functions;
  for (int axis = 0; axis < 3; ++axis)
    for (double const q : {0.0, 0.013, 0.06, 0.1})
      EXPECT_LT((predicted.at(axis, q) - points.at(axis, q)).norm(), 1e-15);
  EXPECT_THAT([] { (void)prediction_method("ls_swm"); },
              testing::ThrowsMessage<thermal::InputError>(HasSubstr("did you mean 'ls_svm'?")));
}

/// Mean of paired differences and its 95 % interval.
struct Interval {
  double mean, half;
};

Interval paired(std::vector<double> const& a, std::vector<double> const& b) {
  Eigen::Map<Eigen::ArrayXd const> const x(a.data(), Eigen::Index(a.size())), y(b.data(), Eigen::Index(b.size()));
  Eigen::ArrayXd const difference = x - y;
  double const n = double(a.size()), mean = difference.mean();
  double const deviation = std::sqrt((difference - mean).square().sum() / (n - 1.0));
  return {mean, quantile(boost::math::students_t(n - 1.0), 0.975) * deviation / std::sqrt(n)};
}

/// Drawn mills without angular errors: per method the root mean square against the true field, one per seed [µm].
/// Seeds that no setting was chosen on.
std::map<std::string, std::vector<double>> root_mean_squares(double noise, int seeds) {
  std::map<std::string, std::vector<double>> rms;
  auto laser = perfect_laser();
  laser.noise = noise;
  auto how = perfect_setup();
  how.mirror_misalignment = 0.1e-3;
  how.linear_noise = 0.2e-6;
  for (int seed = 1001; seed <= 1000 + seeds; ++seed) {
    auto const number = std::uint64_t(seed);
    auto const pose = pose_of(draw_errors(mill(), {.angular = 0.0}, number));
    auto const measured = measure_diagonals(pose, mill(), laser, how, number);
    auto const totals = measure_linear_totals(pose, mill(), how.linear_noise, number);
    auto const found = identify_jointly(measured, totals, how.linear_noise).functions;
    for (auto const& method : prediction_methods())
      rms[std::string(method.name)].push_back(
          1e6 * score(method.predict(found, number), error_of(pose, mill().from), VolumeGrid{mill()}).rms);
  }
  return rms;
}

/// Bar 2, laser noise 0.2 and 0.5 µm, 60 seeds, 95 %: LS-SVM with γ and σ² chosen is more accurate than network and
/// interpolation at both; with the paper's γ and σ² at 0.5 µm (at 0.2 µm they smooth as much away as they average).
TEST(FieldPrediction, LsSvmIsMoreAccurateThanNetworkAndInterpolation) {
  for (double const noise : {0.2e-6, 0.5e-6}) {
    auto const rms = root_mean_squares(noise, 60);
    for (std::string const method : {"ls_svm", "ls_svm_chosen"})
      for (std::string const other : {"network", "interpolation"}) {
        auto const gain = paired(rms.at(other), rms.at(method));
        RecordProperty(fmt::format("{}_against_{}_at_{:.0f}_nm", method, other, 1e9 * noise),
                       fmt::format("{:.3f} +- {:.3f} um", gain.mean, gain.half));
        if (method == "ls_svm" && noise < 0.3e-6) continue;
        EXPECT_GT(gain.mean, gain.half) << fmt::format("{} against {} at {} m", method, other, noise);
      }
  }
}

}  // namespace
}  // namespace thermotwin::twin
