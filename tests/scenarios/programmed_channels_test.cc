#include "scenarios/programmed_channels.h"

#include <algorithm>
#include <functional>
#include <gtest/gtest.h>

#include "scenarios/course.h"

namespace thermotwin::scenarios {
namespace {

MachineLimits machine() { return {600.0, {{"x", 0.5, 0.01, 0.0, 0.4}, {"z", 0.5, 0.01, 0.0, 0.6}}}; }

Experiment experiment() {
  Experiment e;
  e.duration = 4 * 3600.0;
  e.spindle.emplace().blocks = {{3600.0, 100.0, {}}};
  e.axes.emplace_back().blocks = {{3600.0, 0.1, {}}};
  e.ambient.daily_cycle.emplace();
  e.ambient.door_openings.emplace_back().time = 600.0;
  return e;
}

/// The values of all channels every ten minutes.
std::vector<double> values(Experiment const& e) {
  ExperimentCourse const course(e, machine());
  std::vector<double> all, now(course.channels().size());
  for (double t = 0.0; t < e.duration; t += 600.0) {
    course.evaluate(t, now);
    all.insert(all.end(), now.begin(), now.end());
  }
  return all;
}

struct Change {
  std::string field;
  std::function<void(Experiment&)> make;
};

/// Equivalence: with the channels replaced, what was changed is as if it had not been.
TEST(ProgrammedChannels, AreAllThroughWhichAFieldActs) {
  std::vector<Change> const changes = {
      {"spindle.blocks.0.speed", [](auto& e) { e.spindle->blocks[0].speed = 200.0; }},
      {"spindle.cycles", [](auto& e) { e.spindle->cycles = 2; }},
      {"axes.0.blocks.0.feed", [](auto& e) { e.axes[0].blocks[0].feed = 0.2; }},
      {"axes.0.cycles", [](auto& e) { e.axes[0].cycles = 2; }},
      {"axes.0.duty", [](auto& e) { e.axes[0].duty = 0.5; }},
      {"axes.0.dwell", [](auto& e) { e.axes[0].dwell = 2.0; }},
      {"ambient.mean", [](auto& e) { e.ambient.mean = 300.0; }},
      {"ambient.drift", [](auto& e) { e.ambient.drift = 1e-4; }},
      {"ambient.daily_cycle.amplitude", [](auto& e) { e.ambient.daily_cycle->amplitude = 3.0; }},
      {"ambient.air_conditioning",
       [](auto& e) {
         e.ambient.air_conditioning = {0.5, 1234.0};
       }},
      {"ambient.door_openings.0.time", [](auto& e) { e.ambient.door_openings[0].time = 3000.0; }},
      {"ambient.stratification", [](auto& e) { e.ambient.stratification = 0.7; }},
      {"ambient.reference_height", [](auto& e) { e.ambient.reference_height = 2.0; }},
      {"coolant.on", [](auto& e) { e.coolant.on = true; }},
      {"coolant.blocks",
       [](auto& e) {
         e.coolant.blocks = {{3600.0, true}};
       }},
      {"coolant.temperature", [](auto& e) { e.coolant.temperature = 300.0; }},
      {"chiller.on", [](auto& e) { e.chiller.on = false; }},
      {"chiller.blocks",
       [](auto& e) {
         e.chiller.blocks = {{3600.0, false}};
       }},
      {"chiller.offset", [](auto& e) { e.chiller.offset = 1.0; }},
      {"power.on", [](auto& e) { e.power.on = false; }},
      {"servo.blocks",
       [](auto& e) {
         e.servo.blocks = {{3600.0, false}};
       }},
  };
  for (auto const& [field, change] : changes) {
    Experiment replaced = experiment(), changed = replaced;
    change(changed);
    auto const channels = programmed_channels(changed, field);
    EXPECT_FALSE(channels.empty()) << field;
    EXPECT_NE(values(changed), values(experiment())) << field;
    ExperimentCourse const course(replaced, machine());
    for (auto const& channel : course.channels())
      if (std::find(channels.begin(), channels.end(), channel.name) != channels.end())
        replaced.driven.push_back({channel, Signal(channel.unit == "K" ? 290.0 : 0.3)});
    changed.driven = replaced.driven;
    EXPECT_EQ(changed.driven.size(), channels.size()) << field;
    EXPECT_TRUE(values(changed) == values(replaced)) << field;
  }
}

TEST(ProgrammedChannels, AreNoneOfWhatActsOtherwise) {
  Experiment e = experiment();
  for (auto const* field : {"duration", "seed", "start_time_of_day", "ambient", "ambient.meant", "laser.axis",
                            "axes.0.stroke_to", "axes.0.resolved", "axes.3.cycles", "axes.z.cycles"})
    EXPECT_TRUE(programmed_channels(e, field).empty()) << field;
  e.axes[0].resolved = true;
  EXPECT_TRUE(programmed_channels(e, "axes.0.cycles").empty());
}

}  // namespace
}  // namespace thermotwin::scenarios
