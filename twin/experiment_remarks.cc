#include "twin/experiment_remarks.h"

#include <algorithm>
#include <fmt/format.h>

#include "scenarios/course.h"
#include "scenarios/recorded.h"
#include "thermal/nearest_name.h"
#include "thermal/units.h"
#include "twin/experiment_file.h"

namespace thermotwin::twin {
namespace {

constexpr double rounding_of_sum = 1e-9;  ///< of durations

/// The channels that every experiment has, and those that the machine asks for.
std::vector<std::string> channels_read(scenarios::Experiment experiment, Machine const& machine) {
  experiment.recorded.clear();
  experiment.inputs.clear();
  experiment.driven.clear();
  scenarios::ExperimentCourse const own(experiment, machine.limits);
  auto const& network = machine.network();
  std::vector<std::string> names(network.channel_names().begin(),
                                 network.channel_names().begin() + network.external_channels());
  for (auto const& channel : own.channels()) names.push_back(channel.name);
  for (auto const& displacement : machine.displacements)
    for (auto const& term : displacement.input_terms) names.push_back(term.channel);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

/// Finds what is odd, each after the path of its field.
class OddityFinder {
 public:
  OddityFinder(scenarios::Experiment const& experiment, Machine const& machine)
      : experiment_(experiment), machine_(machine), read_(channels_read(experiment, machine)) {}

  std::vector<std::string> operator()() {
    look_at_sampling();
    look_at_ends_of_records();
    auto const& recorded = experiment_.recorded;
    for (std::size_t r = 0; r < recorded.size(); ++r)
      for (std::size_t c = 0; c < recorded[r].columns.size(); ++c)
        look_at_channel(fmt::format("recorded[{}].columns[{}].channel", r, c), recorded[r].columns[c].channel);
    for (std::size_t i = 0; i < experiment_.inputs.size(); ++i)
      look_at_channel(fmt::format("inputs[{}].channel", i), experiment_.inputs[i].channel);
    if (auto const& spindle = experiment_.spindle) look_at_blocks("spindle.blocks", spindle->blocks, spindle->cycles);
    for (std::size_t a = 0; a < experiment_.axes.size(); ++a)
      look_at_blocks(fmt::format("axes[{}].blocks", a), experiment_.axes[a].blocks, experiment_.axes[a].cycles);
    return std::move(found_);
  }

 private:
  static std::string text(double seconds) { return thermal::format_quantity(seconds, thermal::dimension::time); }

  void look_at_sampling() {
    double const last = scenarios::sample_times(experiment_).back();
    if (last < experiment_.duration)
      found_.push_back(
          fmt::format("sampling: the last row is at {}, and the run ends at {}; what comes later is left out",
                      text(last), text(experiment_.duration)));
  }

  /// A row stands for as long as it is from the row before.
  void look_at_ends_of_records() {
    auto const driven = scenarios::read_recordings(experiment_.recorded, experiment_.directory, experiment_.duration);
    std::size_t first_column = 0;
    for (std::size_t r = 0; r < experiment_.recorded.size(); ++r) {
      auto const& times = driven[first_column].signal.times();
      double const last = times.back(), row = times.size() > 1 ? last - times[times.size() - 2] : 0.0;
      if (experiment_.duration - last > row * (1.0 + rounding_of_sum))
        found_.push_back(
            fmt::format("recorded[{}].file: it ends at {}, and the run at {}; until then its last values hold", r,
                        text(last), text(experiment_.duration)));
      first_column += experiment_.recorded[r].columns.size();
    }
  }

  void look_at_channel(std::string const& path, std::string const& channel) {
    if (std::binary_search(read_.begin(), read_.end(), channel)) return;
    found_.push_back(fmt::format("{}: nothing on '{}' reads '{}'; {}", path, machine_.name, channel,
                                 thermal::did_you_mean(channel, read_)));
  }

  template <class Block>
  void look_at_blocks(std::string const& path, std::vector<Block> const& blocks, int cycles) {
    double length = 0.0;
    for (auto const& block : blocks) length += cycles * block.duration;
    if (length <= experiment_.duration * (1.0 + rounding_of_sum)) return;
    found_.push_back(fmt::format("{}: they last {} in all, and the run {}; what comes later is left out", path,
                                 text(length), text(experiment_.duration)));
  }

  scenarios::Experiment const& experiment_;
  Machine const& machine_;
  std::vector<std::string> read_;  ///< in order
  std::vector<std::string> found_;
};

}  // namespace

std::vector<std::string> experiment_remarks(Value const& document, scenarios::Experiment const& experiment,
                                            Machine const& machine) {
  auto remarks = OddityFinder(experiment, machine)();
  for (auto& remark : remarks) remark = located_in(document, thermal::InputError(remark)).what();
  return remarks;
}

}  // namespace thermotwin::twin
