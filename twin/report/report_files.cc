#include "twin/report/report_files.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>

#include "output/atomic_file.h"
#include "output/report_page.h"
#include "thermal/error.h"
#include "twin/diagnosis/run_files.h"
#include "twin/file/output_path.h"
#include "twin/report/answer_section.h"
#include "twin/report/machine_section.h"
#include "twin/report/shown_run.h"
#include "twin/version.h"

namespace thermotwin::twin {
namespace {

namespace fs = std::filesystem;
using output::Json;
using output::ReportPage;

std::string title_of(ReportFiles const& files, std::vector<ShownRun> const& runs,
                     std::vector<std::string> const& answers) {
  if (runs.size() == 1 && !runs[0].data.title.empty()) return runs[0].data.title;
  return runs.empty() && answers.size() == 1 ? answers[0] : names_of(files.data);
}

/// The run that the machine's picture shows: the first with all its nodes, or else the first whose machine is known.
ShownRun const* drawn_run(std::vector<ShownRun> const& runs) {
  for (auto const& run : runs)
    if (run.data.node_temperatures && run.data.provenance.contains("machine.file")) return &run;
  for (auto const& run : runs)
    if (run.data.provenance.contains("machine.file")) return &run;
  for (auto const& run : runs)
    if (!run.machine.empty()) return &run;
  return nullptr;
}

/// The machine, when the data or the user say which; otherwise a remark why not.
std::optional<Machine> machine_to_draw(ShownRun const* drawn, fs::path const& file, std::vector<std::string>& remarks) {
  if (!file.empty()) return Machine::read(file);
  try {
    if (drawn) return machine_of(*drawn);
    remarks.emplace_back("No machine is drawn: these data do not say which it was. Name it with --machine.");
  } catch (thermal::InputError const& error) {
    remarks.push_back(fmt::format("No machine is drawn: {}", error.what()));
  }
  return {};
}

std::string field_remark(Json const& machine) {
  if (!machine.contains("field"))
    return "Only the sensors are coloured: these data hold no field. `thermotwin run --nodes` keeps it.";
  auto const& field = machine["field"];
  return fmt::format(
      "The field of {} nodes is drawn from {} shapes that change in time, to {:.2g} K at worst; every row of the data "
      "is "
      "there.",
      field["nodes"].get<int>(), field["courses"]["shape"][1].get<int>(), field["largest_error"].get<double>());
}

/// What residuals are counted from: what was measured, or else the first.
ShownRun const& reference_of(std::vector<ShownRun> const& runs) {
  auto const measured = std::find_if(runs.begin(), runs.end(), [](auto const& run) { return !run.simulated; });
  return measured == runs.end() ? runs.front() : *measured;
}

Json runs_json(std::vector<ShownRun> const& runs, fs::path const& machine_file, ReportPage& page) {
  std::vector<std::string> remarks;
  Json json = {{"sets", Json::array()}};
  auto const& reference = reference_of(runs);
  for (auto const& run : runs) {
    bool const compared = driven_alike(reference, run);
    json["sets"].push_back(run_json(run, page));
    json["sets"].back()["compared"] = compared;
    if (!compared)
      remarks.push_back(fmt::format("{} was driven otherwise than {}: there is no residual between them.",
                                    run.name.string(), reference.name.string()));
    if (run.without_instruments)
      remarks.push_back(
          fmt::format("{} has not ended: until then its channels are shown without their noise.", run.name.string()));
  }
  auto const* drawn = drawn_run(runs);
  if (auto const machine = machine_to_draw(drawn, machine_file, remarks)) {
    if (!drawn) drawn = &runs.front();
    json["machine"] = machine_json(*machine, drawn->data, page);
    if (json["machine"].is_null()) {
      remarks.emplace_back("No machine is drawn: its file gives its bodies no place in space.");
    } else {
      json["machine"]["set"] = drawn - runs.data();
      remarks.push_back(field_remark(json["machine"]));
    }
  }
  json["remarks"] = remarks;
  return json;
}

}  // namespace

BuiltReport build_report(ReportFiles const& files) {
  BuiltReport report{ReportPage("", fmt::format("ThermoTwin {} ({})", version(), commit())), {}};
  std::vector<ShownRun> runs;
  std::vector<std::string> answers;
  for (auto const& file : files.data) {
    if (is_answer(file)) {
      answers.push_back(add_answer(file, files.machine, report.page));
      continue;
    }
    refuse_folder(file);
    runs.push_back(read_shown_run(file));
  }
  name_distinctly(runs);
  report.page.set_title(title_of(files, runs, answers));
  if (runs.empty()) return report;
  Json const section = runs_json(runs, files.machine, report.page);
  report.page.add_section("runs", section);
  report.remarks = section["remarks"].get<std::vector<std::string>>();
  return report;
}

std::string write_report(ReportFiles const& files) {
  refuse_to_overwrite(files.output, files.machine, files.data);
  auto const [page, remarks] = build_report(files);
  std::string text;
  for (auto const& remark : remarks) text += remark + "\n";
  auto const html = page.html();
  output::write_atomically(files.output, html);
  return fmt::format("{}{}: {:.1f} MB; open it in a browser\n", text, files.output.string(), double(html.size()) / 1e6);
}

}  // namespace thermotwin::twin
