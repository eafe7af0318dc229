#include "twin/command_line_place.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <memory>

#include "output/atomic_file.h"
#include "output/node_fields.h"
#include "output/picture.h"
#include "scenarios/course.h"
#include "thermal/course_inputs.h"
#include "thermal/units.h"
#include "twin/command_line_number.h"
#include "twin/experiment_file.h"
#include "twin/file/output_path.h"
#include "twin/file_kind.h"
#include "twin/history.h"
#include "twin/machine.h"
#include "twin/placement/sensor_placement.h"
#include "twin/progress.h"
#include "twin/report/report_files.h"

namespace thermotwin::twin {
namespace {

struct PlaceCommand {
  std::string machine, candidates, noise = "0.1 K", output, fields, picture, folder;
  std::vector<std::string> experiments, unseen, proposed;
  PlacementOptions options;
  bool trained = false, json = false;

  CLI::App* add_to(CLI::App& app, std::atomic<bool> const& stop);
  void operator()();

 private:
  void check_spectra() const;
  void check_outputs() const;
  void write_map(PlacementReport const& report, Machine const& built) const;
  void write_page(PlacementReport const& report) const;
};

CLI::App* PlaceCommand::add_to(CLI::App& app, std::atomic<bool> const& stop) {
  auto* command =
      app.add_subcommand("place", "choose where temperature sensors tell most about the tool's displacement");
  command->add_option("machine", machine, "machine file or name")->required();
  command->add_option("--sensors,-k", options.sensors, "how many")->required();
  command->add_option("--candidates", candidates, "file of sites, costs, forbidden bodies and budget");
  command->add_option("--experiments", experiments, "spectra that decide; default: drawn at random");
  command->add_option("--hold-out", unseen, "spectra to judge by; default: drawn at random");
  command->add_option("--propose", proposed, "a set to judge: sites, sensors of the machine, places; T1,T2,motor");
  command->add_option("--dead", options.dead, "choose such that the loss of any so many hurts least")
      ->capture_default_str();
  command->add_flag("--trained", trained,
                    "the model that makes the error of the readings will be trained on the finished machine");
  command->add_flag("--distinguish", options.distinguish,
                    "choose such that effects which the machine may lack are told apart, not for the smallest error");
  command->add_option("--noise", noise, "standard deviation of a sensor's own error")->capture_default_str();
  command->add_option("--members", options.design.members, "machines to draw within the file's uncertainty")
      ->capture_default_str();
  command->add_option("--unseen", options.unseen_members, "machines to judge by")->capture_default_str();
  command->add_option("--seed", options.design.seed, "the same seed draws the same machines")->capture_default_str();
  command->add_option("--output,-o", output, "file to write: the recommended sensors as tables of a machine file");
  command->add_option("--fields", fields, "folder for the map of how informative places are (VTK)");
  command->add_option("--picture", picture, "PNG of that map; needs a display, or xvfb-run");
  command->add_option("--report", folder, "folder for a page to look at (report.html) and placement.json");
  command->add_flag("--json", json, "print everything as JSON");
  options.design.stop = &stop;
  return command;
}

/// At the commas outside of brackets: "T1,column.x_max[20 mm, 30 mm]". Nothing is proposed by nothing.
std::vector<std::string> split(std::vector<std::string> const& texts) {
  std::vector<std::string> parts;
  for (auto const& text : texts) {
    int depth = 0;
    parts.emplace_back();
    for (char const c : text) {
      depth += c == '[' ? 1 : c == ']' ? -1 : 0;
      if (c == ',' && depth == 0)
        parts.emplace_back();
      else if (c != ' ' || !parts.back().empty())
        parts.back() += c;
    }
    if (std::find(parts.begin(), parts.end(), "") != parts.end())
      throw thermal::InputError(fmt::format("--propose '{}': names with commas between them are due", text));
  }
  return parts;
}

/// Those that the machine can be put through; a complaint says which it is.
std::vector<scenarios::Experiment> read_all(std::vector<std::string> const& names, Machine const& machine) {
  std::vector<scenarios::Experiment> experiments;
  for (auto const& name : names) {
    auto const path = experiment_file(name);
    Value const document = read_toml(path);
    experiments.push_back(read_experiment(document, path));
    try {
      check_laser(machine, experiments.back());
      scenarios::ExperimentCourse const course(experiments.back(), machine.limits);
      thermal::CourseInputs const inputs(machine.network(), course);
    } catch (thermal::InputError const& error) {
      throw thermal::InputError(fmt::format("'{}': {}", name, located_in(document, error).what()));
    }
  }
  return experiments;
}

void refuse_repeated(char const* option, std::vector<std::string> const& names) {
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (experiment_file(names[i]) == experiment_file(names[k]))
        throw thermal::InputError(fmt::format("{}: '{}' is given twice", option, names[i]));
}

void PlaceCommand::check_spectra() const {
  refuse_repeated("--experiments", experiments);
  refuse_repeated("--hold-out", unseen);
  for (auto const& name : unseen)
    for (auto const& decides : experiments)
      if (experiment_file(name) == experiment_file(decides))
        throw thermal::InputError(
            fmt::format("'{}' decides (--experiments), and cannot judge (--hold-out) as well", name));
}

void PlaceCommand::check_outputs() const {
  check_suffix(output, "a list of sensors", {".toml"});
  std::vector<std::filesystem::path> read = {candidates};
  for (auto const* names : {&experiments, &unseen})
    for (auto const& name : *names) read.push_back(experiment_file(name));
  refuse_to_overwrite(output, machine_file(machine), read);
  refuse_to_replace(output, FileKind::sensors);
  refuse_to_overwrite(picture, machine_file(machine), read, fields);  // written after them
  check_picture(picture);
}

void PlaceCommand::write_map(PlacementReport const& report, Machine const& built) const {
  if (!fields.empty()) {
    output::make_directory(fields);
    output::write_node_fields(
        std::filesystem::path(fields) / "placement.vtu", built.geometry,
        {{"error_removed_alone_um", report.map->alone_um},
         {"error_removed_beside_recommended_um", report.map->beside_um}},
        {{"machine", built.name}, {"sensors", std::to_string(report.recommended.sensors.size())}});
  }
  if (picture.empty()) return;
  output::Frame frame;
  frame.temperature_degC = report.map->alone_um.array().isNaN().select(0.0, report.map->alone_um);
  output::PictureOptions page;
  page.title = built.title;
  page.remark = fmt::format(
      "what one sensor there takes off an error of {:.1f} µm, 0 where none may sit; dots: the {} recommended",
      report.prior_um, report.recommended.sensors.size());
  page.quantity = "error removed [µm]";
  page.up = built.up;
  int number = 0;
  for (auto const& sensor : report.recommended.sensors) {
    ++number;
    if (sensor.site.at != std::vector<std::string>{"ambient"})
      page.sensors.push_back({std::to_string(number), sensor.position});
  }
  output::render_picture(built.geometry, frame, picture, page);
}

void PlaceCommand::operator()() {
  check_spectra();
  check_outputs();
  Value const document = read_toml(machine_file(machine));
  Machine const built = Machine::build(document);
  options.noise = option_quantity("--noise", noise, thermal::dimension::temperature_difference);
  options.proposed = split(proposed);
  if (trained) options.teacher = Teacher::machine;
  options.design.experiments = read_all(experiments, built);
  options.unseen = read_all(unseen, built);
  options.map = !fields.empty() || !picture.empty() || !folder.empty();
  for (auto const& target : {folder, fields})
    if (!target.empty()) output::require_empty(target);
  if (!candidates.empty()) options.rules = read_candidate_rules(candidates);
  std::optional<Progress> progress;
  if (!json) {
    progress.emplace(fmt::format("ensemble of {}", built.name));
    options.design.progress = [&](double share) { progress->show(share); };
  }
  auto const report = place_sensors(document, options);
  progress.reset();
  fmt::print("{}", json ? placement_json(report) : placement_text(report));
  if (!output.empty()) output::write_atomically(output, sensor_tables(report));
  if (report.map) write_map(report, built);
  if (!folder.empty()) write_page(report);
}

void PlaceCommand::write_page(PlacementReport const& report) const {
  std::filesystem::path const target = folder;
  output::make_directory(target);
  output::write_atomically(target / "placement.json", placement_json(report));
  static_cast<void>(write_report({{target / "placement.json"}, machine_file(machine), target / "report.html"}));
}

}  // namespace

void add_place_command(CLI::App& app, std::atomic<bool> const& stop) {
  auto command = std::make_shared<PlaceCommand>();
  command->add_to(app, stop)->callback([command] { (*command)(); });
}

}  // namespace thermotwin::twin
