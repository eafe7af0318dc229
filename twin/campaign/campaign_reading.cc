#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "scenarios/course.h"
#include "thermal/error.h"
#include "thermal/nearest_name.h"
#include "thermal/unit.h"
#include "thermal/units.h"
#include "twin/campaign/campaign.h"
#include "twin/experiment_file.h"
#include "twin/file/document.h"
#include "twin/file/shipped_file.h"
#include "twin/file/text_file.h"
#include "twin/file_kind.h"
#include "twin/machine.h"
#include "twin/run.h"

namespace thermotwin::twin {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_values_tried = 20;
constexpr double most_runs = 1e9;
constexpr std::size_t most_letters = 50'000;  // of words; HDF5 takes 64 KiB for an attribute

/// Beside the campaign's file, or as the command line takes it.
template <class Shipped>
fs::path file_of(std::string const& name, fs::path const& campaign, Shipped shipped) {
  fs::path const beside = campaign.parent_path() / name;
  return fs::path(name).extension() == ".toml" && fs::exists(beside) ? beside : shipped(name);
}

Value::List const& tables(Value const& document, std::string const& key) {
  static Value::List const none;
  Value const* value = document.find(key);
  return value ? std::get<Value::List>(value->content) : none;
}

/// Values of parameters are read as text, whether they were written as text or as numbers.
void make_text(Value& value) {
  if (value.is_list())
    for (auto& item : std::get<Value::List>(value.content)) make_text(item);
  else if (!value.is_text() && !value.is_table())
    value.content = value.text();
}

void make_texts(Value& document) {
  auto const each = [](Value* list) {
    if (!list || !list->is_list()) return;
    for (auto& table : std::get<Value::List>(list->content))
      for (auto const* key : {"values", "from", "to"})
        if (Value* value = table.is_table() ? table.find(key) : nullptr) make_text(*value);
  };
  each(document.find("grid"));
  if (Value* latin = document.find("latin_hypercube"); latin && latin->is_table()) each(latin->find("vary"));
}

/// "18 degC" as 18 and "degC"; false when no number stands in front.
bool split(std::string const& text, double& number, std::string& unit) {
  char* end = nullptr;
  number = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || !std::isfinite(number)) return false;
  unit = end;
  unit.erase(0, unit.find_first_not_of(' '));
  return true;
}

void read_range(Value const& table, std::string const& from, std::string const& to, std::string const& scale,
                CampaignParameter& parameter) {
  std::string other;
  if (!split(from, parameter.from, parameter.unit))
    throw FileError(where_of(table, "from"), fmt::format("'from' is '{}'; a number with its unit is due", from));
  if (!split(to, parameter.to, other))
    throw FileError(where_of(table, "to"), fmt::format("'to' is '{}'; a number with its unit is due", to));
  if (other != parameter.unit)
    throw FileError(where_of(table, "to"),
                    fmt::format("'to' is in '{}' and 'from' in '{}'; one unit is due", other, parameter.unit));
  parameter.logarithmic = scale == "log";
  if (parameter.logarithmic && (parameter.from <= 0.0 || parameter.to <= 0.0))
    throw FileError(where_of(table, "scale"), "a logarithmic range lies above 0");
}

/// Nothing for a word.
std::optional<thermal::Quantity> quantity_in(std::string const& text) {
  try {
    return thermal::parse_quantity(text);
  } catch (thermal::InputError const&) {
    return std::nullopt;
  }
}

/// Values that are all quantities of one dimension become numbers in the unit of the first; what is written in that
/// unit keeps its digits.
void read_numbers(CampaignParameter& parameter) {
  std::string unit, own;
  double number = 0.0;
  auto const first = quantity_in(parameter.values.front());
  split(parameter.values.front(), number, unit);
  std::vector<double> numbers;
  for (auto const& text : parameter.values) {
    auto const quantity = quantity_in(text);
    if (!first || !quantity || quantity->dimension != first->dimension) return;
    split(text, number, own);
    double const zero = first->absolute_temperature ? quantity->value : 0.0;
    numbers.push_back(
        own == unit ? number
                    : thermal::without_rounding(thermal::to_unit(quantity->value, unit.empty() ? "1" : unit), zero));
  }
  parameter.unit = thermal::in_ascii(unit);
  parameter.numbers = std::move(numbers);
}

/// As many words as an attribute holds.
void check_letters(CampaignParameter const& parameter, Location const& where) {
  std::size_t letters = 0;
  for (auto const& value : parameter.values) letters += value.size();
  if (parameter.numbers.empty() && letters > most_letters)
    throw FileError(where, fmt::format("values that are words may have {} letters, not {}: the campaign's file names "
                                       "each of them beside its numbers",
                                       most_letters, letters));
}

