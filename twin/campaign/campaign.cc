#include "twin/campaign/campaign.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <utility>

#include "thermal/units.h"
#include "twin/campaign/latin_hypercube.h"
#include "twin/experiment_file.h"
#include "twin/machine.h"

namespace thermotwin::twin {
namespace {

/// Sets a parameter, and notes where in its range that is.
void add(CampaignRun& run, CampaignParameter const& parameter, Setting setting, std::int64_t place) {
  run.positions.push_back(parameter.values.empty() ? std::strtod(setting.value.c_str(), nullptr)
                                                   : parameter.position(place));
  run.settings.push_back(std::move(setting));
}

/// As a shell takes it for one word.
std::string shell_word(std::string const& text) {
  constexpr auto plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_./=:,+-";
  if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
  std::string word = "'";
  for (char const c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

}  // namespace

bool Campaign::samples_leave_machine() const {
  return std::all_of(samples.begin(), samples.end(), [](auto const& parameter) { return parameter.of_experiment(); });
}

/// Exact up to 2^53, and no overflow beyond.
double Campaign::count() const {
  double count = double(experiments.size()) * description.repetitions;
  for (auto const& parameter : grid) count *= double(parameter.count);
  if (!samples.empty()) count *= description.latin_hypercube->count;
  return cases_.empty() ? count : count * double(cases_.size());
}

std::int64_t Campaign::runs_per_part() const {
  if (description.part > 0) return description.part;
  return std::clamp<std::int64_t>((runs() + 255) / 256, 1, 1000);
}

Setting Campaign::sampled(CampaignParameter const& parameter, std::int64_t sample) const {
  auto const& latin = *description.latin_hypercube;
  return parameter.at(latin_hypercube(sample, latin.count, std::uint64_t(latin.seed), parameter.path));
}

CampaignRun Campaign::run(std::int64_t number) const {
  CampaignRun run;
  run.number = number;
  run.seed = int(description.seed + number);
  auto digit = [rest = number](std::int64_t count) mutable {
    auto const lowest = rest % count;
    rest /= count;
    return lowest;
  };
  static_cast<void>(digit(description.repetitions));
  run.experiment = std::size_t(digit(std::int64_t(experiments.size())));
  std::vector<std::int64_t> places(grid.size());
  std::int64_t sample = 0, chosen = 0;
  for (bool const of_experiment : {true, false}) {  // what changes the machine changes last
    for (std::size_t g = grid.size(); g-- > 0;)
      if (grid[g].of_experiment() == of_experiment) places[g] = digit(grid[g].count);
    if (!samples.empty() && samples_leave_machine() == of_experiment)
      sample = digit(description.latin_hypercube->count);
    if (!cases_.empty() && !of_experiment) chosen = digit(std::int64_t(cases_.size()));
  }
  run.settings = common_;
  if (!cases_.empty())
    run.settings.insert(run.settings.end(), cases_[std::size_t(chosen)].begin(), cases_[std::size_t(chosen)].end());
  for (std::size_t g = 0; g < grid.size(); ++g) add(run, grid[g], grid[g].value(places[g]), places[g]);
  for (auto const& parameter : samples) add(run, parameter, sampled(parameter, sample), 0);
  if (!cases_.empty()) {
    auto const& positions = case_positions_[std::size_t(chosen)];
    run.positions.insert(run.positions.end(), positions.begin(), positions.end());
  }
  return run;
}

CampaignRun Campaign::nominal(std::size_t experiment) const {
  CampaignRun run;
  run.experiment = experiment;
  run.seed = description.seed;
  run.settings = common_;
  return run;
}

scenarios::Experiment Campaign::experiment(CampaignRun const& run) const {
  auto const& source = experiments[run.experiment];
  bool const changed = std::any_of(run.settings.begin(), run.settings.end(), [](auto& s) { return s.of_experiment(); });
  auto experiment = source.nominal;
  bool own_seed = false;
  if (changed) {
    Value document = source.document, unused{{}, Value::Table{}};
    for (auto const& setting : run.settings)
      if (setting.of_experiment()) {
        apply(setting, unused, document);
        own_seed = own_seed || setting.path == "experiment.seed";
      }
    experiment = read_experiment(document, source.file);
  }
  if (!own_seed) experiment.seed = run.seed;
  if (description.every) experiment.sampling = *description.every;
  return experiment;
}

Value Campaign::machine(CampaignRun const& run) const {
  Value document = machine_document, unused{{}, Value::Table{}};
  for (auto const& setting : run.settings)
    if (!setting.of_experiment()) apply(setting, document, unused);
  return document;
}

std::string Campaign::command(CampaignRun const& run) const {
  std::string text =
      fmt::format("thermotwin run {} -m {} --tolerance {} --set experiment.seed={}",
                  shell_word(experiments[run.experiment].file.string()), shell_word(machine_file.string()),
                  thermal::format_number(description.tolerance), run.seed);
  auto const set = [&](std::string const& path, std::string const& value) {
    text += " --set " + shell_word(path + "=" + value);
  };
  if (description.every)
    set("experiment.sampling", thermal::format_quantity(*description.every, thermal::dimension::time));
  for (auto const& setting : run.settings) set(setting.path, setting.value);
  return text;
}

}  // namespace thermotwin::twin
