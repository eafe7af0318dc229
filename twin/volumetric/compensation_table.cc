#include "twin/volumetric/compensation_table.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "twin/instruments/sampling.h"

namespace thermotwin::twin {

CompensationTable compensation_table(NineFunctions const& predicted, VolumeGrid const& grid, double resolution) {
  CompensationTable table{grid, -sample([&](auto const& q) { return predicted.error(q); }, grid.positions()).errors};
  table.corrections = table.corrections.unaryExpr([&](double c) { return quantised(c, resolution); });
  return table;
}

Eigen::Vector3d CompensationTable::at(Eigen::Vector3d const& q) const {
  Eigen::Array3i below;
  Eigen::Array3d rest;
  for (int axis = 0; axis < 3; ++axis) {
    int const cells = grid.points[std::size_t(axis)] - 1;
    double const share =
        std::clamp((q[axis] - grid.workspace.from[axis]) / grid.workspace.travel()[axis], 0.0, 1.0) * cells;
    below[axis] = std::min(int(share), cells - 1);
    rest[axis] = share - below[axis];
  }
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int corner = 0; corner < 8; ++corner) {
    Eigen::Array3i const step(corner & 1, corner >> 1 & 1, corner >> 2 & 1), at = below + step;
    double const weight = (step == 1).select(rest, 1.0 - rest).prod();
    sum += weight * corrections.col((at[2] * grid.points[1] + at[1]) * grid.points[0] + at[0]);
  }
  return sum;
}

PoseFunction compensated(PoseFunction pose, CompensationTable table) {
  return [pose = std::move(pose), table = std::move(table)](Eigen::Vector3d const& q) { return pose(q + table.at(q)); };
}

std::string grid_csv(CompensationTable const& table) {
  std::string text = "x_mm,y_mm,z_mm,dx_um,dy_um,dz_um\n";
  Eigen::Matrix3Xd const positions = 1e3 * table.grid.positions(), corrections = 1e6 * table.corrections;
  for (Eigen::Index i = 0; i < positions.cols(); ++i)
    text += fmt::format("{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", positions(0, i), positions(1, i),
                        positions(2, i), corrections(0, i), corrections(1, i), corrections(2, i));
  return text;
}

std::string cross_error_tables(NineFunctions const& predicted, VolumeGrid const& grid, double resolution) {
  std::string text = "%_N_NC_CEC_INI\nCHANDATA(1)\n";
  int number = 0;
  for (int input = 0; input < 3; ++input)
    for (int output = 0; output < 3; ++output, ++number) {
      int const points = grid.points[std::size_t(input)];
      double const from = 1e3 * predicted.workspace.from[input], to = 1e3 * predicted.workspace.to[input];
      for (int j = 0; j < points; ++j) {
        double const q = predicted.workspace.from[input] + predicted.workspace.travel()[input] * j / (points - 1);
        double const change =
            predicted.at(input, q)[output] - predicted.at(input, predicted.workspace.from[input])[output];
        text += fmt::format("$AN_CEC[{},{}]={:.6f}\n", number, j, 0.0 - 1e3 * quantised(change, resolution));
      }
      text += fmt::format(
          "$AN_CEC_INPUT_AXIS[{0}]=(AX{1})\n$AN_CEC_OUTPUT_AXIS[{0}]=(AX{2})\n$AN_CEC_STEP[{0}]={3:.6g}\n"
          "$AN_CEC_MIN[{0}]={4:.6g}\n$AN_CEC_MAX[{0}]={5:.6g}\n$AN_CEC_DIRECTION[{0}]=0\n"
          "$AN_CEC_MULT_BY_TABLE[{0}]=0\n$AN_CEC_IS_MODULO[{0}]=0\n",
          number, input + 1, output + 1, (to - from) / (points - 1), from, to);
    }
  return text + "M17\n";
}

}  // namespace thermotwin::twin
