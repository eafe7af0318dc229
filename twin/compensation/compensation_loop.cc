#include "twin/compensation/compensation_loop.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "thermal/error.h"

namespace thermotwin::twin {
namespace {

constexpr std::size_t most_reasons = 100;
constexpr std::size_t most_pending = 100'000;  ///< between two decisions
constexpr double hesitation = 0.5;  ///< by which processes may be late before that is taken for silence [s, our clock]
constexpr std::size_t most_early = 1000;
constexpr double round_off = 1e-3;      ///< of a cycle
constexpr double furthest_time = 1e11;  ///< so that seconds and their fractions are still numbers [s]

void require(bool holds, char const* what, double value) {
  if (!holds) throw thermal::InputError(fmt::format("{} of {:g}: it must be positive", what, value));
}

}  // namespace

CompensationLoop::CompensationLoop(Compensator compensator, LoopSettings const& settings, Topics const& topics)
    : compensator_(std::move(compensator)),
      settings_(settings),
      clock_(settings.speed, settings.tolerance, compensator_.inputs().size()),
      read_(compensator_.inputs().size(), never),
      newest_(never),
      decided_(never),
      decided_wall_(never),
      due_(never) {
  require(settings.cycle > 0, "a cycle", settings.cycle);
  require(settings.speed > 0, "a speed", settings.speed);
  for (std::size_t i = 0; i < compensator_.inputs().size(); ++i) input_of_[topics.of(compensator_.inputs()[i])] = i;
}

std::vector<std::string> CompensationLoop::topics() const {
  std::vector<std::string> names;
  for (auto const& [topic, input] : input_of_) names.push_back(topic);
  return names;
}

void CompensationLoop::refuse(std::string const& reason) {
  bool const known = refusals_.contains(reason);
  ++refusals_[known || refusals_.size() < most_reasons ? reason : "others"];
}

void CompensationLoop::keep(std::string const& topic, std::string_view payload, double wall) {
  ++messages_;
  auto const input = input_of_.find(topic);
  if (input == input_of_.end()) return refuse("a topic that was not subscribed to");
  auto const message = read_payload(payload);
  auto const& expected = compensator_.inputs()[input->second].name;
  if (auto const* reason = std::get_if<std::string>(&message)) return refuse(expected + ": " + *reason);
  auto const& reading = std::get<Reading>(message);
  if (reading.name != expected) return refuse(expected + ": another name than its topic's");
  if (!(std::abs(reading.time) <= furthest_time)) return refuse(expected + ": no such time");
  if (reading.time <= read_[input->second]) return refuse("a time that is not newer: sent again, or a clock set back");
  if (pending_.size() >= most_pending || early_.size() >= most_early) return refuse("more messages than can be taken");
  early_.push_back({input->second, clock_.lead(reading.time, wall), reading});
  clock_.hear(input->second, early_.back().lead);
  auto const believed = std::stable_partition(early_.begin(), early_.end(), [&](auto const& message) {
    return !clock_.believes(message.lead) && message.reading.time > newest_;
  });
  for (auto it = believed; it != early_.end(); ++it) admit(*it, wall);
  early_.erase(believed, early_.end());
}

void CompensationLoop::admit(Early& message, double wall) {
  double const time = message.reading.time;
  if (decided_wall_ == never) decided_wall_ = wall;
  if (decided_ == never) due_ = due_ == never ? time : std::min(due_, time);
  if (clock_.believes(message.lead)) clock_.follow(message.lead, wall);
  read_[message.input] = std::max(read_[message.input], time);
  newest_ = std::max(newest_, time);
  pending_.push_back(std::move(message.reading));
}

/// Until when every input that is not at fault has been read, if that is far enough for this cycle.
std::optional<double> CompensationLoop::complete_until(double now) const {
  std::optional<double> until;
  for (std::size_t i = 0; i < read_.size(); ++i) {
    bool const given_up = compensator_.last_time(i) > never && compensator_.fault(i, now) != SensorFault::none;
    if (read_[i] >= due_ - round_off * settings_.cycle)
      until = std::min(until.value_or(read_[i]), read_[i]);
    else if (!given_up)
      return std::nullopt;
  }
  return until;
}

/// `done`: until when this decision has seen the readings; the next one is due at the next cycle.
Decision CompensationLoop::decide(double now, double done, double wall) {
  for (auto const& message : early_) refuse(message.reading.name + ": from the future");
  early_.clear();
  double const elapsed = settings_.speed * std::max(0.0, wall - decided_wall_);
  auto const decision = compensator_.step(now, pending_, elapsed);
  for (auto const& sentence : decision.refused) refuse(sentence);
  pending_.clear();
  decided_ = now;
  decided_wall_ = std::max(decided_wall_, wall);
  due_ += settings_.cycle * (1.0 + std::floor(std::max(0.0, done - due_) / settings_.cycle + round_off));
  return decision;
}

std::optional<Decision> CompensationLoop::take(std::string const& topic, std::string_view payload, double wall) {
  keep(topic, payload, wall);
  if (newest_ <= decided_) return std::nullopt;
  if (auto const until = complete_until(newest_)) return decide(newest_, *until, wall);
  if (newest_ < due_ + settings_.cycle + std::max(settings_.tolerance, settings_.cycle)) return std::nullopt;
  return decide(newest_, newest_ - settings_.cycle, wall);
}

std::optional<Decision> CompensationLoop::idle(double wall) {
  if (!clock_.started()) return std::nullopt;
  double const now = std::max(newest_, clock_.now(wall) - hesitation * settings_.speed);
  if (now <= decided_) return std::nullopt;
  if (auto const until = complete_until(newest_)) return decide(now, *until, wall);
  if (now < due_ + 2.0 * settings_.cycle) return std::nullopt;
  return decide(now, now - settings_.cycle, wall);
}

/// As long as most senders are silent nothing of the others is believed: only the silent ones are to be named.
std::vector<std::string> CompensationLoop::unread() const {
  if (clock_.started()) return compensator_.unread();
  std::vector<std::string> names;
  for (std::size_t i = 0; i < read_.size(); ++i)
    if (!clock_.heard(i)) names.push_back(compensator_.inputs()[i].name);
  return names;
}

void CompensationLoop::require_inputs(double waited) const {
  auto const names = unread();
  if (names.empty() || waited < settings_.start_time) return;
  throw thermal::InputError(fmt::format("no reading of {} within {:g} s; the model needs every one of its inputs",
                                        fmt::join(names, ", "), settings_.start_time));
}

}  // namespace thermotwin::twin