CampaignParameter grid_parameter(Value const& table, GridDescription const& grid) {
  CampaignParameter parameter;
  parameter.path = grid.path;
  parameter.where = where_of(table, "path");
  if (!grid.values.empty()) {
    if (!grid.from.empty() || !grid.to.empty() || grid.count > 0)
      throw FileError(table.where, "give either 'values', or 'from', 'to' and 'count'");
    parameter.values = grid.values;
    parameter.count = std::int64_t(grid.values.size());
    read_numbers(parameter);
    check_letters(parameter, where_of_item(table, "values", 0));
    return parameter;
  }
  if (grid.count < 1) throw FileError(table.where, "give either 'values', or 'from', 'to' and 'count' from 1 on");
  read_range(table, grid.from, grid.to, grid.scale, parameter);
  parameter.count = grid.count;
  return parameter;
}

void refuse_time_axis(std::vector<Setting> const& settings) {
  for (auto const& setting : settings)
    if (setting.path == "experiment.duration" || setting.path == "experiment.sampling")
      throw thermal::InputError(
          fmt::format("'{}' cannot be varied: all runs share one time axis; see 'every'", setting.path));
}

void check_keep(Value const& document, std::vector<std::string> const& keep) {
  std::vector<std::string> const groups = {"readings", "displacements", "inputs", "truth", "summary"};
  std::set<std::string> seen;
  for (std::size_t k = 0; k < keep.size(); ++k) {
    auto const where = where_of_item(document, "keep", k);
    if (std::find(groups.begin(), groups.end(), keep[k]) == groups.end())
      throw FileError(where,
                      fmt::format("there is no '{}' to keep; {}", keep[k], thermal::did_you_mean(keep[k], groups)));
    if (!seen.insert(keep[k]).second) throw FileError(where, fmt::format("'{}' is given twice", keep[k]));
  }
}

}  // namespace

void Campaign::read_experiments() {
  for (auto const& name : description.experiments) {
    auto const path = file_of(name, file, experiment_file);
    Value document = read_toml(path);
    auto nominal = read_experiment(document, path);
    experiments.push_back({path.stem().string(), path, std::move(document), std::move(nominal)});
  }
}

void Campaign::read_machine() {
  auto const& first = experiments.front();
  machine_file = description.machine.empty() ? machine_of(first.nominal, first.file)
                                             : file_of(description.machine, file, twin::machine_file);
  machine_text = text_of_file(machine_file);
  machine_document = parse_toml(machine_text, machine_file.string());
}

void Campaign::read_parameters(Value const& document) {
  for (std::size_t g = 0; g < description.grid.size(); ++g)
    grid.push_back(grid_parameter(tables(document, "grid")[g], description.grid[g]));
  if (!description.latin_hypercube) return;
  Value const& latin = *document.find("latin_hypercube");
  if (description.latin_hypercube->count < 1)
    throw FileError(latin.where, "[latin_hypercube] needs 'count', how many samples, from 1 on");
  auto const& varied = description.latin_hypercube->vary;
  for (std::size_t v = 0; v < varied.size(); ++v) {
    Value const& table = tables(latin, "vary")[v];
    auto& parameter = samples.emplace_back();
    parameter.path = varied[v].path;
    parameter.where = where_of(table, "path");
    read_range(table, varied[v].from, varied[v].to, varied[v].scale, parameter);
  }
  if (samples.empty()) throw FileError(latin.where, "[latin_hypercube] varies nothing; add [[latin_hypercube.vary]]");
}

void Campaign::read_cases(Value const& document) {
  for (auto const& given : description.cases) {
    auto& settings = cases_.emplace_back();
    for (auto const& text : given.set) settings.push_back(setting(text));
  }
  std::map<std::string, std::size_t> numbers;  // of the parameters, by their paths
  for (std::size_t c = 0; c < cases_.size(); ++c)
    for (std::size_t s = 0; s < cases_[c].size(); ++s) {
      auto const& [path, value] = cases_[c][s];
      if (numbers.try_emplace(path, of_cases.size()).second) {
        of_cases.emplace_back().path = path;
        of_cases.back().where = where_of_item(tables(document, "case")[c], "set", s);
      }
      auto& values = of_cases[numbers.at(path)].values;
      if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
    }
  for (auto& parameter : of_cases) {
    read_numbers(parameter);
    check_letters(parameter, parameter.where);
  }
  for (auto const& settings : cases_) {
    auto& positions = case_positions_.emplace_back(of_cases.size(), std::numeric_limits<double>::quiet_NaN());
    for (auto const& [path, value] : settings) {
      auto const& parameter = of_cases[numbers.at(path)];
      auto const& values = parameter.values;
      positions[numbers.at(path)] = parameter.position(std::find(values.begin(), values.end(), value) - values.begin());
    }
  }
}

/// Builds what the settings make, on the first experiment; a complaint gets the place of what asked for it.
void Campaign::try_setting(Location const& where, std::vector<Setting> const& settings) const {
  try {
    auto run = nominal(0);
    run.settings.insert(run.settings.end(), settings.begin(), settings.end());
    auto const machine = Machine::build(this->machine(run));
    for (; run.experiment < experiments.size(); ++run.experiment) {
      auto const programme = experiment(run);
      for (auto const& setting : run.settings) refuse_replaced(setting, programme);
      scenarios::ExperimentCourse const course(programme, machine.limits);
    }
  } catch (thermal::InputError const& error) {
    throw FileError(where, as_setting(error.what()));
  }
}

