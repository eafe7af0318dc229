#include "twin/report/campaign_section.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "models/quantile.h"
#include "output/campaign_file.h"
#include "twin/file/text_file.h"
#include "twin/file/value.h"
#include "twin/report/campaign_progress.h"

namespace thermotwin::twin {
namespace {

namespace fs = std::filesystem;
using output::CampaignRuns;
using output::Json;
using output::ReportPage;

constexpr std::array<double, 5> shares = {0.05, 0.25, 0.5, 0.75, 0.95};
constexpr std::size_t most_failures = 200;
constexpr Eigen::Index last_figure = 1;  // of first, last, lowest, highest

struct Group {
  char const* name;  ///< of the variable, and of its summary
  char const* axis;
  char const* unit;
};
constexpr std::array<Group, 2> groups = {Group{"readings", "reading", "degC"}, {"displacements", "displacement", "um"}};

void append(Eigen::MatrixXd& all, Eigen::MatrixXd const& more) {
  if (more.rows() == 0) return;
  Eigen::Index const rows = all.rows();
  all.conservativeResize(rows + more.rows(), more.cols());
  all.bottomRows(more.rows()) = more;
}

/// The runs of all parts as if of one.
CampaignRuns read_all(std::vector<WholePart> const& parts, std::int64_t every) {
  CampaignRuns all;
  for (auto const& part : parts) {
    auto runs = output::read_runs(part.file, {"parameters", "readings", "displacements", "summary"}, every);
    if (all.variables.empty()) {
      all = std::move(runs);
      continue;
    }
    all.run.insert(all.run.end(), runs.run.begin(), runs.run.end());
    for (std::size_t v = 0; v < std::min(all.values.size(), runs.values.size()); ++v)
      append(all.values[v], runs.values[v]);
  }
  return all;
}

template <class Values>
Values const* axis_of(CampaignRuns const& runs, std::string const& name) {
  for (auto const& axis : runs.axes)
    if (axis.name == name) return std::get_if<Values>(&axis.values);
  return nullptr;
}

/// Shares × times, of run × (time × channel).
Eigen::MatrixXd quantiles(Eigen::MatrixXd const& values, Eigen::Index channel, Eigen::Index channels) {
  Eigen::Index const times = values.cols() / channels;
  Eigen::MatrixXd result = Eigen::MatrixXd::Constant(Eigen::Index(shares.size()), times, std::nan(""));
  std::vector<double> known;
  for (Eigen::Index t = 0; t < times; ++t) {
    known.clear();
    for (double const value : values.col(t * channels + channel))
      if (std::isfinite(value)) known.push_back(value);
    if (known.empty()) continue;
    std::sort(known.begin(), known.end());
    for (std::size_t s = 0; s < shares.size(); ++s) result(Eigen::Index(s), t) = models::quantile(known, shares[s]);
  }
  return result;
}

/// The last that is there, run by run.
Eigen::VectorXd last_values(Eigen::MatrixXd const& values, Eigen::Index channel, Eigen::Index channels) {
  Eigen::VectorXd last = Eigen::VectorXd::Constant(values.rows(), std::nan(""));
  for (Eigen::Index r = 0; r < values.rows(); ++r)
    for (Eigen::Index c = channel; c < values.cols(); c += channels)
      if (std::isfinite(values(r, c))) last[r] = values(r, c);
  return last;
}

/// The manifest's echo of a file; an empty one where it has none.
Value echoed(fs::path const& folder, char const* key) {
  auto const manifest = Json::parse(text_of_file(folder / "manifest.json"), nullptr, false);
  auto const text = manifest.is_object() ? manifest.value(key, std::string()) : std::string();
  return parse_toml(text, (folder / key).string());
}

std::string title_of(fs::path const& folder) {
  auto const document = echoed(folder, "campaign.file");
  auto const* title = document.find("title");
  return title && title->is_text() ? std::get<std::string>(title->content)
                                   : fmt::format("Campaign in {}", fs::weakly_canonical(folder).filename().string());
}

/// Channels that are angles: `[[rotation]]` of the machine's file.
std::vector<std::string> rotations_of(fs::path const& folder) {
  std::vector<std::string> names;
  auto const document = echoed(folder, "machine.file");
  auto const* tables = document.find("rotation");
  if (!tables || !tables->is_list()) return names;
  for (auto const& table : std::get<Value::List>(tables->content))
    if (auto const* name = table.find("name"); name && name->is_text())
      names.push_back(std::get<std::string>(name->content));
  return names;
}

void add_channels(CampaignRuns const& runs, Group const& group, std::vector<std::string> const& rotations,
                  ReportPage& page, Json& list) {
  auto const* names = axis_of<std::vector<std::string>>(runs, group.axis);
  auto const* courses = runs.find(group.name);
  auto const* summary = runs.find(fmt::format("summary/{}", group.name));
  if (!names || (!courses && !summary)) return;
  auto const count = Eigen::Index(names->size());
  for (Eigen::Index c = 0; c < count; ++c) {
    auto const& name = (*names)[std::size_t(c)];
    bool const rotation = std::find(rotations.begin(), rotations.end(), name) != rotations.end();
    Json channel = {{"name", name}, {"unit", rotation ? "urad" : group.unit}, {"group", group.name}};
    if (courses) channel["quantiles"] = page.add_numbers(quantiles(*courses, c, count));
    Eigen::VectorXd const last =
        courses ? last_values(*courses, c, count) : Eigen::VectorXd(summary->col(last_figure * count + c));
    channel["last"] = page.add_numbers(last);
    list.push_back(channel);
  }
}

Json parameters_json(CampaignRuns const& runs, ReportPage& page) {
  Json list = Json::array();
  std::string const prefix = "parameters/";
  for (std::size_t v = 0; v < runs.variables.size(); ++v) {
    auto const& variable = runs.variables[v];
    if (!variable.name.starts_with(prefix)) continue;
    list.push_back({{"name", variable.name.substr(prefix.size())},
                    {"unit", variable.unit},
                    {"title", variable.long_name},
                    {"values", page.add_numbers(runs.values[v])}});
  }
  return list;
}

}  // namespace

Json campaign_json(fs::path const& folder, ReportPage& page, std::int64_t most) {
  auto const parts = whole_parts(folder);
  if (parts.empty()) return nullptr;
  std::int64_t made = 0;
  for (auto const& part : parts) made += part.last - part.first + 1;
  std::int64_t const every = (made + most - 1) / most;
  auto const runs = read_all(parts, every);
  Json failures = Json::array();
  std::size_t failed = 0;
  for (auto const& part : parts)
    for (auto const& [run, reason] : output::read_failures(part.file))
      if (failed++ < most_failures) failures.push_back({{"run", run}, {"reason", reason}});
  Json remarks = Json::array();
  if (every > 1)
    remarks.push_back(fmt::format("Of {} runs one in {} is looked at here, {} in all.", made, every, runs.run.size()));
  if (failed > most_failures)
    remarks.push_back(
        fmt::format("The first {} of {} failures are listed; failures.csv has them all.", most_failures, failed));
  Json channels = Json::array();
  auto const rotations = rotations_of(folder);
  for (auto const& group : groups) add_channels(runs, group, rotations, page, channels);
  Json json = {{"title", title_of(folder)}, {"runs", made}, {"failed", failed}, {"failures", failures}};
  if (auto const* time = axis_of<Eigen::VectorXd>(runs, "time")) json["time"] = page.add_numbers(*time);
  json["run"] = page.add_whole_numbers({runs.run.begin(), runs.run.end()});
  json["channels"] = channels;
  json["parameters"] = parameters_json(runs, page);
  json["remarks"] = remarks;
  return json;
}

}  // namespace thermotwin::twin
