#include "twin/campaign/run_campaign.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <omp.h>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "output/atomic_file.h"
#include "output/campaign_file.h"
#include "output/checksum.h"
#include "output/csv.h"
#include "output/dataset_file.h"
#include "output/locked_file.h"
#include "thermal/error.h"
#include "thermal/modal_integration.h"
#include "twin/campaign/campaign_form.h"
#include "twin/campaign/campaign_parts.h"
#include "twin/file/text_file.h"
#include "twin/reduced_twin.h"
#include "twin/reduction_store.h"
#include "twin/replay.h"
#include "twin/run.h"
#include "twin/version.h"

namespace thermotwin::twin {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::string checksum(std::string const& text) { return fmt::format("CRC-32 {:08x}", output::crc_32(text)); }

/// What the results are made of, by name; of long files the checksum. Experiments by their place in the campaign, too:
/// files in two folders may have one name.
std::map<std::string, std::string> sources_of(Campaign const& campaign) {
  std::map<std::string, std::string> texts = {
      {"campaign.file", campaign.text},          {"machine.file", campaign.machine_text},
      {"runs", std::to_string(campaign.runs())}, {"runs_per_part", std::to_string(campaign.runs_per_part())},
      {"version", std::string(version())},       {"commit", std::string(commit())}};
  Value const machine = campaign.machine(campaign.nominal(0));
  for (std::size_t i = 0; i < campaign.experiments.size(); ++i) {
    auto const& experiment = campaign.experiments[i];
    auto const name = fmt::format("experiment.{}.{}", i, experiment.name);
    for (auto const& [key, text] : origin(campaign.machine_file, machine, experiment.file, "", experiment.nominal))
      if (key == "experiment.file")
        texts[name] = text;
      else if (key.starts_with("recorded."))
        texts[name + "." + key] = checksum(text);
      else if (key == "machine.weights")
        texts[key] = checksum(text);
  }
  return texts;
}

/// OutputError for a folder of others: without a manifest, and with more in it than what stands beside one that another
/// process is about to write.
void refuse_foreign_folder(fs::path const& folder) {
  if (!fs::is_directory(folder)) return;
  bool const ours = std::all_of(fs::directory_iterator(folder), {}, [](auto const& entry) {
    auto const name = entry.path().filename().string();
    return name == "parts" || name == "lock" || name.starts_with("manifest.json");
  });
  if (!ours && !fs::exists(folder / "manifest.json")) output::require_empty(folder);
}

/// False without a manifest; InputError when there is that of another campaign, or of something else.
bool holds(fs::path const& folder, std::map<std::string, std::string> const& sources) {
  auto const path = folder / "manifest.json";
  if (!fs::exists(path)) return false;
  auto const there = nlohmann::json::parse(text_of_file(path), nullptr, false);
  if (!there.is_object() || !there.contains("campaign.file"))
    throw thermal::InputError(fmt::format("'{}' is not that of a campaign; name another folder", path.string()));
  for (auto const& [key, text] : sources)
    if (!there.contains(key) || there.at(key) != text)
      throw thermal::InputError(
          fmt::format("'{}' holds another campaign: '{}' is not the same; name another folder, or delete it",
                      folder.string(), key));
  return true;
}

/// InputError when something else has its name.
bool has_index(Campaign const& campaign, fs::path const& folder) {
  auto const path = folder / "campaign.h5";
  if (!fs::exists(path)) return false;
  if (output::provenance_in(path) == sources_of(campaign)) return true;
  throw thermal::InputError(fmt::format(
      "'{}' is not what this campaign makes of its runs; move it, and the same command makes it anew", path.string()));
}

/// The folder is this campaign's, or becomes it. Nothing is made in that of another one.
void claim(Campaign const& campaign, fs::path const& folder) {
  refuse_foreign_folder(folder);
  auto const sources = sources_of(campaign);  // others need not wait for it
  static_cast<void>(holds(folder, sources));
  output::make_directory(folder / "parts");
  output::LockedFile const lock(folder / "lock", output::LockedFile::Busy::wait);
  if (holds(folder, sources)) return;
  auto const path = folder / "manifest.json";
  output::remove_leftovers(path);
  output::write_atomically(path, nlohmann::ordered_json(sources).dump(2) + "\n");
}

/// Settings of the machine, not of the experiment.
std::vector<Setting> machine_settings(CampaignRun const& order) {
  std::vector<Setting> settings;
  for (auto const& setting : order.settings)
    if (!setting.of_experiment()) settings.push_back(setting);
  return settings;
}

/// The nominal machine through a reduced model, for all threads.
struct ReducedMachine {
  explicit ReducedMachine(Campaign const& campaign)
      : machine(Machine::build(campaign.machine(campaign.nominal(0)))), twin(machine, {}, cache_folder()) {}

  Machine machine;
  ReducedTwin twin;
};

/// Makes runs one by one, and keeps the machine while it stays the same.
class RunMaker {
 public:
  RunMaker(Campaign const& campaign, CampaignForm const& form, ReducedMachine const* reduced,
           std::atomic<bool> const* stop)
      : campaign_(campaign), form_(form), reduced_(reduced) {
    options_.integration.relative_tolerance = campaign.description.tolerance;
    options_.integration.absolute_tolerance = campaign.description.tolerance;
    options_.in_modes = campaign.description.model == "modes";
    options_.stop = stop;
  }

