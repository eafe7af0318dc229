#include "twin/volumetric/volumetric_files.h"

#include <fmt/format.h>
#include <string>

#include "output/arrow_field.h"
#include "output/atomic_file.h"
#include "output/dataset_file.h"
#include "twin/file/output_path.h"
#include "twin/volumetric/volumetric_report.h"

namespace thermotwin::twin {
namespace {

constexpr double to_um = 1e6, to_mm = 1e3;

std::string diagonals_csv(VolumetricStudy const& study) {
  std::string text = "diagonal,stop,x_mm,y_mm,z_mm,error_um\n";
  for (std::size_t k = 0; k < 4; ++k) {
    Eigen::Matrix3Xd const stops = to_mm * diagonal_stops(int(k), study.machine.workspace, study.measured.steps);
    for (Eigen::Index i = 0; i < stops.cols(); ++i)
      text += fmt::format("{},{},{:.6g},{:.6g},{:.6g},{:.6g}\n", diagonal_names[k], i, stops(0, i), stops(1, i),
                          stops(2, i), to_um * study.measured.errors[k][i]);
  }
  return text;
}

std::string functions_csv(VolumetricStudy const& study) {
  std::string text = "axis,position_mm";
  for (char const* source : {"plain", "joint", "predicted", "true"})
    for (char const component : {'x', 'y', 'z'}) text += fmt::format(",e{}_{}_um", component, source);
  text += "\n";
  for (int axis = 0; axis < 3; ++axis)
    for (int j = 0; j <= study.measured.steps; ++j) {
      double const q = study.truth.position(axis, j);
      text += fmt::format("{},{:.6g}", "XYZ"[axis], to_mm * q);
      for (auto const* functions :
           {&study.plain.functions, &study.joint.functions, &study.chosen.functions, &study.truth}) {
        Eigen::Vector3d const e = to_um * functions->at(axis, q);
        text += fmt::format(",{:.6g},{:.6g},{:.6g}", e[0], e[1], e[2]);
      }
      text += "\n";
    }
  return text;
}

std::string closure_csv(VolumetricStudy const& study) {
  std::string text = "axis,segment,closure_um\n";
  auto const& residuals = study.plain.closure.residuals;
  for (int axis = 0; axis < 3; ++axis)
    for (Eigen::Index j = 0; j < residuals.cols(); ++j)
      text += fmt::format("{},{},{:.6g}\n", "XYZ"[axis], j + 1, to_um * residuals(axis, j));
  return text;
}

std::string field_csv(VolumetricStudy const& study) {
  std::string text = "x_mm,y_mm,z_mm,ex_before_um,ey_before_um,ez_before_um,ex_after_um,ey_after_um,ez_after_um\n";
  Eigen::Matrix3Xd const at = to_mm * study.before.positions, before = to_um * study.before.errors,
                         after = to_um * study.after.errors;
  for (Eigen::Index i = 0; i < at.cols(); ++i)
    text += fmt::format("{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", at(0, i), at(1, i),
                        at(2, i), before(0, i), before(1, i), before(2, i), after(0, i), after(1, i), after(2, i));
  return text;
}

std::string drift_csv(std::vector<Drift> const& drift) {
  std::string text =
      "time_s,moved_um,uncompensated_um,compensated_um,squareness_xy_urad,squareness_xz_urad,squareness_yz_urad,"
      "travel_x_um,travel_y_um,travel_z_um\n";
  for (auto const& d : drift)
    text += fmt::format("{:g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", d.time,
                        to_um * d.moved, to_um * d.uncompensated, to_um * d.compensated, to_um * d.squareness[0],
                        to_um * d.squareness[1], to_um * d.squareness[2], to_um * d.linear_totals[0],
                        to_um * d.linear_totals[1], to_um * d.linear_totals[2]);
  return text;
}

output::ArrowField arrows_of(VolumetricStudy const& study) {
  return {study.table.grid.points,
          study.before.positions,
          {{"error_um", to_um * study.before.errors},
           {"error_after_um", to_um * study.after.errors},
           {"correction_um", to_um * study.table.corrections}}};
}

void write_tables(VolumetricStudy const& study, VolumetricFiles const& files) {
  output::make_directory(files.output);
  auto const write = [&](char const* name, std::string const& text) {
    output::write_atomically(files.output / name, text);
  };
  write("diagonals.csv", diagonals_csv(study));
  write("functions.csv", functions_csv(study));
  write("closure.csv", closure_csv(study));
  write("field.csv", field_csv(study));
  write("compensation.csv", grid_csv(study.table));
  write("compensation.cec", cross_error_tables(study.chosen.functions, study.table.grid, files.options.resolution));
  if (!study.drift.empty()) write("drift.csv", drift_csv(study.drift));
  output::write_arrows(arrows_of(study), files.output / "field.vts");
  write("report.json", volumetric_json(study));
}

}  // namespace

VolumetricStudy volumetric_files(VolumetricFiles const& files) {
  refuse_to_overwrite(files.picture, files.machine, {files.run}, files.output);
  check_picture(files.picture);
  if (!files.output.empty()) output::require_empty(files.output);
  refuse_repeated(files.settings);
  Value document = read_toml(files.machine);
  for (auto const& setting : files.settings) set_parameter(document, setting.path, setting.value);
  auto const machine = read_volumetric(document);
  std::optional<output::Dataset> run;
  VolumetricOptions options = files.options;
  if (!files.run.empty()) options.run = &run.emplace(output::read(files.run));
  auto const study = study_volume(machine, options);
  if (!files.output.empty()) write_tables(study, files);
  if (!files.picture.empty())
    output::render_arrows(arrows_of(study), files.picture,
                          {.title = fmt::format("{}: volumetric error", files.machine.stem().string()),
                           .shown = {"error_um", "error_after_um"},
                           .captions = {"as it is", "compensated"}});
  return study;
}

}  // namespace thermotwin::twin
