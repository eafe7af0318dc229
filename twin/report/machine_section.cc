#include "twin/report/machine_section.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>

#include "output/field_mesh.h"
#include "output/field_modes.h"
#include "output/surface.h"
#include "output/temporary_folder.h"
#include "thermal/error.h"
#include "thermal/growth_field.h"
#include "twin/file/value.h"
#include "twin/setting.h"

namespace thermotwin::twin {
namespace {

using output::FieldMesh;
using output::Json;
using output::ReportPage;
using output::Surface;

constexpr int most_modes = 40;
constexpr double least_tolerance = 0.01;     // K
constexpr double tolerance_of_span = 0.001;  // 1

/// A body's influence weights lie beside its file.
Machine build_beside(std::string const& text, std::string const& settings, std::filesystem::path const& folder) {
  Value document = parse_toml(text, (folder / "machine.toml").string());
  for (auto const& setting : settings_in(settings))
    if (!setting.of_experiment()) set_parameter(document, setting.path, setting.value);
  return Machine::build(document);
}

/// None when the run names no machine.
std::optional<Machine> named_machine(ShownRun const& run) {
  if (run.machine.empty()) return {};
  if (!run.machine_file.empty()) return Machine::read(run.machine_file);
  try {
    return Machine::read(machine_file(run.machine));
  } catch (thermal::InputError const&) {
    auto beside = std::filesystem::path(run.machine);
    if (beside.extension() != ".toml") beside += ".toml";
    throw thermal::InputError(
        fmt::format("{} says that it was '{}', but there is no {} beside it, and none such is shipped; name its file "
                    "with --machine",
                    run.path.filename().string(), run.machine, beside.string()));
  }
}

Json surface_json(Surface const& surface, FieldMesh const& mesh, ReportPage& page) {
  Eigen::MatrixXd points(Eigen::Index(surface.points.size()), 3);
  for (std::size_t i = 0; i < surface.points.size(); ++i)
    points.row(Eigen::Index(i)) = mesh.points().col(surface.points[i]).transpose();
  std::vector<int> triangles, edges;
  for (auto const& triangle : surface.triangles) triangles.insert(triangles.end(), triangle.begin(), triangle.end());
  for (auto const& edge : surface.edges) edges.insert(edges.end(), edge.begin(), edge.end());
  Json bodies = Json::array();
  for (std::size_t b = 0; b < surface.bodies.size(); ++b) {
    auto const& extent = surface.bodies[b];
    bodies.push_back({{"name", mesh.body_names()[b]},
                      {"first_triangle", extent.first_triangle},
                      {"triangles", extent.triangles},
                      {"first_point", extent.first_point},
                      {"points", extent.points}});
  }
  return {{"points", page.add_numbers(points)},
          {"triangles", page.add_whole_numbers(triangles)},
          {"edges", page.add_whole_numbers(edges)},
          {"bodies", bodies}};
}

int nearest_point(Surface const& surface, FieldMesh const& mesh, Eigen::Vector3d const& place) {
  int nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < surface.points.size(); ++i)
    if (double const d = (mesh.points().col(surface.points[i]) - place).squaredNorm(); d < least) {
      least = d;
      nearest = int(i);
    }
  return nearest;
}

Json sensors_json(Machine const& machine, Surface const& surface, FieldMesh const& mesh) {
  Json sensors = Json::array();
  for (auto const& sensor : machine.sensors) {
    if (sensor.weights.empty()) continue;  // it hangs in the air
    auto const& at = sensor.position;
    sensors.push_back({{"name", sensor.description.name},
                       {"title", sensor.description.title},
                       {"position", {at.x(), at.y(), at.z()}},
                       {"point", nearest_point(surface, mesh, at)}});
  }
  return sensors;
}

Eigen::MatrixXd at_surface(Surface const& surface, Eigen::MatrixXd const& at_points) {
  Eigen::MatrixXd values(Eigen::Index(surface.points.size()), at_points.cols());
  for (std::size_t i = 0; i < surface.points.size(); ++i)
    values.row(Eigen::Index(i)) = at_points.row(surface.points[i]);
  return values;
}

/// Mean (by volume), lowest and highest of each body, row × body.
Json body_courses_json(thermal::Geometry const& geometry, FieldMesh const& mesh, Eigen::MatrixXf const& temperatures,
                       ReportPage& page) {
  Eigen::Index const rows = temperatures.rows(), bodies = Eigen::Index(geometry.size());
  Eigen::MatrixXd mean(rows, bodies), lowest(rows, bodies), highest(rows, bodies);
  for (Eigen::Index b = 0; b < bodies; ++b) {
    auto const& body = geometry[std::size_t(b)];
    auto const nodes = Eigen::seqN(body.first_node, Eigen::Index(body.cells.size()));
    Eigen::VectorXd const volumes = mesh.node_volumes()(nodes);
    for (Eigen::Index r = 0; r < rows; ++r) {
      Eigen::VectorXd const values = temperatures.row(r)(nodes).cast<double>();
      mean(r, b) = values.dot(volumes) / volumes.sum();
      lowest(r, b) = values.minCoeff();
      highest(r, b) = values.maxCoeff();
    }
  }
  return {
      {"mean", page.add_numbers(mean)}, {"lowest", page.add_numbers(lowest)}, {"highest", page.add_numbers(highest)}};
}

Json field_json(Machine const& machine, FieldMesh const& mesh, Surface const& surface,
                Eigen::MatrixXf const& temperatures, ReportPage& page) {
  Eigen::MatrixXf const placed = temperatures.leftCols(mesh.n_nodes());
  double const lowest = placed.minCoeff(), highest = placed.maxCoeff();
  auto const modes =
      output::field_modes(placed, std::max(least_tolerance, tolerance_of_span * (highest - lowest)), most_modes);
  Eigen::Index const points = Eigen::Index(surface.points.size()), count = modes.shapes.cols();
  Eigen::MatrixXd shapes(points, count), displacements(3 * points, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    Eigen::VectorXd rise = Eigen::VectorXd::Zero(machine.network().nodes());
    rise.head(mesh.n_nodes()) = modes.shapes.col(k);
    shapes.col(k) = at_surface(surface, mesh.mean_at_points(modes.shapes.col(k)));
    Eigen::Matrix3Xd const grown =
        mesh.continued_to_points(thermal::growth_field(machine.growing, {rise.data(), std::size_t(rise.size())}));
    Eigen::MatrixXd const moved = at_surface(surface, grown.transpose());
    displacements.col(k) = moved.transpose().reshaped();
  }
  return {{"start", page.add_numbers(at_surface(surface, mesh.mean_at_points(modes.start)))},
          {"courses", page.add_numbers(modes.courses)},
          {"temperature", page.add_quantised(shapes)},
          {"displacement", page.add_quantised(displacements)},
          {"lowest", lowest},
          {"highest", highest},
          {"largest_error", modes.largest_error},
          {"nodes", mesh.n_nodes()},
          {"bodies", body_courses_json(machine.geometry, mesh, placed, page)}};
}

Json shape_json(Machine const& machine, FieldMesh const& mesh, Surface const& surface, ReportPage& page) {
  Json json = surface_json(surface, mesh, page);
  json["title"] = machine.title;
  json["up"] = {machine.up.x(), machine.up.y(), machine.up.z()};
  return json;
}

}  // namespace

