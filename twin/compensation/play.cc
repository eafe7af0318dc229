#include "twin/compensation/play.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "thermal/error.h"

namespace thermotwin::twin {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::duration;

Clock::time_point after(Clock::time_point start, double seconds) {
  return start + std::chrono::duration_cast<Clock::duration>(duration<double>(seconds));
}

class Player {
 public:
  Player(VirtualMachine machine, std::string const& axis, PlayOptions& options)
      : machine_(std::move(machine)),
        options_(options),
        offset_topic_(options.topics.offset(axis)),
        status_topic_(options.topics.status("compensate-" + axis)),
        report_topic_(options.topics.report(axis)),
        broker_(options.broker, {offset_topic_, status_topic_, report_topic_}) {}

  PlayedRun run(std::atomic<bool> const& stop);

 private:
  void await_compensation(std::atomic<bool> const& stop);
  void listen(Clock::time_point until, std::atomic<bool> const& stop);
  void check_channel(std::string const& report) const;

  VirtualMachine machine_;
  PlayOptions& options_;
  std::string offset_topic_, status_topic_, report_topic_;
  Broker broker_;
  bool online_ = false;
};

void Player::listen(Clock::time_point until, std::atomic<bool> const& stop) {
  while (!stop) {
    auto const message = broker_.receive(std::min(until, after(Clock::now(), 0.1)));
    if (message && message->topic == status_topic_)
      online_ = message->payload == "online";
    else if (message && message->topic == report_topic_)
      check_channel(message->payload);
    else if (message)
      machine_.take(message->payload);
    else if (Clock::now() >= until)
      return;
  }
}

/// Offsets against one displacement are not judged by another.
void Player::check_channel(std::string const& report) const {
  auto const read = nlohmann::json::parse(report, nullptr, false);
  if (!read.is_object() || !read.contains("channel") || !read["channel"].is_string()) return;
  auto const works_against = read["channel"].get<std::string>();
  auto const& [channel, axis, limits, fallback] = machine_.settings();
  if (works_against != channel)
    throw thermal::InputError(
        fmt::format("axis {} is compensated against {}, and this run is judged by {}; give both "
                    "the same --channel",
                    axis, works_against, channel));
}

void Player::await_compensation(std::atomic<bool> const& stop) {
  auto const end = after(Clock::now(), options_.patience);
  while (!online_ && !stop && Clock::now() < end) listen(after(Clock::now(), 0.02), stop);
  if (!online_ && options_.say) options_.say("nobody compensates this axis; the run is played all the same");
}

PlayedRun Player::run(std::atomic<bool> const& stop) {
  await_compensation(stop);
  auto const start = Clock::now();
  double const first = machine_.time(0), last = machine_.time(machine_.rows() - 1);
  for (std::size_t row = 0; row < machine_.rows() && !stop; ++row) {
    double const due = machine_.time(row) - first;
    listen(after(start, due / options_.speed), stop);
    for (auto const& [topic, payload] : machine_.begin(row)) broker_.publish(topic, payload);
    if (options_.progress) options_.progress(last > first ? due / (last - first) : 1.0);
  }
  broker_.flush(std::chrono::seconds(5));
  return machine_.played();
}

}  // namespace

PlayedRun play(VirtualMachine machine, std::string const& axis, PlayOptions options, std::atomic<bool> const& stop) {
  if (!(options.speed > 0))
    throw thermal::InputError(fmt::format("a speed of {:g}: it must be positive", options.speed));
  return Player(std::move(machine), axis, options).run(stop);
}

std::string played_text(PlayedRun const& run) {
  std::string text = fmt::format(
      "               largest       RMS\n"
      "uncompensated {:8.2f}  {:8.2f}  um\n"
      "compensated   {:8.2f}  {:8.2f}  um\n"
      "at the worst instant {:.2f} um worse than without; {} offsets applied",
      run.largest_error(), run.rms_error(), run.largest_residual(), run.rms_residual(), run.worst_excess(),
      run.accepted);
  if (run.refused > 0) text += fmt::format(", {} refused", run.refused);
  if (auto const rows = run.unmeasured(); rows > 0)
    text += fmt::format("\n{} of {} rows are left out: no value of the error", rows, run.time.size());
  return text + "\n";
}

}  // namespace thermotwin::twin