  CampaignResult operator()(std::int64_t number) {
    CampaignResult result;
    result.number = number;
    try {
      auto const order = campaign_.run(number);
      if (reduced_) {
        auto const seen = reduced_->twin.run(campaign_.experiment(order));
        result.numbers = form_.kept(seen);
        result.rows = std::int64_t(seen.dataset.time_s.size());
        return result;
      }
      set_machine(order);
      auto const dataset = run(*machine_, campaign_.experiment(order), options_).dataset;
      result.numbers = form_.kept(dataset);
      result.rows = std::int64_t(dataset.time_s.size());
    } catch (Interrupted const&) {
      throw;
    } catch (std::bad_alloc const&) {
      throw;
    } catch (std::exception const& error) {
      result.numbers.clear();
      result.failure = error.what();
    }
    return result;
  }

 private:
  void set_machine(CampaignRun const& order) {
    auto settings = machine_settings(order);
    if (machine_ && settings == settings_) return;
    machine_.reset();
    machine_ = std::make_unique<Machine const>(Machine::build(campaign_.machine(order)));
    settings_ = std::move(settings);
  }

  Campaign const& campaign_;
  CampaignForm const& form_;
  ReducedMachine const* reduced_;
  RunOptions options_;
  std::unique_ptr<Machine const> machine_;
  std::vector<Setting> settings_;
};

/// The first exception of any thread stops all of them.
class Stopper {
 public:
  explicit Stopper(std::atomic<bool> const* outside) : outside_(outside) {}

  [[nodiscard]] bool stopped() const { return failed_ || (outside_ && *outside_); }
  void take(std::exception_ptr const& exception) {
    if (!failed_.exchange(true)) first_ = exception;
  }
  void rethrow() const {
    if (outside_ && *outside_) throw Interrupted("stopped; the same command goes on from here");
    if (first_) std::rethrow_exception(first_);
  }

 private:
  std::atomic<bool> const* outside_;
  std::atomic<bool> failed_ = false;
  std::exception_ptr first_;
};

/// A field of a CSV file: all in one line.
std::string in_one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return output::csv_field(text);
}

}  // namespace

CampaignReport run_campaign(Campaign const& campaign, CampaignOptions const& options) {
  auto const nominal = Machine::build(campaign.machine(campaign.nominal(0)));
  if (campaign.description.model == "modes") thermal::check_modes(nominal.network());
  claim(campaign, options.folder);
  static_cast<void>(has_index(campaign, options.folder));
  CampaignForm const form(campaign, nominal);
  CampaignParts parts(campaign, form, options.folder, options.share);
  std::optional<ReducedMachine> reduced;
  if (campaign.description.model == "reduced") reduced.emplace(campaign);
  Stopper stopper(options.stop);
  CampaignReport report;
  auto const start = Clock::now();
#pragma omp parallel
  {
#pragma omp single
    report.threads = omp_get_num_threads();
    RunMaker make(campaign, form, reduced ? &*reduced : nullptr, options.stop);
    double in_runs = 0.0;
    std::int64_t made = 0;
    try {
      while (!stopper.stopped()) {
        auto const number = parts.next();
        if (!number) break;
        auto const begin = Clock::now();
        auto const result = make(*number);
        in_runs += seconds_since(begin);
        parts.put(result);
        ++made;
        if (options.progress && omp_get_thread_num() == 0)
          options.progress(double(parts.done()) / double(parts.runs()));
      }
    } catch (...) {
      stopper.take(std::current_exception());
    }
#pragma omp critical(thermotwin_campaign)
    {
      report.made += made;
      report.run_seconds += in_runs;
    }
  }
  report.seconds = seconds_since(start);
  stopper.rethrow();
  return report;
}

bool finish_campaign(Campaign const& campaign, fs::path const& folder) {
  if (!fs::exists(folder / "manifest.json")) return false;
  if (has_index(campaign, folder)) return true;
  output::LockedFile const lock(folder / "lock", output::LockedFile::Busy::wait);
  std::vector<output::CampaignPartFile> parts;
  for (std::int64_t part = 0; part < campaign.parts(); ++part) {
    auto const first = part * campaign.runs_per_part();
    parts.push_back({part_file(part).string(), first, std::min(campaign.runs_per_part(), campaign.runs() - first)});
    if (!fs::exists(folder / parts.back().file)) return false;
  }
  if (has_index(campaign, folder)) return true;
  for (auto const* name : {"failures.csv", "campaign.h5"}) output::remove_leftovers(folder / name);
  std::string failures = "run,reason\n";
  for (auto const& part : parts)
    for (auto const& [run, reason] : output::read_failures(folder / part.file))
      failures += fmt::format("{},{}\n", run, in_one_line(reason));
  output::write_atomically(folder / "failures.csv", failures);
  CampaignForm const form(campaign, Machine::build(campaign.machine(campaign.nominal(0))));
  auto layout = form.layout();
  layout.provenance = sources_of(campaign);
  output::write_index(layout, parts, folder / "campaign.h5");
  return true;
}

std::int64_t failed_runs(fs::path const& folder) {
  auto const text = text_of_file(folder / "failures.csv");
  return std::count(text.begin(), text.end(), '\n') - 1;
}

}  // namespace thermotwin::twin
