#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scenarios/experiment.h"
#include "twin/campaign/campaign_description.h"
#include "twin/setting.h"

namespace thermotwin::twin {

/// What one run of a campaign differs in; a function of its number alone.
struct CampaignRun {
  std::int64_t number = 0;
  std::size_t experiment = 0;
  int seed = 0;                   ///< of the instruments
  std::vector<double> positions;  ///< per parameter of grid, samples and cases: see CampaignParameter
  std::vector<Setting> settings;  ///< those of every run, of the case, of grid and samples, in this order
};

/// A parameter that a grid, a Latin hypercube or the cases vary.
struct CampaignParameter {
  std::string path, unit;
  double from = 0.0, to = 0.0;  ///< as numbers before the unit
  bool logarithmic = false;
  std::vector<std::string> values;  ///< one by one, in place of a range
  std::vector<double> numbers;      ///< the same in `unit`; none: they are words
  std::int64_t count = 0;           ///< of a grid's values
  Location where;                   ///< of its table in the file

  [[nodiscard]] bool of_experiment() const { return Setting{path, {}}.of_experiment(); }

  /// What stands for the k-th of the values in the data set: its number, of words k.
  [[nodiscard]] double position(std::int64_t k) const;
  /// The value at a share of the range, or the k-th.
  [[nodiscard]] Setting at(double share) const;
  [[nodiscard]] Setting value(std::int64_t k) const;

 private:
  [[nodiscard]] Setting set_to(double number) const;
};

struct CampaignExperiment {
  std::string name;
  std::filesystem::path file;
  Value document;
  scenarios::Experiment nominal;
};

/// A campaign as its file describes it: nothing is expanded, run i is made when it is asked for.
///
/// What changes the machine changes seldom: from the slowest to the fastest the grid's parameters of the machine, the
/// samples, the cases, the grid's parameters of the experiment, the experiments, and the repetitions. Samples that
/// leave the machine alone stand behind the cases.
class Campaign {
 public:
  /// FileError with line and column for unknown keys, paths that no machine or experiment has or whose programme is
  /// replaced by a recording, ranges without order or of two units, a parameter given twice, experiments of different
  /// sampling without `every`, another duration or sampling in some runs, another machine with a reduced model.
  static Campaign read(std::filesystem::path const& file);

  CampaignDescription description;
  std::filesystem::path file, machine_file;
  std::string text, machine_text;  ///< of both files
  Value machine_document;
  std::vector<CampaignExperiment> experiments;
  std::vector<CampaignParameter> grid, samples;
  std::vector<CampaignParameter> of_cases;  ///< one per path that any case sets, with the values that it gets

  [[nodiscard]] std::int64_t runs() const { return std::int64_t(count()); }
  [[nodiscard]] CampaignRun run(std::int64_t number) const;
  [[nodiscard]] std::int64_t runs_per_part() const;
  [[nodiscard]] std::int64_t parts() const { return (runs() + runs_per_part() - 1) / runs_per_part(); }

  /// An experiment with what is set in every run, and nothing varied.
  [[nodiscard]] CampaignRun nominal(std::size_t experiment) const;

  /// The experiment of a run, with its settings, its seed and the campaign's sampling.
  [[nodiscard]] scenarios::Experiment experiment(CampaignRun const& run) const;
  /// The machine's document with the run's settings.
  [[nodiscard]] Value machine(CampaignRun const& run) const;
  /// The command that makes this run alone, with all that a campaign leaves out, as a shell takes it.
  [[nodiscard]] std::string command(CampaignRun const& run) const;

 private:
  Campaign() = default;
  [[nodiscard]] double count() const;
  [[nodiscard]] bool samples_leave_machine() const;
  [[nodiscard]] Setting sampled(CampaignParameter const& parameter, std::int64_t sample) const;
  void read_experiments();
  void read_machine();
  void read_parameters(Value const& document);
  void read_cases(Value const& document);
  void check_paths(Value const& document) const;
  void check_settings(Value const& document) const;
  void check_sampling(Value const& document) const;
  void try_setting(Location const& where, std::vector<Setting> const& settings) const;

  std::vector<Setting> common_;
  std::vector<std::vector<Setting>> cases_;
  std::vector<std::vector<double>> case_positions_;  ///< per case, those of the cases' parameters; NaN: it sets none
};

/// A campaign file, or the name of one in scenarios/campaigns; InputError with the nearest name.
[[nodiscard]] std::filesystem::path campaign_file(std::string const& name_or_path);

}  // namespace thermotwin::twin
