#include "twin/volumetric/volumetric_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/twin/volumetric/example_machine.h"
#include "thermal/error.h"
#include "twin/instruments/random_stream.h"

/// The 21-element model against the formulas that methods.md §5.2 gives component by component.
namespace thermotwin::twin {
namespace {

using tests::mill;

constexpr double size = 20e-6;  // m or rad
Eigen::Vector3d const q(0.13, 0.07, 0.11), tool(0.03, -0.05, -0.2);
Eigen::Vector3d const lever = q + tool;

/// One element, and the direction in which it moves the tool by `size` under either convention, per unit.
struct Case {
  std::string element;
  Eigen::Vector3d relative;  ///< convention A, any chain
  Eigen::Vector3d carriage;  ///< convention B, chain XYFZ
};

void PrintTo(Case const& c, std::ostream* out) { *out << c.element; }

std::vector<Case> cases() {
  double const x = lever[0], y = lever[1], z = lever[2], xt = tool[0], yt = tool[1], zt = tool[2];
  return {
      {"EXX", {1, 0, 0}, {-1, 0, 0}},
      {"EYX", {0, 1, 0}, {0, -1, 0}},
      {"EZX", {0, 0, 1}, {0, 0, -1}},
      {"EXY", {1, 0, 0}, {-1, 0, 0}},
      {"EYY", {0, 1, 0}, {0, -1, 0}},
      {"EZY", {0, 0, 1}, {0, 0, -1}},
      {"EXZ", {1, 0, 0}, {1, 0, 0}},
      {"EYZ", {0, 1, 0}, {0, 1, 0}},
      {"EZZ", {0, 0, 1}, {0, 0, 1}},
      {"EAX", {0, -z, y}, {0, z, -y}},
      {"EBX", {z, 0, -xt}, {-z, 0, x}},
      {"ECX", {-y, xt, 0}, {y, -x, 0}},
      {"EAY", {0, -z, yt}, {0, z, -y}},
      {"EBY", {z, 0, -xt}, {-z, 0, xt}},
      {"ECY", {-yt, xt, 0}, {y, -xt, 0}},
      {"EAZ", {0, -zt, yt}, {0, -zt, yt}},
      {"EBZ", {zt, 0, -xt}, {zt, 0, -xt}},
      {"ECZ", {-yt, xt, 0}, {-yt, xt, 0}},
      {"squareness_xy", {-q[1], 0, 0}, {-q[1], 0, 0}},
      {"squareness_xz", {-q[2], 0, 0}, {-q[2], 0, 0}},
      {"squareness_yz", {0, -q[2], 0}, {0, -q[2], 0}},
  };
}

/// A machine with this one error, which grows along its axis and is `size` at q.
GeometricErrors only(std::string const& element) {
  auto errors = no_errors(mill());
  if (element.starts_with("squareness")) {
    errors.squareness[element == "squareness_xy" ? 0 : element == "squareness_xz" ? 1 : 2] = size;
    return errors;
  }
  auto const [axis, component] = element_place(element);
  double const u = q[axis] / mill().to[axis];
  errors.courses[std::size_t(axis)][std::size_t(component)].polynomial = {0.0, size / u};
  return errors;
}

class SingleElement : public testing::TestWithParam<Case> {};

TEST_P(SingleElement, MovesTheToolAsTheFormulaSays) {
  auto const& expected = GetParam();
  for (auto const chain : {KinematicChain::FXYZ, KinematicChain::XFYZ, KinematicChain::XYFZ, KinematicChain::XYZF}) {
    VolumetricModel const machine(chain, ErrorConvention::tool_relative, tool, only(expected.element));
    EXPECT_LT((machine.error(q) - size * expected.relative).norm(), 1e-18) << name_of(chain);
    EXPECT_LT((machine.exact_error(q) - size * expected.relative).norm(), 2e-10) << name_of(chain);
  }
  VolumetricModel const machine(KinematicChain::XYFZ, ErrorConvention::body_fixed, tool, only(expected.element));
  EXPECT_LT((machine.error(q) - size * expected.carriage).norm(), 1e-18);
  EXPECT_LT((machine.exact_error(q) - size * expected.carriage).norm(), 2e-10);
}

INSTANTIATE_TEST_SUITE_P(VolumetricModel, SingleElement, testing::ValuesIn(cases()),
                         [](auto const& info) { return info.param.element; });

TEST(VolumetricModel, HasTwentyOneElements) { EXPECT_EQ(element_names().size() + 3, 21U); }

/// All errors at once, each even in ±50 µrad or ±20 µm (a mill's size), levers up to 0.5 m, every chain, both
/// conventions. The product's cross terms are of size ε(εL + δ).
TEST(VolumetricModel, FirstOrderAgreesWithTheProduct) {
  Workspace const large{Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(0.28)};
  RandomStream random(1, "test");
  double largest = 0.0;
  for (int draw = 0; draw < 2000; ++draw) {
    auto errors = no_errors(large);
    for (auto& axis : errors.courses)
      for (std::size_t c = 0; c < 6; ++c) axis[c].polynomial = {random.uniform(-1.0, 1.0) * (c < 3 ? 20e-6 : 50e-6)};
    for (double& s : errors.squareness) s = random.uniform(-50e-6, 50e-6);
    Eigen::Vector3d at;
    for (double& c : at) c = random.uniform(0.0, 0.28);  // at most 0.485 m from the origin
    for (auto const chain : {KinematicChain::FXYZ, KinematicChain::XFYZ, KinematicChain::XYFZ, KinematicChain::XYZF})
      for (auto const convention : {ErrorConvention::tool_relative, ErrorConvention::body_fixed}) {
        VolumetricModel const machine(chain, convention, {0.0, 0.0, 0.0}, errors);
        largest = std::max(largest, (machine.error(at) - machine.exact_error(at)).norm());
      }
  }
  RecordProperty("largest_difference_nm", std::to_string(1e9 * largest));
  EXPECT_LT(largest, 0.01e-6);
  EXPECT_GT(largest, 0.0005e-6) << "the product has second-order terms";
}

/// ε²L: half the errors, a quarter of the difference.
TEST(VolumetricModel, DifferenceIsOfSecondOrder) {
  auto const difference = [](double scale) {
    auto errors = no_errors(mill());
    for (auto& axis : errors.courses)
      for (int c = 3; c < 6; ++c) axis[std::size_t(c)].polynomial = {scale * (c - 2)};
    VolumetricModel const machine(KinematicChain::XYFZ, ErrorConvention::body_fixed, tool, errors);
    return (machine.error(q) - machine.exact_error(q)).norm();
  };
  EXPECT_NEAR(difference(2e-4) / difference(1e-4), 4.0, 1e-3);
}

TEST(VolumetricModel, ChainMattersOnlyToCarriages) {
  auto const errors = draw_errors(mill(), {}, 3);
  auto const error = [&](KinematicChain chain, ErrorConvention convention) {
    return VolumetricModel(chain, convention, tool, errors).error(q);
  };
  EXPECT_EQ(error(KinematicChain::FXYZ, ErrorConvention::tool_relative),
            error(KinematicChain::XYZF, ErrorConvention::tool_relative));
  EXPECT_EQ(error(KinematicChain::FXYZ, ErrorConvention::tool_relative),
            error(KinematicChain::FXYZ, ErrorConvention::body_fixed));
  EXPECT_GT((error(KinematicChain::XYZF, ErrorConvention::tool_relative) -
             error(KinematicChain::XYZF, ErrorConvention::body_fixed))
                .norm(),
            1e-6);
}

TEST(VolumetricModel, NamesAreRefusedWithTheNearest) {
  EXPECT_THAT([] { (void)chain_of("XYFX"); },
              testing::ThrowsMessage<thermal::InputError>(testing::HasSubstr("did you mean 'XYFZ'?")));
  EXPECT_THAT([] { (void)element_place("EXW"); },
              testing::ThrowsMessage<thermal::InputError>(testing::HasSubstr("unknown error element 'EXW'")));
}

TEST(ErrorCourse, AddsWhatIsGiven) {
  ErrorCourse const course{0.1,
                           0.3,
                           {1.0, 2.0, 4.0},
                           {{3.0, 0.4, std::numbers::pi / 2}},
                           {{Eigen::Vector2d(0.1, 0.2), Eigen::Vector2d(10.0, 20.0)}}};
  EXPECT_NEAR(course(0.1), 1.0 + 3.0 + 10.0, 1e-12);
  EXPECT_NEAR(course(0.15), 1.0 + 0.5 + 0.25 + 3.0 * std::cos(std::numbers::pi / 4) + 15.0, 1e-12);
  EXPECT_NEAR(course(0.3), 7.0 - 3.0 + 20.0, 1e-12) << "a table is held beyond its end";
}

TEST(DrawnErrors, FixingOneLeavesTheOthers) {
  auto const one = draw_errors(mill(), {}, 5), other = draw_errors(mill(), {.linear = 30e-6}, 5);
  EXPECT_DOUBLE_EQ(other.at(0, 0.2).translation[0], 2.0 * one.at(0, 0.2).translation[0]);
  EXPECT_DOUBLE_EQ(other.at(0, 0.2).translation[1], one.at(0, 0.2).translation[1]);
  EXPECT_NE(draw_errors(mill(), {}, 6).squareness, one.squareness);
}

/// Over many machines the changes along the travel have the deviation that was asked for.
TEST(DrawnErrors, HaveTheSizeAskedFor) {
  double linear = 0.0, angular = 0.0, squareness = 0.0;
  int const n = 400;
  for (int seed = 1; seed <= n; ++seed) {
    auto const errors = draw_errors(mill(), {}, std::uint64_t(seed));
    auto course = errors.courses[0][0];
    course.harmonics.clear();
    linear += std::pow(course(0.2) - course(0.0), 2) / n;
    course = errors.courses[1][4];
    course.harmonics.clear();
    angular += std::pow(course(0.2) - course(0.0), 2) / n;
    squareness += errors.squareness.squaredNorm() / 3 / n;
  }
  EXPECT_NEAR(std::sqrt(linear), 15e-6, 1.5e-6);
  EXPECT_NEAR(std::sqrt(angular), 15e-6, 1.5e-6);
  EXPECT_NEAR(std::sqrt(squareness), 60e-6, 4e-6);
}

}  // namespace
}  // namespace thermotwin::twin
