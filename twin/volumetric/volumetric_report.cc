#include "twin/volumetric/volumetric_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>

#include "output/json_text.h"

namespace thermotwin::twin {
namespace {

constexpr double in_um = 1e6;
constexpr std::array<char const*, 3> pairs = {"XY", "XZ", "YZ"};

std::string head(VolumetricStudy const& study) {
  auto const& d = study.machine.description;
  Eigen::Vector3d const travel = 1e3 * study.machine.workspace.travel();
  return fmt::format("\nvolume {:g} × {:g} × {:g} mm, chain {}, elements {}; {} steps per diagonal, noise {:.2f} µm\n",
                     travel[0], travel[1], travel[2], d.chain, d.convention, d.measurement.steps,
                     in_um * study.measured.noise);
}

std::string squareness_table(VolumetricStudy const& study) {
  std::string text = fmt::format("\n  {:<22} {:>10} {:>10} {:>10}\n", "identified", "plain", "joint", "true");
  auto const plain = squareness_of(study.plain.functions), joint = squareness_of(study.joint.functions),
             truth = squareness_of(study.truth);
  for (int i = 0; i < 3; ++i)
    text += fmt::format("  {:<22} {:>10.1f} {:>10.1f} {:>10.1f} µrad\n",
                        fmt::format("squareness {}", pairs[std::size_t(i)]), in_um * plain[i], in_um * joint[i],
                        in_um * truth[i]);
  for (int axis = 0; axis < 3; ++axis) {
    auto const total = [&](NineFunctions const& f) {
      auto const& own = f.values[std::size_t(axis)];
      return in_um * (own(axis, own.cols() - 1) - own(axis, 0));
    };
    text += fmt::format("  {:<22} {:>10.2f} {:>10.2f} {:>10.2f} µm\n", fmt::format("travel of {}", "XYZ"[axis]),
                        total(study.plain.functions), total(study.joint.functions), total(study.truth));
  }
  for (std::size_t k = 0; k < 4; ++k)
    text += fmt::format(
        "  {:<22} {:>10} {:>10.3f} {:>10.3f} mrad\n", fmt::format("mirror on {}", diagonal_names[k]), "-",
        1e3 * study.joint.misalignment[k].norm(),
        1e3 * (study.measured.mirror_normals[k] - diagonal_direction(int(k), study.machine.workspace)).norm());
  return text + fmt::format(
                    "  joint solution: rank {} of 14; closures of the plain one: rms {:.2f} µm per step, {:.2f} "
                    "by the laser's noise\n",
                    study.joint.rank, in_um * study.plain.closure.rms(), in_um * study.plain.closure.noise);
}

std::string prediction_table(VolumetricStudy const& study) {
  std::string text =
      fmt::format("\n  {:<14} {:>8} {:>8} {:>8} {:>12}\n", "prediction", "rms µm", "max µm", "MAPE %", "training ms");
  for (auto const& [prediction, score] : study.predictions)
    text += fmt::format("  {:<14} {:>8.2f} {:>8.2f} {:>8.1f} {:>12.3f}  {}{}\n", prediction.method, in_um * score.rms,
                        in_um * score.largest, score.mape, 1e3 * prediction.training_time, prediction.remark,
                        prediction.method == study.chosen.method ? "  << compensates" : "");
  return text + "  against the true field, without rigid motion; MAPE of components of at least 1 µm\n";
}

std::string verification_table(VolumetricStudy const& study) {
  auto const& [before, after] = study.verification;
  std::string text = fmt::format("\n  {:<34} {:>10} {:>10}\n", "compensation, largest error in µm", "before", "after");
  for (std::size_t k = 0; k < 4; ++k)
    text += fmt::format("  {:<34} {:>10.2f} {:>10.2f}\n", fmt::format("diagonal {}, measured", diagonal_names[k]),
                        in_um * before.diagonals[k], in_um * after.diagonals[k]);
  text += fmt::format("  {:<34} {:>10.2f} {:>10.2f}  {:.0f} % less\n", "grid of 21 × 21 × 21, true",
                      in_um * before.largest, in_um * after.largest, 100.0 * study.verification.reduction());
  return text + fmt::format("  {:<34} {:>10.2f} {:>10.2f}\n", "  rms of the grid", in_um * before.root_mean_square,
                            in_um * after.root_mean_square);
}

std::string drift_table(VolumetricStudy const& study) {
  if (study.drift.empty()) return "";
  std::string text = fmt::format("\n  {:<10} {:>9} {:>9} {:>12}  {:>23}  {:>23}\n", "drift", "moved", "machine",
                                 "compensated", "squareness XY XZ YZ µrad", "travel X Y Z µm");
  for (auto const& d : study.drift)
    text += fmt::format(
        "  {:>6.0f} min {:>9.2f} {:>9.2f} {:>12.2f}  {:>7.1f} {:>7.1f} {:>7.1f}  {:>7.2f} {:>7.2f} {:>7.2f}\n",
        d.time / 60.0, in_um * d.moved, in_um * d.uncompensated, in_um * d.compensated, in_um * d.squareness[0],
        in_um * d.squareness[1], in_um * d.squareness[2], in_um * d.linear_totals[0], in_um * d.linear_totals[1],
        in_um * d.linear_totals[2]);
  return text +
         "  largest over the grid in µm: change since the measurement; error without rigid motion, bare and with "
         "the table\n";
}

using Json = nlohmann::ordered_json;

Json numbers(Eigen::Vector3d const& v, double factor) { return {factor * v[0], factor * v[1], factor * v[2]}; }

Json state_json(VolumeState const& state) {
  Json json;
  for (std::size_t k = 0; k < 4; ++k) json["diagonals_um"][std::string(diagonal_names[k])] = in_um * state.diagonals[k];
  json["grid_largest_um"] = in_um * state.largest;
  json["grid_rms_um"] = in_um * state.root_mean_square;
  return json;
}

Json identification_json(VolumetricStudy const& study) {
  Json json = {{"squareness_plain_urad", numbers(squareness_of(study.plain.functions), in_um)},
               {"squareness_joint_urad", numbers(squareness_of(study.joint.functions), in_um)},
               {"squareness_true_urad", numbers(squareness_of(study.truth), in_um)},
               {"rank", study.joint.rank},
               {"closure_rms_um", in_um * study.plain.closure.rms()},
               {"closure_noise_um", in_um * study.plain.closure.noise}};
  for (std::size_t k = 0; k < 4; ++k)
    json["mirror_mrad"][std::string(diagonal_names[k])] = 1e3 * study.joint.misalignment[k].norm();
  return json;
}

Json component_lists(Eigen::Matrix3Xd const& vectors, double factor) {
  Json json;
  for (int i = 0; i < 3; ++i) {
    Eigen::VectorXd const row = factor * vectors.row(i).transpose();
    json[std::string(1, "xyz"[i])] = std::vector<double>(row.begin(), row.end());
  }
  return json;
}

Json field_json(VolumetricStudy const& study) {
  return {{"points", study.table.grid.points},
          {"position_mm", component_lists(study.before.positions, 1e3)},
          {"before_um", component_lists(study.before.errors, in_um)},
          {"after_um", component_lists(study.after.errors, in_um)}};
}

/// w of the rotation w × q that brings the true functions nearest to the identified ones. Diagonals do not show it: how
/// the workpiece lies is no error of the machine.
Eigen::Vector3d rotation_of_identified(VolumetricStudy const& study) {
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int axis = 0; axis < 3; ++axis)
    for (int j = 0; j <= study.measured.steps; ++j) {
      double const q = study.truth.position(axis, j);
      Eigen::Vector3d const lever = (q - study.truth.position(axis, 0)) * Eigen::Vector3d::Unit(axis);
      squares += lever.squaredNorm() * Eigen::Matrix3d::Identity() - lever * lever.transpose();
      sum += lever.cross(study.chosen.functions.at(axis, q) - study.truth.at(axis, q));
    }
  return squares.ldlt().solve(sum);
}

/// Both counted from the same workpiece: the true ones are turned to where the identified ones have it.
Json functions_json(VolumetricStudy const& study, int axis, Eigen::Vector3d const& rotation) {
  int const steps = study.measured.steps;
  std::vector<double> positions;
  Eigen::Matrix3Xd predicted(3, steps + 1), truth(3, steps + 1);
  for (int j = 0; j <= steps; ++j) {
    double const q = study.truth.position(axis, j);
    positions.push_back(1e3 * q);
    predicted.col(j) = study.chosen.functions.at(axis, q);
    truth.col(j) =
        study.truth.at(axis, q) + rotation.cross((q - study.truth.position(axis, 0)) * Eigen::Vector3d::Unit(axis));
  }
  return {{"axis", std::string(1, "XYZ"[axis])},
          {"position_mm", positions},
          {"predicted_um", component_lists(predicted, in_um)},
          {"true_um", component_lists(truth, in_um)}};
}

}  // namespace

