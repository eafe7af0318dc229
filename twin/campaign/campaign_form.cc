#include "twin/campaign/campaign_form.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <span>
#include <utility>

#include "scenarios/course.h"
#include "thermal/error.h"
#include "twin/history.h"
#include "twin/instruments/five_probe_nest.h"
#include "twin/run.h"

namespace thermotwin::twin {
namespace {

using Kind = output::CampaignVariable::Kind;

constexpr float missing = std::numeric_limits<float>::quiet_NaN();
constexpr auto left_alone = " (missing where a case leaves it as it is)";
constexpr std::size_t figures = 4;                  // first, last, lowest, highest
constexpr std::size_t rows_of_run = 2, failed = 3;  // variables of a part

/// The inputs that the machine's network asks for; a spindle's speed is always one.
std::vector<output::Channel> used_inputs(Machine const& machine, scenarios::ExperimentCourse const& course) {
  std::vector<output::Channel> used;
  auto const& network = machine.network();
  std::span const asked(network.channel_names().data(), std::size_t(network.external_channels()));
  for (auto const& channel : input_channels(course))
    if (channel.name == "spindle.speed" || channel.name == "ambient.temperature" ||
        std::find(asked.begin(), asked.end(), channel.name) != asked.end())
      used.push_back(channel);
  return used;
}

/// The channels of these names, in this order.
std::vector<Eigen::VectorXd const*> find(std::vector<output::Channel> const& channels,
                                         std::vector<std::string> const& names) {
  std::vector<Eigen::VectorXd const*> found;
  for (auto const& name : names) {
    auto const* channel = find_channel(channels, name);
    if (!channel) throw thermal::InputError(fmt::format("the run has no channel '{}'", name));
    found.push_back(&channel->values);
  }
  return found;
}

/// The path, and of words which number stands for which.
std::string name_of(CampaignParameter const& parameter) {
  std::string name = parameter.path;
  for (std::size_t k = 0; parameter.numbers.empty() && k < parameter.values.size(); ++k)
    name += fmt::format("{} {}: {}", k == 0 ? ";" : ",", k, parameter.values[k]);
  return name;
}

/// rows × channels, rows that are not there missing.
void append_table(std::vector<float>& numbers, std::vector<Eigen::VectorXd const*> const& columns, std::size_t rows) {
  for (std::size_t r = 0; r < rows; ++r)
    for (auto const* column : columns)
      numbers.push_back(Eigen::Index(r) < column->size() ? float((*column)[Eigen::Index(r)]) : missing);
}

/// figures × channels.
void append_summary(std::vector<float>& numbers, std::vector<Eigen::VectorXd const*> const& columns) {
  std::size_t const first = numbers.size(), count = columns.size();
  numbers.resize(first + figures * count, missing);
  for (std::size_t c = 0; c < count; ++c)
    for (double const value : *columns[c]) {
      if (std::isnan(value)) continue;
      auto const at = [&](std::size_t figure) -> float& { return numbers[first + figure * count + c]; };
      auto const given = float(value);
      if (std::isnan(at(0))) at(0) = at(2) = at(3) = given;
      at(1) = given;
      at(2) = std::min(at(2), given);
      at(3) = std::max(at(3), given);
    }
}

}  // namespace

std::string CampaignResult::to_bytes() const {
  std::int64_t const head[] = {number, rows, std::int64_t(failure.size())};
  std::string bytes(reinterpret_cast<char const*>(head), sizeof head);
  bytes += failure;
  return bytes.append(reinterpret_cast<char const*>(numbers.data()), numbers.size() * sizeof(float));
}

CampaignResult CampaignResult::from_bytes(std::string const& bytes) {
  std::int64_t head[3];
  std::memcpy(head, bytes.data(), sizeof head);
  auto const text = std::size_t(head[2]);
  CampaignResult result{head[0], head[1], bytes.substr(sizeof head, text), {}};
  result.numbers.resize((bytes.size() - sizeof head - text) / sizeof(float));
  std::memcpy(result.numbers.data(), bytes.data() + sizeof head + text, result.numbers.size() * sizeof(float));
  return result;
}

CampaignForm::CampaignForm(Campaign const& campaign, Machine const& machine) : campaign_(campaign) {
  layout_.title = campaign.description.title.empty() ? campaign.file.stem().string() : campaign.description.title;
  add_axes(machine);
  add_variables();
}

void CampaignForm::add_axes(Machine const& machine) {
  Eigen::VectorXd time;
  std::vector<std::string> names;
  for (std::size_t e = 0; e < campaign_.experiments.size(); ++e) {
    auto const experiment = campaign_.experiment(campaign_.nominal(e));
    auto const times = scenarios::sample_times(experiment);
    if (times.size() > std::size_t(time.size()))
      time = Eigen::Map<Eigen::VectorXd const>(times.data(), Eigen::Index(times.size()));
    names.push_back(campaign_.experiments[e].name);
    for (auto const& channel : used_inputs(machine, {experiment, machine.limits}))
      if (std::find(inputs_.begin(), inputs_.end(), channel.name) == inputs_.end()) inputs_.push_back(channel.name);
  }
  rows_ = std::size_t(time.size());
  for (auto const& sensor : machine.sensors) readings_.push_back(sensor.description.name);
  displacements_ = names_of(displacement_channels(machine));
  if (machine.nest) displacements_.insert(displacements_.end(), probe_names.begin(), probe_names.end());
  layout_.axes = {{"time", "s", "time from the start", time},
                  {"reading", "1", "temperature sensor", readings_},
                  {"displacement", "1", "channel of displacement", displacements_},
                  {"input", "1", "input channel", inputs_},
                  {"experiment_name", "1", "experiments, by their number", names},
                  {"figure", "1", "of a course", std::vector<std::string>{"first", "last", "lowest", "highest"}}};
  std::erase_if(layout_.axes, [](auto const& axis) { return axis.size() == 0; });
}

void CampaignForm::keep(std::string const& name, std::string const& unit, std::string const& long_name,
                        std::vector<std::string> const& axes) {
  auto const is_there = [&](std::string const& name) {
    return std::any_of(layout_.axes.begin(), layout_.axes.end(), [&](auto const& axis) { return axis.name == name; });
  };
  if (!std::all_of(axes.begin(), axes.end(), is_there)) return;
  layout_.variables.push_back({Kind::real32, name, unit, long_name, axes});
  numbers_ += layout_.size(layout_.variables.back());
}

void CampaignForm::add_variables() {
  auto& variables = layout_.variables;
  variables = {{Kind::whole, "experiment", "1", "number of the experiment in experiment_name", {}},
               {Kind::whole, "seed", "1", "of the instruments", {}},
               {Kind::whole, "rows", "1", "readings in time; those after them are missing", {}},
               {Kind::whole, "failed", "1", "1: the run failed, see failures", {}}};
  for (auto const* parameters : {&campaign_.grid, &campaign_.samples, &campaign_.of_cases})
    for (auto const& parameter : *parameters)
      variables.push_back({Kind::real64,
                           "parameters/" + parameter.path,
                           parameter.unit.empty() ? "1" : parameter.unit,
                           name_of(parameter) + (parameters == &campaign_.of_cases ? left_alone : ""),
                           {}});
  first_kept_ = variables.size();
  for (auto const& group : campaign_.description.keep) {
    if (group == "readings") keep("readings", "degC", "what the sensors read", {"time", "reading"});
    if (group == "displacements")
      keep("displacements", "um", "what the probes read; of rotations: urad", {"time", "displacement"});
    if (group == "inputs") keep("inputs", "1", "in the units of a run's data set", {"time", "input"});
    if (group == "truth") {
      keep("truth/readings", "degC", "without the sensors' errors", {"time", "reading"});
      keep("truth/displacements", "um", "without the probes' errors; of rotations: urad", {"time", "displacement"});
    }
    if (group == "summary") {
      keep("summary/readings", "degC", "figures of the sensors' readings", {"figure", "reading"});
      keep("summary/displacements", "um", "figures of the probes' readings; of rotations: urad",
           {"figure", "displacement"});
    }
  }
  if (campaign_.description.model != "reduced") return;
  keep("bound/readings", "K", "of the difference from a full run", {"reading"});
  keep("bound/displacements", "um", "of the difference from a full run; of rotations: urad", {"displacement"});
}

std::vector<float> CampaignForm::kept(output::Dataset const& dataset) const {
  std::vector<float> numbers;
  numbers.reserve(numbers_);
  for (auto const& group : campaign_.description.keep) {
    if (group == "readings") append_table(numbers, find(dataset.readings, readings_), rows_);
    if (group == "displacements") append_table(numbers, find(dataset.displacements, displacements_), rows_);
    if (group == "inputs") append_table(numbers, find(dataset.inputs, inputs_), rows_);
    if (group == "truth") {
      append_table(numbers, find(dataset.truth_readings, readings_), rows_);
      append_table(numbers, find(dataset.truth_displacements, displacements_), rows_);
    }
    if (group == "summary") {
      append_summary(numbers, find(dataset.readings, readings_));
      append_summary(numbers, find(dataset.displacements, displacements_));
    }
  }
  return numbers;
}

std::vector<float> CampaignForm::kept(ReducedResult const& result) const {
  auto numbers = kept(result.dataset);
  numbers.insert(numbers.end(), result.bound.readings.begin(), result.bound.readings.end());
  auto const& displacements = result.bound.displacements;
  numbers.insert(numbers.end(), displacements.begin(), displacements.end());
  numbers.resize(numbers_, missing);  // the probes of a nest have no bound of their own
  return numbers;
}

output::CampaignPart CampaignForm::part(std::int64_t first, std::int64_t count) const {
  output::CampaignPart part{first, count, {}, {}};
  auto const runs = std::size_t(count);
  std::vector<std::int64_t> experiment(runs), seed(runs);
  std::vector<std::vector<double>> parameters(
      campaign_.grid.size() + campaign_.samples.size() + campaign_.of_cases.size(), std::vector<double>(runs));
  for (std::size_t r = 0; r < runs; ++r) {
    auto const run = campaign_.run(first + std::int64_t(r));
    experiment[r] = std::int64_t(run.experiment);
    seed[r] = run.seed;
    for (std::size_t p = 0; p < parameters.size(); ++p) parameters[p][r] = run.positions[p];
  }
  std::vector<std::int64_t> const none(runs, 0);
  part.values = {std::move(experiment), std::move(seed), none, none};
  for (auto& values : parameters) part.values.emplace_back(std::move(values));
  for (std::size_t v = first_kept_; v < layout_.variables.size(); ++v)
    part.values.emplace_back(std::vector<float>(layout_.size(layout_.variables[v]) * runs));
  return part;
}

void CampaignForm::put(CampaignResult const& result, output::CampaignPart& part) const {
  auto const r = std::size_t(result.number - part.first);
  std::get<std::vector<std::int64_t>>(part.values[rows_of_run])[r] = result.rows;
  bool const has_failed = !result.failure.empty();
  if (has_failed) {
    std::get<std::vector<std::int64_t>>(part.values[failed])[r] = 1;
    part.failures.emplace(result.number, result.failure);
  }
  auto from = result.numbers.begin();
  for (std::size_t v = first_kept_; v < layout_.variables.size(); ++v) {
    auto const size = std::ptrdiff_t(layout_.size(layout_.variables[v]));
    auto const place = std::get<std::vector<float>>(part.values[v]).begin() + std::ptrdiff_t(r) * size;
    if (has_failed)
      std::fill_n(place, size, missing);
    else
      std::copy_n(std::exchange(from, from + size), size, place);
  }
}

}  // namespace thermotwin::twin
