#include "twin/compensation/compensate.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <set>

namespace thermotwin::twin {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::duration;

constexpr double shortest = 1e-6;
constexpr double class_width = 0.05;   ///< of a logarithm
constexpr double longest_wait = 0.05;  ///< to notice `stop` [s]

double seconds(Clock::time_point time) { return duration<double>(time.time_since_epoch()).count(); }

nlohmann::json faults_json(Decision const& decision) {
  auto faults = nlohmann::json::object();
  for (auto const& [input, fault] : decision.faults) faults[input] = name_of(fault);
  return faults;
}

std::string report_payload(CompensateOptions const& options, Decision const& decision) {
  return nlohmann::json{{"name", options.axis},
                        {"channel", options.channel},
                        {"time", decision.time},
                        {"support", name_of(decision.support)},
                        {"faults", faults_json(decision)}}
      .dump();
}

std::string report_line(Decision const& decision) {
  std::vector<std::string> faults;
  for (auto const& [input, fault] : decision.faults)
    if (decision.support != Support::waiting || fault != SensorFault::missing)
      faults.push_back(fmt::format("{} {}", input, name_of(fault)));
  return fmt::format("t = {:.0f} s: offset {:g} um, {}{}{}", decision.time, decision.offset, name_of(decision.support),
                     faults.empty() ? "" : "; ", fmt::join(faults, ", "));
}

std::string sentence_of(TwinObserver::WarmBegin const& begin) {
  auto const left_out =
      begin.contradicted.empty()
          ? std::string()
          : fmt::format("; all other sensors contradict {}, which counts from what they say", begin.contradicted);
  return fmt::format(
      "the machine is warm: {} over the air; the displacement that its heat has made by now, and will take back, is "
      "known to ± {:.1f} um (1 sigma){}",
      begin.farthest, begin.deviation, left_out);
}

/// Everything between the broker and the loop.
class Session {
 public:
  Session(Compensator compensator, CompensateOptions& options)
      : options_(options),
        loop_(std::move(compensator), options.loop, options.topics),
        broker_(with_status(options), loop_.topics()) {}

  CompensationSummary run(std::atomic<bool> const& stop);

 private:
  static BrokerOptions with_status(CompensateOptions& options) {
    options.broker.status_topic = options.topics.status("compensate-" + options.axis);
    return options.broker;
  }
  void turn();
  void publish(Decision const& decision);
  void report(Decision const& decision);
  void warn(Decision const& decision);
  void say(std::string const& line) const {
    if (options_.say) options_.say(line);
  }

  CompensateOptions& options_;
  CompensationLoop loop_;
  Broker broker_;
  CompensationSummary summary_;
  Support last_support_ = Support::waiting;
  std::map<std::string, SensorFault> last_faults_;
  std::optional<Clock::time_point> first_message_;
  std::size_t said_refusals_ = 0;
  std::set<std::string> said_extrapolations_;  ///< inputs
};

void Session::publish(Decision const& decision) {
  Reading const offset{options_.axis, decision.offset, "um", decision.time, std::string(name_of(decision.support))};
  if (!broker_.publish(options_.topics.offset(options_.axis), payload_of(offset))) ++summary_.unsent;
  ++summary_.decisions;
}

void Session::report(Decision const& decision) {
  if (decision.support == last_support_ && decision.faults == last_faults_) return;
  last_support_ = decision.support;
  last_faults_ = decision.faults;
  broker_.publish(options_.topics.report(options_.axis), report_payload(options_, decision));
  say(report_line(decision));
}

/// Of each input once.
void Session::warn(Decision const& decision) {
  if (decision.anew)
    say(fmt::format("t = {:.0f} s: after so long a silence the twin begins anew; errors count from now",
                    decision.time));
  if (decision.warm_begin) say(fmt::format("t = {:.0f} s: {}", decision.time, sentence_of(*decision.warm_begin)));
  for (auto const& [input, sentence] : decision.extrapolated)
    if (said_extrapolations_.insert(input).second)
      say(fmt::format("t = {:.0f} s: extrapolation: {}", decision.time, sentence));
}

void Session::turn() {
  double const cycle = options_.loop.cycle / options_.loop.speed;
  auto const wait = duration<double>(std::min(longest_wait, 0.25 * cycle));
  auto const message = broker_.receive(Clock::now() + std::chrono::duration_cast<Clock::duration>(wait));
  if (message && !first_message_) first_message_ = message->arrived;
  auto const decision = message ? loop_.take(message->topic, message->payload, seconds(message->arrived))
                                : loop_.idle(seconds(Clock::now()));
  if (decision) {
    publish(*decision);
    if (message) summary_.latency.add(duration<double>(Clock::now() - message->arrived).count());
    report(*decision);
    warn(*decision);
    if (options_.record) options_.record(*decision, loop_.compensator());
  }
  if (first_message_) loop_.require_inputs(duration<double>(Clock::now() - *first_message_).count());
  if (loop_.refusals().size() > said_refusals_) {
    said_refusals_ = loop_.refusals().size();
    std::vector<std::string> reasons;
    for (auto const& [reason, count] : loop_.refusals()) reasons.push_back(reason);
    say(fmt::format("refused: {}", fmt::join(reasons, "; ")));
  }
}

CompensationSummary Session::run(std::atomic<bool> const& stop) {
  say(fmt::format("{}: waiting for {}", options_.broker.url, fmt::join(loop_.topics(), ", ")));
  while (!stop) turn();
  summary_.messages = loop_.messages();
  summary_.refusals = loop_.refusals();
  summary_.reconnections = broker_.reconnections();
  return summary_;
}

}  // namespace

void LatencyCount::add(double seconds) {
  double const place = std::log(std::max(seconds, shortest) / shortest) / class_width;
  ++counts_[std::size_t(std::min(place, double(classes - 1)))];
  ++count_;
}

double LatencyCount::quantile(double share) const {
  long left = long(std::ceil(share * double(count_)));
  for (std::size_t i = 0; i < counts_.size() && count_ > 0; ++i)
    if ((left -= counts_[i]) <= 0) return shortest * std::exp(class_width * double(i + 1));
  return 0.0;
}

CompensationSummary compensate(Compensator compensator, CompensateOptions options, std::atomic<bool> const& stop) {
  return Session(std::move(compensator), options).run(stop);
}

std::string summary_text(CompensationSummary const& summary) {
  std::string text =
      fmt::format("{} messages, {} decisions; latency {:.2f} ms (median), {:.2f} ms (99 %)\n", summary.messages,
                  summary.decisions, 1e3 * summary.latency.quantile(0.5), 1e3 * summary.latency.quantile(0.99));
  if (summary.reconnections > 0) text += fmt::format("the broker was lost and found {} times\n", summary.reconnections);
  if (summary.unsent > 0) text += fmt::format("{} offsets could not be sent\n", summary.unsent);
  for (auto const& [reason, count] : summary.refusals) text += fmt::format("refused {} x {}\n", count, reason);
  return text;
}

}  // namespace thermotwin::twin
