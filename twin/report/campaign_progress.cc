#include "twin/report/campaign_progress.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string>

#include "output/journal.h"
#include "thermal/error.h"
#include "twin/campaign/run_campaign.h"
#include "twin/file/text_file.h"

namespace thermotwin::twin {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t parts_shown = 8;
constexpr std::size_t part_digits = 6;  // of part_file

struct Moment {
  fs::path const& manifest;

  [[nodiscard]] double operator()(fs::path const& file) const {
    std::error_code gone;
    auto const then = fs::last_write_time(file, gone), start = fs::last_write_time(manifest, gone);
    return gone ? 0.0 : std::max(0.0, std::chrono::duration<double>(then - start).count());
  }
};

bool is_part(fs::path const& file) {
  auto const name = file.stem().string();
  return (file.extension() == ".h5" || file.extension() == ".journal") && name.size() == part_digits &&
         name.find_first_not_of("0123456789") == std::string::npos;
}

output::Json read_manifest(fs::path const& file) {
  auto manifest = output::Json::parse(text_of_file(file), nullptr, false);
  for (char const* key : {"runs", "runs_per_part"})
    if (!manifest.is_object() || !manifest.contains(key))
      throw thermal::InputError(fmt::format("{}: no campaign's manifest: it does not say '{}'", file.string(), key));
  return manifest;
}

/// Of the manifest.
struct Size {
  std::int64_t runs = 0, per_part = 0;
};

Size size_of(fs::path const& manifest_file) {
  auto const manifest = read_manifest(manifest_file);
  auto const number = [&](char const* key) { return std::stoll(manifest.at(key).get<std::string>()); };
  return {number("runs"), number("runs_per_part")};
}

std::vector<WholePart> parts_among(std::vector<fs::path> const& files) {
  auto const [runs, per_part] = size_of(files.front());
  std::vector<WholePart> parts;
  for (auto const& file : files) {
    if (file.parent_path().filename() != "parts" || file.extension() != ".h5") continue;
    std::int64_t const number = std::stoll(file.stem().string());
    parts.push_back({file, number, number * per_part, std::min(runs, (number + 1) * per_part) - 1});
  }
  return parts;
}

output::Json step(std::string const& what, double at_s) { return {{"what", what}, {"at_s", at_s}}; }

}  // namespace

bool is_campaign(fs::path const& folder) {
  std::error_code ignored;
  return fs::is_regular_file(folder / "manifest.json", ignored) && fs::is_directory(folder / "parts", ignored);
}

std::vector<fs::path> campaign_files(fs::path const& folder) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (auto const& entry : fs::directory_iterator(folder / "parts", ignored))
    if (is_part(entry.path())) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  files.insert(files.begin(), folder / "manifest.json");
  if (fs::exists(folder / "campaign.h5", ignored)) files.push_back(folder / "campaign.h5");
  return files;
}

std::vector<WholePart> whole_parts(fs::path const& folder) { return parts_among(campaign_files(folder)); }

output::Json campaign_progress(fs::path const& folder) {
  auto const files = campaign_files(folder);
  std::int64_t const runs = size_of(files.front()).runs;
  Moment const moment{files.front()};
  std::vector<output::Json> parts;
  std::int64_t made = 0;
  double last = 0.0;
  for (auto const& file : files) {
    last = std::max(last, moment(file));
    if (file.extension() == ".journal") made += output::Journal::count(file);
  }
  for (auto const& part : parts_among(files)) {
    made += part.last - part.first + 1;
    auto const which = part.first == part.last ? fmt::format("run {}", part.first)
                                               : fmt::format("runs {} to {}", part.first, part.last);
    parts.push_back(step(fmt::format("part {} is whole: {}", part.number, which), moment(part.file)));
  }
  std::sort(parts.begin(), parts.end(), [](auto const& a, auto const& b) { return a["at_s"] < b["at_s"]; });
  if (parts.size() > parts_shown) parts.erase(parts.begin(), parts.end() - parts_shown);
  bool const whole = files.back().filename() == "campaign.h5";
  parts.push_back(step(whole ? fmt::format("{} runs, {} of them failed: campaign.h5", runs, failed_runs(folder))
                             : fmt::format("{} of {} runs are made", made, runs),
                       last));
  parts.back()["share"] = double(made) / double(runs);
  auto const name = fs::weakly_canonical(folder).filename().string();
  return {{"title", fmt::format("Campaign in {}", name)}, {"steps", parts}, {"done", whole}};
}

}  // namespace thermotwin::twin
