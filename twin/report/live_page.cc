#include "twin/report/live_page.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <set>

#include "output/dataset_file.h"
#include "output/report_page.h"
#include "thermal/error.h"
#include "twin/progress_file.h"
#include "twin/report/campaign_progress.h"
#include "twin/report/report_files.h"
#include "twin/version.h"

namespace thermotwin::twin {
namespace {

namespace fs = std::filesystem;

/// Of the clock that file systems stamp with.
constexpr std::chrono::milliseconds longest_tick(20);

/// Where the newer of a data set and its unfinished successor lies; empty: neither is there.
fs::path newest(fs::path const& path) {
  std::error_code ignored;
  auto const partial = output::partial_of(path);
  bool const here = fs::exists(path, ignored), begun = fs::exists(partial, ignored);
  if (here && begun) return fs::last_write_time(partial, ignored) > fs::last_write_time(path, ignored) ? partial : path;
  return here ? path : begun ? partial : fs::path();
}

/// Progress first, then answers, then data sets, each by name.
LivePage::Paths files_of(fs::path const& folder) {
  LivePage::Paths answers, data;
  std::error_code ignored;
  for (auto const& entry : fs::directory_iterator(folder, ignored)) {
    auto const& path = entry.path();
    if (path.extension() == ".json") answers.push_back(path);
    if (path.extension() == ".h5") data.push_back(newest(path));
    if (path.extension() == ".partial" && !fs::exists(fs::path(path).replace_extension(), ignored))
      data.push_back(path);
  }
  std::sort(data.begin(), data.end());
  std::sort(answers.begin(), answers.end(), [](auto const& a, auto const& b) {
    return std::pair(a.filename() != progress_file, a) < std::pair(b.filename() != progress_file, b);
  });
  answers.insert(answers.end(), data.begin(), data.end());
  return answers;
}

/// InputError for what can never be shown, however long one waits.
void refuse_never(fs::path const& path) {
  static std::set<std::string> const shown = {".h5", ".partial", ".csv", ".toml", ".json"};
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) return;
  if (auto const folder = path.parent_path(); !folder.empty() && !fs::is_directory(folder, ignored))
    throw thermal::InputError(fmt::format("{}: there is no folder {}", path.string(), folder.string()));
  bool const may_become_folder = path.extension().empty() && !fs::exists(path, ignored);
  if (!may_become_folder && !shown.contains(path.extension().string()))
    throw thermal::InputError(
        fmt::format("{} is neither a data set (.h5, .csv, .toml) nor an answer (.json) nor a folder", path.string()));
}

struct Found {
  LivePage::Paths files, missing;

  /// Everything that a page of it rests on.
  [[nodiscard]] LivePage::Paths stamped() const {
    LivePage::Paths all;
    for (auto const& path : files)
      if (is_campaign(path))
        for (auto const& inside : campaign_files(path)) all.push_back(inside);
      else
        all.push_back(path);
    return all;
  }
};

Found look(LivePage::Paths const& watched) {
  Found found;
  std::error_code ignored;
  for (auto const& path : watched) {
    if (is_campaign(path)) {
      found.files.push_back(path);
      continue;
    }
    auto const here = fs::is_directory(path, ignored) ? files_of(path) : LivePage::Paths{newest(path)};
    for (auto const& file : here)
      if (!file.empty()) found.files.push_back(file);
    if (here.empty() || here.front().empty()) found.missing.push_back(path);
  }
  return found;
}

output::Json notice(std::string const& text) {
  return {{"title", text}, {"steps", output::Json::array()}, {"done", false}};
}

/// InputError when one of them cannot be read.
output::ReportPage built_page(Found const& found, fs::path const& machine) {
  auto page = build_report({found.files, machine, {}}).page;
  if (found.files.empty()) page.set_title("Waiting");
  for (auto const& path : found.missing)
    page.add_section("progress", notice(fmt::format("Nothing is in {} yet.", path.string())));
  return page;
}

output::ReportPage page_of(Found const& found, fs::path const& machine) {
  try {
    return built_page(found, machine);
  } catch (thermal::InputError const& error) {
    output::ReportPage waiting("Waiting", fmt::format("ThermoTwin {} ({})", version(), commit()));
    waiting.add_section("progress", notice(error.what()));
    return waiting;
  }
}

}  // namespace

LivePage::LivePage(Paths watched, fs::path machine) : watched_(std::move(watched)), machine_(std::move(machine)) {
  for (auto const& path : watched_) refuse_never(path);
}

void LivePage::renew() {
  auto const found = look(watched_);
  auto const now = fs::file_time_type::clock::now();
  Stamp stamp;
  std::error_code ignored;
  for (auto const& file : found.stamped()) {
    stamp.push_back({file.string(), {fs::last_write_time(file, ignored), fs::file_size(file, ignored)}});
    if (file.filename() == progress_file && !ProgressFile::is_running(fs::absolute(file).parent_path()))
      stamp.back().first += ", left alone";
  }
  if (revision_ > 0 && settled_ && stamp == stamp_) return;
  settled_ =
      std::all_of(stamp.begin(), stamp.end(), [&](auto const& file) { return file.second.first < now - longest_tick; });
  stamp_ = std::move(stamp);
  auto page = page_of(found, machine_);
  if (auto shown = page.news(); revision_ == 0 || shown != shown_)
    shown_ = std::move(shown);
  else
    return;
  page.set_revision(++revision_);
  html_ = page.html();
  news_ = page.news();
}

std::string LivePage::html() {
  std::scoped_lock const lock(asked_);
  renew();
  return html_;
}

std::optional<std::string> LivePage::news(std::uint64_t after) {
  std::scoped_lock const lock(asked_);
  renew();
  if (after == revision_) return {};
  return news_;
}

}  // namespace thermotwin::twin