/// Of a range its ends and a value between, which has a fraction where any has one.
void Campaign::check_settings(Value const& document) const {
  std::set<std::string> paths;
  try_setting(document.where, {});
  for (auto const* parameters : {&of_cases, &grid, &samples})
    for (auto const& parameter : *parameters)
      if (!paths.insert(parameter.path).second)
        throw FileError(parameter.where, fmt::format("'{}' is varied twice", parameter.path));
  for (auto const* parameters : {&grid, &samples})
    for (auto const& parameter : *parameters) {
      if (parameter.values.empty()) {
        try_setting(parameter.where, {parameter.at(0.0)});
        try_setting(parameter.where, {parameter.at(1.0)});
        try_setting(parameter.where,
                    {parameters == &grid ? parameter.value(1 % parameter.count) : sampled(parameter, 0)});
      }
      for (std::size_t k = 0; k < std::min(parameter.values.size(), most_values_tried); ++k)
        try_setting(parameter.where, {parameter.value(std::int64_t(k))});
    }
  for (std::size_t c = 0; c < std::min(cases_.size(), most_values_tried); ++c)
    try_setting(tables(document, "case")[c].where, cases_[c]);
}

/// Of every case, also of those that are not tried, and of every parameter.
void Campaign::check_paths(Value const& document) const {
  auto const check = [&](Location const& where, std::vector<Setting> const& settings) {
    try {
      refuse_time_axis(settings);
    } catch (thermal::InputError const& error) {
      throw FileError(where, error.what());
    }
    for (auto const& setting : settings)
      if (description.model == "reduced" && !setting.of_experiment())
        throw FileError(where, fmt::format("'{}' cannot be varied: a reduced model is of one machine, with model = "
                                           "\"reduced\" only experiments may vary",
                                           setting.path));
  };
  for (auto const* parameters : {&grid, &samples})
    for (auto const& parameter : *parameters) check(parameter.where, {{parameter.path, ""}});
  for (std::size_t c = 0; c < cases_.size(); ++c) check(tables(document, "case")[c].where, cases_[c]);
}

void Campaign::check_sampling(Value const& document) const {
  if (description.every) {
    for (std::size_t e = 0; e < experiments.size(); ++e) try {
        scenarios::check_readings(experiment(nominal(e)));
      } catch (thermal::InputError const& error) {
        throw FileError(where_of(document, "every"), error.what());
      }
    return;
  }
  double const first = experiment(nominal(0)).sampling;
  for (std::size_t e = 1; e < experiments.size(); ++e)
    if (double const sampling = experiment(nominal(e)).sampling; sampling != first)
      throw FileError(where_of_item(document, "experiments", e),
                      fmt::format("'{}' is read every {:g} s and '{}' every {:g} s; give 'every', for all",
                                  experiments[e].name, sampling, experiments[0].name, first));
}

Campaign Campaign::read(fs::path const& file) {
  Campaign campaign;
  campaign.file = file;
  Value document = read_toml(file);
  campaign.text = text_of_file(file);
  make_texts(document);
  read_file_fields(document, FileKind::campaign, campaign.description);
  auto const& description = campaign.description;
  check_keep(document, description.keep);
  if (!(description.tolerance >= finest_tolerance && description.tolerance <= coarsest_tolerance))
    throw FileError(where_of(document, "tolerance"),
                    fmt::format("'tolerance' is {}; allowed is {} to {}", description.tolerance, finest_tolerance,
                                coarsest_tolerance));
  if (description.experiments.empty()) throw FileError(document.where, "the campaign names no 'experiments'");
  auto const located = [&](std::string const& key, auto const& action) {
    try {
      action();
    } catch (FileError const&) {
      throw;
    } catch (thermal::InputError const& error) {
      throw FileError(where_of_item(document, key, 0), error.what());
    }
  };
  located("experiments", [&] { campaign.read_experiments(); });
  located("machine", [&] { campaign.read_machine(); });
  campaign.read_parameters(document);
  located("set", [&] {
    for (auto const& text : description.set) campaign.common_.push_back(setting(text));
  });
  located("case", [&] { campaign.read_cases(document); });
  if (campaign.count() > most_runs)
    throw FileError(document.where,
                    fmt::format("these are {:.3g} runs; at most {:.0e} are possible", campaign.count(), most_runs));
  campaign.check_paths(document);
  campaign.check_settings(document);
  campaign.check_sampling(document);
  return campaign;
}

fs::path campaign_file(std::string const& name_or_path) {
  return shipped_file("campaign", "scenarios/campaigns", name_or_path);
}

}  // namespace thermotwin::twin
