#include "output/field_modes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace thermotwin::output {
namespace {

constexpr Eigen::Index most_snapshots = 400;

Eigen::MatrixXd snapshots_of(Eigen::MatrixXf const& rise) {
  Eigen::Index const count = std::min(rise.rows(), most_snapshots);
  Eigen::MatrixXd snapshots(count, rise.cols());
  for (Eigen::Index i = 0; i < count; ++i)
    snapshots.row(i) = rise.row((i + 1) * rise.rows() / count - 1).cast<double>();
  return snapshots;
}

/// Orthonormal shapes of the snapshots, strongest first; those that are nothing but rounding are left out.
Eigen::MatrixXd shapes_of(Eigen::MatrixXd const& snapshots, int most) {
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> const solver(snapshots * snapshots.transpose());
  auto const& strengths = solver.eigenvalues();  // ascending
  Eigen::Index const n = strengths.size();
  double const least = 1e-13 * strengths[n - 1];
  Eigen::Index count = 0;
  while (count < std::min<Eigen::Index>(n, most) && strengths[n - 1 - count] > least) ++count;
  Eigen::MatrixXd shapes(snapshots.cols(), count);
  for (Eigen::Index k = 0; k < count; ++k)
    shapes.col(k) = snapshots.transpose() * solver.eigenvectors().col(n - 1 - k) / std::sqrt(strengths[n - 1 - k]);
  return shapes;
}

}  // namespace

FieldModes field_modes(Eigen::MatrixXf const& rows_by_node, double tolerance, int most) {
  FieldModes modes;
  modes.start = rows_by_node.row(0).cast<double>();
  Eigen::MatrixXf rest = rows_by_node.rowwise() - rows_by_node.row(0);
  Eigen::MatrixXd const shapes = shapes_of(snapshots_of(rest), most);
  Eigen::MatrixXd courses(rest.rows(), shapes.cols());
  modes.largest_error = rest.cwiseAbs().maxCoeff();
  Eigen::Index used = 0;
  for (; used < shapes.cols() && modes.largest_error > tolerance; ++used) {
    Eigen::VectorXf const shape = shapes.col(used).cast<float>();
    Eigen::VectorXf const course = rest * shape;
    rest.noalias() -= course * shape.transpose();
    courses.col(used) = course.cast<double>();
    modes.largest_error = rest.cwiseAbs().maxCoeff();
  }
  modes.shapes = shapes.leftCols(used);
  modes.courses = courses.leftCols(used);
  return modes;
}

}  // namespace thermotwin::output