std::optional<Machine> machine_of(ShownRun const& run) {
  auto const& provenance = run.data.provenance;
  auto const text = provenance.find("machine.file");
  if (text == provenance.end()) return named_machine(run);
  auto const settings = provenance.find("settings");
  std::string const set = settings == provenance.end() ? "" : settings->second;
  if (auto const weights = provenance.find("machine.weights"); weights != provenance.end()) {
    output::TemporaryFolder const folder;
    folder.put("machine.weights", weights->second);
    return build_beside(text->second, set, folder.path());
  }
  try {  // of a machine that comes with the program, or beside the data set
    return build_beside(text->second, set, machine_file("v450").parent_path());
  } catch (thermal::InputError const&) {
    return build_beside(text->second, set, run.path.parent_path());
  }
}

Json machine_json(Machine const& machine, output::Dataset const& data, ReportPage& page) {
  FieldMesh const mesh(machine.geometry);
  if (mesh.elements().empty()) return nullptr;
  auto const surface = output::surface_of(mesh);
  Json json = shape_json(machine, mesh, surface, page);
  json["sensors"] = sensors_json(machine, surface, mesh);
  if (data.node_temperatures && data.node_temperatures->cols() == machine.network().nodes() &&
      data.node_temperatures->rows() > 0)
    json["field"] = field_json(machine, mesh, surface, *data.node_temperatures, page);
  return json;
}

Json painted_machine_json(Machine const& machine, Eigen::VectorXd const& first, Eigen::VectorXd const& second,
                          std::vector<MarkedPlace> const& marks, ReportPage& page) {
  FieldMesh const mesh(machine.geometry);
  if (mesh.elements().empty()) return nullptr;
  Eigen::Index const n = mesh.n_nodes();
  if (std::min(first.size(), second.size()) < n)
    throw thermal::InputError(fmt::format("the map has {} numbers for the {} nodes of '{}'.",
                                          std::min(first.size(), second.size()), n, machine.name));
  auto const surface = output::surface_of(mesh);
  Eigen::VectorXd const change = (second - first).head(n);
  Json json = shape_json(machine, mesh, surface, page);
  json["set"] = 0;
  json["sensors"] = Json::array();
  for (auto const& [name, title, at] : marks)
    json["sensors"].push_back({{"name", name},
                               {"title", title},
                               {"position", {at.x(), at.y(), at.z()}},
                               {"point", nearest_point(surface, mesh, at)}});
  json["field"] = {{"start", page.add_numbers(at_surface(surface, mesh.mean_at_points(first.head(n))))},
                   {"courses", page.add_numbers(Eigen::Vector2d(0.0, 1.0))},
                   {"temperature", page.add_quantised(at_surface(surface, mesh.mean_at_points(change)))},
                   {"displacement", page.add_quantised(Eigen::VectorXd::Zero(3 * Eigen::Index(surface.points.size())))},
                   {"lowest", std::min(first.head(n).minCoeff(), second.head(n).minCoeff())},
                   {"highest", std::max(first.head(n).maxCoeff(), second.head(n).maxCoeff())},
                   {"largest_error", 0.0},
                   {"nodes", n}};
  return json;
}

}  // namespace thermotwin::twin