std::string volumetric_text(VolumetricStudy const& study) {
  std::string text =
      head(study) + squareness_table(study) + prediction_table(study) + verification_table(study) + drift_table(study);
  if (!study.remarks.empty()) text += "\n";
  for (auto const& remark : study.remarks) text += fmt::format("  note: {}\n", remark);
  return text;
}

std::string volumetric_json(VolumetricStudy const& study) {
  auto const& d = study.machine.description;
  Json json = {{"chain", d.chain},
               {"convention", d.convention},
               {"travel_mm", numbers(study.machine.workspace.travel(), 1e3)},
               {"steps", d.measurement.steps},
               {"identification", identification_json(study)}};
  json["predictions"] = Json::array();
  for (auto const& [prediction, score] : study.predictions)
    json["predictions"].push_back({{"method", prediction.method},
                                   {"remark", prediction.remark},
                                   {"rms_um", in_um * score.rms},
                                   {"largest_um", in_um * score.largest},
                                   {"mape_percent", score.mape},
                                   {"training_s", prediction.training_time}});
  json["compensated_by"] = study.chosen.method;
  json["before"] = state_json(study.verification.before);
  json["after"] = state_json(study.verification.after);
  json["reduction"] = study.verification.reduction();
  json["misleading"] = study.verification.misleading();
  json["drift"] = Json::array();
  for (auto const& point : study.drift)
    json["drift"].push_back({{"time_s", point.time},
                             {"moved_um", in_um * point.moved},
                             {"uncompensated_um", in_um * point.uncompensated},
                             {"compensated_um", in_um * point.compensated},
                             {"squareness_urad", numbers(point.squareness, in_um)},
                             {"linear_totals_um", numbers(point.linear_totals, in_um)}});
  json["field"] = field_json(study);
  json["functions"] = Json::array();
  auto const rotation = rotation_of_identified(study);
  for (int axis = 0; axis < 3; ++axis) json["functions"].push_back(functions_json(study, axis, rotation));
  json["remarks"] = study.remarks;
  return output::json_text(std::move(json));
}

}  // namespace thermotwin::twin
