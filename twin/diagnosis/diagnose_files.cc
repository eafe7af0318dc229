#include "twin/diagnosis/diagnose_files.h"

#include <cmath>
#include <fmt/format.h>

#include "twin/diagnosis/estimate_text.h"
#include "twin/diagnosis/run_files.h"
#include "twin/file/output_path.h"
#include "twin/file/text_file.h"
#include "twin/file_kind.h"

namespace thermotwin::twin {
namespace {

std::string origin_of(Explanation const& explanation, Hypothesis const& effect, RunFiles const& data) {
  std::string text = fmt::format("Diagnosed from {}: {}, at {}.", names_of(data), effect.effect->meaning, effect.site);
  auto const& all = explanation.alternatives;
  text += fmt::format("\n2 ln of the evidence against the machine without it: {:.0f}.", all[0].strength);
  if (all.size() == 1) return text;
  text += fmt::format(" One of {}, which these data do not tell apart:", all.size());
  for (auto const& finding : all)
    text += fmt::format("\n  {:.0f} % {}", 100.0 * finding.weight, finding.hypothesis.label());
  return text;
}

AddedTable table_of(Diagnosis const& diagnosis, std::size_t u, RunFiles const& data) {
  auto const number = diagnosis.unknowns[u].index;
  auto const& effect = diagnosis.effects[number];
  auto const i = Eigen::Index(u);
  double const amplitude = diagnosis.written.x[i] * effect.largest;
  auto const& explanation = diagnosis.explanations[number];  // in the order of the effects
  std::string const unit = readable_unit(amplitude, effect.dimension());
  AddedTable table{effect.effect->name, {}, origin_of(explanation, effect, data)};
  for (auto const& [key, text] : table_of(effect, fmt::format("diagnosed_{}", number + 1), amplitude))
    if (key == effect.trial->amplitude)
      table.keys.push_back({key, written_value(amplitude, unit), explanation.alternatives[0].interval_text(unit)});
    else
      table.keys.push_back({key, text, ""});
  return table;
}

std::string amended(std::string const& text, Diagnosis const& diagnosis, RunFiles const& data) {
  std::vector<AddedTable> tables;
  for (std::size_t u = 0; u < diagnosis.unknowns.size(); ++u)
    if (diagnosis.unknowns[u].kind == Unknown::Kind::amplitude) tables.push_back(table_of(diagnosis, u, data));
  return with_last_words(amended_text(with_values(text, diagnosis.changes), tables),
                         fmt::format("Diagnosis of {}: {}. Numbers calibrated with it; ±: 95 %.", names_of(data),
                                     name_of(diagnosis.verdict)));
}

/// The machine has numbers that its author did not know exactly, and the data know none of them, nor an effect, twice
/// as well.
bool identify_nothing(Diagnosis const& diagnosis) {
  bool has_numbers = false;
  for (std::size_t u = 0; u < diagnosis.unknowns.size(); ++u) {
    auto const& unknown = diagnosis.unknowns[u];
    bool const number = unknown.kind == Unknown::Kind::number;
    if (!number && unknown.kind != Unknown::Kind::amplitude) continue;
    auto const i = Eigen::Index(u);
    if (std::sqrt(diagnosis.amended.covariance(i, i)) < 0.5 * unknown.deviation) return false;
    has_numbers = has_numbers || number;
  }
  return has_numbers;
}

}  // namespace

DiagnosisReport diagnose_files(DiagnoseFiles const& files) {
  RunFiles every = files.data;
  every.insert(every.end(), files.held_out.begin(), files.held_out.end());
  refuse_to_overwrite(files.output, files.machine, every);
  refuse_to_replace(files.output, FileKind::machine);
  DiagnosisReport report;
  Value const document = read_toml(files.machine);
  Machine const machine = Machine::build(document);
  auto const runs = read_runs(files.data, machine, report.remarks, files.held_out);
  auto const unseen = read_runs(files.held_out, machine, report.remarks, files.data);
  auto const fitted = binned(runs), held_out = binned(unseen);
  std::vector<BinnedRun> every_run = fitted;
  every_run.insert(every_run.end(), held_out.begin(), held_out.end());
  report.doubts = doubts(machine, every_run);
  DiagnosisOptions options;
  options.without = files.without;
  options.start = files.start;
  options.progress = files.progress;
  options.watch = files.watch;
  report.diagnosis = with_doubts(report.doubts, [&] { return diagnose(document, fitted, options, held_out); });
  if (auto const& friction = report.diagnosis.friction)
    report.remarks.insert(report.remarks.begin(), friction->remark());
  if (!report.diagnosis.suspicion && identify_nothing(report.diagnosis))
    report.remarks.emplace_back(
        "the data identify no number of the machine and no effect: the runs are too short, or too little happens in "
        "them; nothing can be said about what is missing");
  Machine const amended_machine = Machine::build(report.diagnosis.document);
  Machine const calibrated = Machine::build(report.diagnosis.calibrated_document);
  report.fitted = gaps(machine, amended_machine, fitted, &calibrated);
  report.held_out = gaps(machine, amended_machine, held_out, &calibrated);
  if (files.show) files.show(report);
  if (!files.output.empty())
    write_amended(files.machine, files.output, amended(text_of_file(files.machine), report.diagnosis, files.data));
  return report;
}

}  // namespace thermotwin::twin
