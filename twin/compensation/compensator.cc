#include "twin/compensation/compensator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "thermal/nearest_name.h"

namespace thermotwin::twin {
namespace {

constexpr double later = 1e-6;  ///< that a reading may be [s]

std::string unknown_input(std::string const& name, std::vector<ModelInput> const& inputs) {
  std::vector<std::string> known;
  for (auto const& input : inputs) known.push_back(input.name);
  return fmt::format("the model has no input '{}'; {}", name, thermal::did_you_mean(name, known));
}

bool runs_a_twin(LiveModel const& model) {
  auto const* mean = std::get_if<MeanModel>(&model);
  return std::holds_alternative<TwinObserver>(model) || (mean && mean->runs_a_twin());
}

}  // namespace

std::string_view name_of(Support support) {
  constexpr std::array<std::string_view, 5> names{"waiting", "good", "held", "fading", "off"};
  return names[std::size_t(support)];
}

Compensator::Compensator(LiveModel model, CompensationSettings const& settings)
    : model_(std::move(model)), settings_(settings), shift_(settings.shift) {
  if (runs_a_twin(model_)) fresh_ = model_;
  for (auto const& input : inputs())
    watches_.emplace_back(input.sensor ? settings.watch : WatchSettings::for_inputs(settings.watch.stale_time));
}

std::vector<ModelInput> const& Compensator::inputs() const {
  return std::visit(
      [](auto const& model) -> auto const& { return model.inputs(); }, model_);
}

std::vector<std::string> Compensator::unread() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < watches_.size(); ++i)
    if (!watches_[i].ever_read()) names.push_back(inputs()[i].name);
  return names;
}

void Compensator::take(Reading const& reading, double time, Decision& decision) {
  auto const refuse = [&](std::string sentence) { decision.refused.push_back(std::move(sentence)); };
  auto const& known = inputs();
  auto const it = std::find_if(known.begin(), known.end(), [&](auto const& i) { return i.name == reading.name; });
  if (it == known.end()) return refuse(unknown_input(reading.name, known));
  if (reading.unit != it->unit)
    return refuse(fmt::format("{} comes in '{}'; the model wants '{}'", it->name, reading.unit, it->unit));
  if (!(reading.time <= time + later)) return refuse(fmt::format("{} comes from the future", it->name));
  bool const usable = reading.quality == "good" && std::isfinite(reading.value);
  double const value = usable ? reading.value : std::numeric_limits<double>::quiet_NaN();
  if (!watches_[std::size_t(it - known.begin())].take(value, reading.time))
    refuse(fmt::format("{} repeats a time or goes back in it", it->name));
}

void Compensator::find_faults(double time, Decision& decision) {
  for (std::size_t i = 0; i < watches_.size(); ++i)
    if (auto const fault = watches_[i].fault(time); fault != SensorFault::none)
      decision.faults[inputs()[i].name] = fault;
}

/// Whether what the model knows is older than an input is believed and an offset lasts without it.
bool Compensator::outlived(double time) const {
  return asked_ && time - *asked_ > settings_.watch.stale_time + settings_.fallback.hold + settings_.fallback.fade;
}

double Compensator::estimate(double time) {
  asked_ = time;
  std::vector<double> values;
  for (auto const& watch : watches_)
    values.push_back(watch.fault(time) == SensorFault::none ? watch.value() : std::numeric_limits<double>::quiet_NaN());
  return std::visit([&](auto& model) { return model.error(time, values); }, model_);
}

/// The twin itself was fitted to no range of readings.
std::map<std::string, std::string> Compensator::extrapolated() const {
  if (auto const* saved = std::get_if<SavedModel>(&model_)) return saved->extrapolated();
  if (auto const* mean = std::get_if<MeanModel>(&model_)) return mean->extrapolated();
  return {};
}

std::optional<TwinObserver::WarmBegin> Compensator::warm_begin() const {
  if (auto const* observer = std::get_if<TwinObserver>(&model_)) return observer->warm_begin();
  if (auto const* mean = std::get_if<MeanModel>(&model_)) return mean->warm_begin();
  return {};
}

/// The target of before that time is the one to hold.
void Compensator::fail_since(double since) {
  failed_ = true;
  while (good_targets_.size() > 1 && good_targets_.back().time > since) good_targets_.pop_back();
  held_ = {since, good_targets_.empty() ? 0.0 : good_targets_.back().value};
}

double Compensator::fallen_back(double time, Decision& decision) const {
  double const share = settings_.fallback.share(time - held_.time);
  decision.support = share == 1.0 ? Support::held : share > 0.0 ? Support::fading : Support::off;
  return share * held_.value;
}

/// Since when an input that the model needs has not been believed.
std::optional<double> Compensator::failing_since(double time) const {
  std::optional<double> since;
  for (std::size_t i = 0; i < watches_.size(); ++i)
    if (inputs()[i].required && watches_[i].fault(time) != SensorFault::none)
      since = std::min(since.value_or(time), watches_[i].fault_since(time));
  return since;
}

double Compensator::supported_target(double time, Decision& decision) {
  auto const since = failing_since(time);
  if (!since && fresh_ && outlived(time)) {
    model_ = *fresh_;
    decision.anew = true;
  }
  bool const begins = !since && (!asked_ || decision.anew);
  double const error = since ? std::numeric_limits<double>::quiet_NaN() : estimate(time);
  if (!std::isfinite(error)) {
    if (!failed_) fail_since(since.value_or(time));
    return fallen_back(time, decision);
  }
  failed_ = false;
  error_ = error;
  good_targets_.push_back({time, -error});
  while (good_targets_.front().time < time - settings_.watch.stuck_time - settings_.watch.stale_time)
    good_targets_.pop_front();
  decision.support = Support::good;
  decision.extrapolated = extrapolated();
  if (begins) decision.warm_begin = warm_begin();
  return -error;
}

Decision Compensator::step(double time, std::span<Reading const> readings, double elapsed) {
  Decision decision{time, shift_.offset(), error_, Support::waiting, {}, {}, {}, false, {}};
  for (auto const& reading : readings) take(reading, time, decision);
  find_faults(time, decision);
  if (!started_ && unread().empty()) started_ = true;
  if (!started_) return decision;
  double const target = supported_target(time, decision);
  decision.error = error_;
  decision.offset = shift_.move_to(target, elapsed);
  return decision;
}

}  // namespace thermotwin::twin
