#include "output/dataset.h"

#include <cmath>
#include <fmt/core.h>
#include <set>

#include "thermal/error.h"

namespace thermotwin::output {
namespace {

using thermal::InputError;

void check_length(std::string const& what, Eigen::Index found, Eigen::Index expected) {
  if (found != expected) throw InputError(fmt::format("{} has {} values, expected {}", what, found, expected));
}

void check_time(std::string const& what, Eigen::VectorXd const& time_s) {
  for (Eigen::Index i = 0; i < time_s.size(); ++i) {
    if (!std::isfinite(time_s[i]))
      throw InputError(fmt::format("{}: value {} is {}, must be finite", what, i, time_s[i]));
    if (i > 0 && time_s[i] <= time_s[i - 1])
      throw InputError(fmt::format("{} must increase strictly, but {} s follows {} s", what, time_s[i], time_s[i - 1]));
  }
}

void check_name(std::string const& group, std::string const& name, std::set<std::string>& known) {
  if (name.empty() || name == "." || name == "time" || name.find('/') != std::string::npos)
    throw InputError(
        fmt::format("{}: '{}' cannot be a name: it must not be empty, '.', 'time' or have a '/'", group, name));
  if (!known.insert(name).second) throw InputError(fmt::format("{}: '{}' is there twice", group, name));
}

void check_channels(std::string const& group, std::vector<Channel> const& channels, Eigen::Index rows) {
  std::set<std::string> known;
  for (auto const& channel : channels) {
    check_name(group, channel.name, known);
    check_length(fmt::format("{}: '{}'", group, channel.name), channel.values.size(), rows);
  }
}

void check_positioning(std::string const& group, std::vector<Positioning> const& tables) {
  std::set<std::string> known;
  for (auto const& table : tables) {
    check_name(group, table.axis, known);
    std::string const what = fmt::format("{} of axis '{}'", group, table.axis);
    check_time(what + ", time", table.time_s);
    for (auto const* errors : {&table.forward_um, &table.backward_um}) {
      check_length(what + ", passes", errors->rows(), table.time_s.size());
      check_length(what + ", targets", errors->cols(), table.position_mm.size());
    }
  }
}

}  // namespace

void check(Dataset const& dataset) {
  auto const rows = dataset.time_s.size();
  check_time("time", dataset.time_s);
  check_channels("inputs", dataset.inputs, rows);
  check_channels("readings", dataset.readings, rows);
  check_channels("displacements", dataset.displacements, rows);
  check_channels("truth readings", dataset.truth_readings, rows);
  check_channels("truth displacements", dataset.truth_displacements, rows);
  check_channels("heat", dataset.heat, rows);
  check_positioning("positioning", dataset.positioning);
  check_positioning("truth positioning", dataset.truth_positioning);
  if (!dataset.node_temperatures) return;
  check_length("node temperatures, times", dataset.node_temperatures->rows(), rows);
  check_length("node temperatures, nodes", dataset.node_temperatures->cols(),
               static_cast<Eigen::Index>(dataset.node_names.size()));
}

void resize_rows(Dataset& dataset, Eigen::Index rows) {
  dataset.time_s.conservativeResize(rows);
  for (auto* channels : {&dataset.inputs, &dataset.readings, &dataset.displacements, &dataset.truth_readings,
                         &dataset.truth_displacements, &dataset.heat})
    for (auto& channel : *channels) channel.values.conservativeResize(rows);
  if (dataset.node_temperatures) dataset.node_temperatures->conservativeResize(rows, Eigen::NoChange);
}

Channel const* find_channel(std::vector<Channel> const& channels, std::string const& name) {
  auto const it =
      std::find_if(channels.begin(), channels.end(), [&](auto const& channel) { return channel.name == name; });
  return it == channels.end() ? nullptr : &*it;
}

std::vector<std::string> names_of(std::vector<Channel> const& channels) {
  std::vector<std::string> names;
  for (auto const& channel : channels) names.push_back(channel.name);
  return names;
}

Eigen::VectorXd at_times(Eigen::VectorXd const& course, Eigen::VectorXd const& own, Eigen::VectorXd const& times) {
  Eigen::VectorXd values = Eigen::VectorXd::Constant(times.size(), std::nan(""));
  for (Eigen::Index i = 0; i < times.size(); ++i) {
    auto const next = std::lower_bound(own.begin(), own.end(), times[i]) - own.begin();
    if (next == own.size() || times[i] < own[0]) continue;
    values[i] = course[next];
    if (next == 0 || own[next] == times[i]) continue;
    double const share = (times[i] - own[next - 1]) / (own[next] - own[next - 1]);
    values[i] = course[next - 1] + share * (course[next] - course[next - 1]);
  }
  return values;
}

}  // namespace thermotwin::output
