// 50 sensors at 100 Hz through a real broker, which is killed and restarted: what gets lost, and how long decisions
// take.
#include <algorithm>
#include <benchmark/benchmark.h>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <set>
#include <thread>

#include "tests/end_to_end/broker_process.h"
#include "tests/output/temporary_directory.h"
#include "twin/compensation/broker.h"
#include "twin/compensation/compensate.h"

namespace thermotwin {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr int sensors = 50;
constexpr auto period = 10ms;

std::string name_of_sensor(int sensor) { return "T" + std::to_string(sensor + 1); }

twin::Compensator compensator() {
  models::LinearForm form;
  form.coefficients = Eigen::VectorXd::Constant(sensors, 0.5);
  models::ErrorModel model{"linear", {}, 0.0, 1.0, form, ""};
  for (int s = 0; s < sensors; ++s) model.inputs.push_back(name_of_sensor(s));
  twin::CompensationSettings settings;
  settings.watch.stale_time = 30.0;
  return {twin::SavedModel(model), settings};
}

/// The machine's side: 50 readings every 10 ms, each with its own time.
void publish_readings(twin::Broker& broker, int rows) {
  twin::Topics const topics;
  auto const start = Clock::now();
  for (int row = 0; row < rows; ++row) {
    std::this_thread::sleep_until(start + row * period);
    double const time = std::chrono::duration<double>(row * period).count();
    for (int s = 0; s < sensors; ++s) {
      double const value = 20.0 + 1e-3 * time + 1e-3 * double((row + s) % 7);
      broker.publish(topics.of({name_of_sensor(s), "degC"}),
                     twin::payload_of({name_of_sensor(s), value, "degC", time, "good"}));
    }
  }
}

/// Counts what arrives at another listener, so that nothing but the broker and the client is in question.
std::size_t distinct_messages(twin::Broker& broker, std::atomic<bool> const& done) {
  std::set<std::pair<std::string, long>> seen;
  auto last = Clock::now();
  while (!done || Clock::now() < last + 10s) {
    auto const message = broker.receive(Clock::now() + 100ms);
    if (!message) continue;
    last = Clock::now();
    if (auto const reading = twin::read_payload(message->payload); std::holds_alternative<twin::Reading>(reading))
      seen.emplace(message->topic, std::lround(1e3 * std::get<twin::Reading>(reading).time));
  }
  return seen.size();
}

void BM_FiftySensorsAtHundredHertz(benchmark::State& state) {
  auto const rows = int(state.range(0)) * 100;
  tests::TemporaryDirectory const directory;
  tests::BrokerProcess process(directory.path().string());
  for (auto _ : state) {
    std::atomic<bool> stop = false, published = false;
    twin::CompensateOptions options;
    options.broker.url = process.url();
    options.broker.client = "compensation";
    options.loop = {1e-3 * double(period.count()), 1.0, 15.0, 60.0};
    twin::CompensationSummary summary;
    std::thread compensation([&] { summary = twin::compensate(compensator(), options, stop); });
    twin::Topics const topics;
    std::vector<std::string> all;
    for (int s = 0; s < sensors; ++s) all.push_back(topics.of({name_of_sensor(s), "degC"}));
    twin::BrokerOptions listening = options.broker, sending = options.broker;
    listening.client = "listener";
    sending.client = "machine";
    std::size_t arrived = 0;
    twin::Broker listener(listening, all);
    std::thread listen([&] { arrived = distinct_messages(listener, published); });
    twin::Broker sender(sending, {});
    std::this_thread::sleep_for(2s);
    std::thread killer([&] {
      std::this_thread::sleep_for(rows / 2 * period);
      process.kill();
      std::this_thread::sleep_for(2s);
      process.start();
    });
    publish_readings(sender, rows);
    killer.join();
    sender.flush(30s);
    published = true;
    listen.join();
    stop = true;
    compensation.join();
    state.counters["lost"] = double(rows) * sensors - double(arrived);
    state.counters["messages"] = double(summary.messages);
    state.counters["decisions"] = double(summary.decisions);
    state.counters["reconnections"] = summary.reconnections;
    state.counters["median_ms"] = 1e3 * summary.latency.quantile(0.5);
    state.counters["p99_ms"] = 1e3 * summary.latency.quantile(0.99);
  }
}
// Seconds; 600 for the ten minutes of the issue: --benchmark_filter=Fifty.*600
BENCHMARK(BM_FiftySensorsAtHundredHertz)->Arg(20)->Arg(60)->Arg(600)->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace thermotwin
