#include "output/field_modes.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace thermotwin::output {
namespace {

/// 20 °C, and two shapes that swell and fade: the field of rank two that any basis must find.
Eigen::MatrixXf two_shapes(Eigen::Index rows, Eigen::Index nodes) {
  Eigen::MatrixXf field(rows, nodes);
  for (Eigen::Index r = 0; r < rows; ++r)
    for (Eigen::Index n = 0; n < nodes; ++n) {
      double const t = double(r) / double(rows), x = double(n) / double(nodes);
      field(r, n) = float(20.0 + 15.0 * (1.0 - std::exp(-3.0 * t)) * std::exp(-x) + 4.0 * t * t * std::sin(5.0 * x));
    }
  return field;
}

Eigen::MatrixXd rebuilt(FieldModes const& modes) {
  return (modes.courses * modes.shapes.transpose()).rowwise() + modes.start.transpose();
}

double largest_difference(FieldModes const& modes, Eigen::MatrixXf const& field) {
  return (rebuilt(modes) - field.cast<double>()).cwiseAbs().maxCoeff();
}

TEST(FieldModes, FindARankTwoFieldWithTwoShapes) {
  auto const field = two_shapes(120, 300);
  auto const modes = field_modes(field, 1e-3, 40);
  EXPECT_EQ(modes.shapes.cols(), 2);
  EXPECT_LT(largest_difference(modes, field), 1e-3);
}

TEST(FieldModes, AreOrthonormal) {
  auto const modes = field_modes(two_shapes(120, 300), 1e-3, 40);
  EXPECT_NEAR((modes.shapes.transpose() * modes.shapes - Eigen::MatrixXd::Identity(2, 2)).norm(), 0.0, 1e-6);
}

TEST(FieldModes, StartExactly) {
  auto const field = two_shapes(120, 300);
  auto const modes = field_modes(field, 1.0, 40);
  EXPECT_EQ(modes.start.cast<float>(), field.row(0).transpose());
  EXPECT_NEAR(modes.courses.row(0).norm(), 0.0, 1e-6);
}

TEST(FieldModes, TellTheirErrorWhenTheyMayNotBeMany) {
  std::mt19937 random(7);
  Eigen::MatrixXf field(60, 80);
  for (auto& value : field.reshaped()) value = float(random() % 1000) / 100.0F;
  auto const modes = field_modes(field, 1e-3, 5);
  EXPECT_EQ(modes.shapes.cols(), 5);
  EXPECT_GT(modes.largest_error, 1.0);
  EXPECT_NEAR(modes.largest_error, largest_difference(modes, field), 1e-4);
}

TEST(FieldModes, CoverRowsThatGaveNoShape) {
  auto const field = two_shapes(1500, 50);  // more than are looked at for the shapes
  auto const modes = field_modes(field, 1e-3, 40);
  EXPECT_EQ(modes.courses.rows(), 1500);
  EXPECT_LT(largest_difference(modes, field), 1e-3);
}

TEST(FieldModes, OfAFieldAtRestAreNone) {
  auto const modes = field_modes(Eigen::MatrixXf::Constant(10, 20, 21.5F), 0.01, 40);
  EXPECT_EQ(modes.shapes.cols(), 0);
  EXPECT_EQ(modes.largest_error, 0.0);
}

}  // namespace
}  // namespace thermotwin::output
