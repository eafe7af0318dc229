#include "twin/diagnosis/diagnose_files.h"

namespace thermotwin::twin {
namespace {

std::vector<MeasuredRun> read_runs(std::vector<std::filesystem::path> const& paths, Machine const& machine,
                                   std::vector<std::string>& remarks) {
  std::vector<MeasuredRun> runs;
  for (auto const& path : paths) {
    runs.push_back(read_measured_run(path, machine));
    for (auto const& remark : runs.back().remarks) remarks.push_back(path.filename().string() + ": " + remark);
  }
  return runs;
}

std::vector<BinnedRun> binned(std::vector<MeasuredRun> const& runs) {
  std::vector<BinnedRun> result;
  for (auto const& run : runs) result.push_back(bin(run, fitting_interval(run)));
  return result;
}

}  // namespace

DiagnosisReport diagnose_files(DiagnoseFiles const& files) {
  DiagnosisReport report;
  Value const document = read_toml(files.machine);
  Machine const machine = Machine::build(document);
  auto const runs = read_runs(files.data, machine, report.remarks);
  auto const unseen = read_runs(files.held_out, machine, report.remarks);
  auto const fitted = binned(runs), held_out = binned(unseen);
  DiagnosisOptions options;
  options.without = files.without;
  options.progress = files.progress;
  report.diagnosis = diagnose(document, fitted, held_out, options);
  Machine const amended = Machine::build(report.diagnosis.document);
  report.fitted = gaps(machine, amended, fitted);
  report.held_out = gaps(machine, amended, held_out);
  return report;
}

}  // namespace thermotwin::twin
