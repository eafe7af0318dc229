#include "twin/compensation/compensation_loop.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "tests/twin/compensation/closed_loop.h"
#include "thermal/error.h"

namespace thermotwin::twin {
namespace {

using tests::close_loop;
using tests::key_sensors;

constexpr double half_hour = 1800.0;

CompensationSettings settings() {
  CompensationSettings result;
  result.watch.stale_time = 60.0;
  return result;
}

/// The duty of paper 003 on g200, read every 10 s; the model knows another duty only.
class PaperLoop : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    duty_ = new output::Dataset(tests::simulated("duty_003", 10.0));
    duty_->inputs.clear();
    std::erase_if(duty_->readings, [](auto const& channel) {
      return std::find(key_sensors.begin(), key_sensors.end(), channel.name) == key_sensors.end();
    });
    model_ = new models::ErrorModel(tests::fitted(tests::simulated("duty_003_other", 120.0), key_sensors));
  }
  static void TearDownTestSuite() {
    delete duty_;
    delete model_;
  }
  static CompensationLoop loop() { return {Compensator(SavedModel(*model_), settings()), {10.0, 1.0, 30.0, 30.0}}; }
  static VirtualMachine machine() { return {*duty_, {}}; }

  static output::Dataset* duty_;
  static models::ErrorModel* model_;
};
output::Dataset* PaperLoop::duty_ = nullptr;
models::ErrorModel* PaperLoop::model_ = nullptr;

TEST_F(PaperLoop, BringsTheDiameterFrom27ToBelow10) {
  auto compensation = loop();
  auto const played = close_loop(compensation, machine());
  EXPECT_GT(played.largest_error(), 25.0);
  EXPECT_LT(2.0 * played.largest_residual(), 10.0);  // a diameter changes by twice the radial error
  EXPECT_LT(2.0 * played.rms_residual(), 3.0);
  EXPECT_EQ(played.worst_excess(), 0.0);
  EXPECT_TRUE(compensation.refusals().empty());
  EXPECT_NEAR(double(played.accepted), double(duty_->time_s.size()), 1.0);
}

TEST_F(PaperLoop, DecidesOncePerCycleWithEveryReadingOfIt) {
  auto compensation = loop();
  double last = -10.0;
  close_loop(compensation, machine(), {}, [&](Decision const& decision) {
    EXPECT_NEAR(decision.time - last, 10.0, 0.1);
    EXPECT_EQ(decision.support, Support::good);
    last = decision.time;
  });
  EXPECT_NEAR(last, duty_->time_s[duty_->time_s.size() - 1], 0.1);
}

TEST_F(PaperLoop, DecidesForEveryCycleOfABacklog) {
  auto compensation = loop();
  auto source = machine();
  int decisions = 0;
  for (std::size_t row = 0; row < 5; ++row)
    for (auto const& [topic, payload] : source.begin(row))
      decisions += compensation.take(topic, payload, row < 2 ? source.time(row) : 45.0).has_value();
  EXPECT_EQ(decisions, 5);
}

/// The machine played so fast that every delay is long on its clock: the first row comes late, then all of them do, by
/// as much as a sensor may be silent.
TEST_F(PaperLoop, ALateProcessLosesAndRefusesNothing) {
  constexpr double speed = 6000.0;
  CompensationLoop late({SavedModel(*model_), settings()}, {10.0, speed, 30.0, 30.0});
  auto source = machine();
  std::mt19937_64 random(3);
  double wall = 0.0, last_time = -1.0;
  int decisions = 0;
  for (std::size_t row = 0; row < source.rows(); ++row) {
    double const delay = row < 1 || random() % 20 == 0 ? 0.05 : 1e-4;
    wall = std::max(wall, source.time(row) / speed + delay);
    for (auto const& [topic, payload] : source.begin(row)) {
      auto const decision = late.take(topic, payload, wall);
      if (!decision) continue;
      ++decisions;
      EXPECT_TRUE(decision->faults.empty());
      EXPECT_GT(decision->time, last_time);
      last_time = decision->time;
    }
  }
  EXPECT_TRUE(late.refusals().empty());
  EXPECT_GE(decisions, int(source.rows()) - 6);  // those of the first rows may wait for one another
  EXPECT_EQ(last_time, source.time(source.rows() - 1));
}

/// Half a row comes, then the sender is late by as much as 50 min of its own time: no sensor is called silent.
TEST_F(PaperLoop, ALateProcessIsNotSilence) {
  constexpr double speed = 6000.0, late_by = 0.4;
  CompensationLoop loop({SavedModel(*model_), settings()}, {10.0, speed, 30.0, 30.0});
  auto source = machine();
  double wall = 0.0;
  for (std::size_t row = 0; row < 100; ++row) {
    auto const messages = source.begin(row);
    for (std::size_t m = 0; m < messages.size(); ++m) {
      if (row == 50 && m == 2) wall += late_by;
      EXPECT_FALSE(m == 2 && loop.idle(wall));
      auto const decision = loop.take(messages[m].first, messages[m].second, wall);
      EXPECT_TRUE(!decision || decision->faults.empty());
    }
    wall += 10.0 / speed;
  }
  EXPECT_TRUE(loop.refusals().empty());
  auto const silent = loop.idle(wall + 1.0);
  ASSERT_TRUE(silent);
  EXPECT_EQ(silent->faults.size(), key_sensors.size());
}

/// The first two of a row come in time, the others and all later ones 0.05 s after: those two are not from the future.
TEST_F(PaperLoop, WhoIsSoonerThanTheOthersIsNotFromTheFuture) {
  constexpr double speed = 6000.0;
  CompensationLoop loop({SavedModel(*model_), settings()}, {10.0, speed, 30.0, 30.0});
  auto source = machine();
  int decisions = 0;
  for (std::size_t row = 0; row < 100; ++row) {
    auto const messages = source.begin(row);
    for (std::size_t m = 0; m < messages.size(); ++m) {
      double const wall = source.time(row) / speed + (row == 0 && m < 2 ? 0.0 : 0.05);
      decisions += loop.take(messages[m].first, messages[m].second, wall).has_value();
    }
  }
  EXPECT_EQ(decisions, 100);
  EXPECT_TRUE(loop.refusals().empty());
}

TEST_F(PaperLoop, StampsFromTheFutureOfOneSensorAreRefusedAndHarmNothing) {
  auto compensation = loop();
  auto const played =
      close_loop(compensation, machine(), [](double time, std::string const& topic, std::string& payload) {
        if (topic.ends_with("/T4") && time > 600.0) payload = payload_of({"T4", 25.0, "degC", time + 1e6, "good"});
      });
  EXPECT_LE(played.worst_excess(), settings().shift.dead_band);
  EXPECT_GT(compensation.refusals().at("T4: from the future"), 100);
  EXPECT_EQ(compensation.refusals().size(), 1u);
}

/// Each fault of each sensor, from its begin to the end of the duty or for half an hour.
struct FaultCase {
  char const* name;
  SensorFault expected;
  std::function<void(Reading&)> corrupt;  ///< a reading without a name does not arrive
};

std::vector<FaultCase> fault_cases() {
  return {{"stale", SensorFault::stale, [](Reading& r) { r.name.clear(); }},
          {"missing", SensorFault::missing, [](Reading& r) { r.value = std::nan(""); }},
          {"stuck", SensorFault::stuck, {}},
          {"jump", SensorFault::jump, [](Reading& r) { r.value += 2.0; }},
          {"jump down", SensorFault::jump, [](Reading& r) { r.value -= 2.0; }},
          {"out of range", SensorFault::out_of_range, [](Reading& r) { r.value = 850.0; }}};
}

TEST_F(PaperLoop, IsNeverWorseThanNothingByMoreThanTheDeadBandWhateverSensorFails) {
  double const dead_band = settings().shift.dead_band;
  for (auto const& fault : fault_cases()) {
    double worst = 0.0;
    for (auto const& sensor : key_sensors)
      for (double const begin : {0.0, 600.0, 3000.0, 7000.0})
        for (double const length : {half_hour, 1e9}) {
          if (begin == 0.0 && fault.expected != SensorFault::stuck) continue;  // that is a run without the sensor
          auto compensation = loop();
          std::optional<double> frozen;
          bool seen = false;
          auto const played = close_loop(
              compensation, machine(),
              [&](double time, std::string const& topic, std::string& payload) {
                if (!topic.ends_with("/" + sensor) || time < begin || time > begin + length) return;
                auto reading = std::get<Reading>(read_payload(payload));
                if (!frozen) frozen = reading.value;
                if (fault.corrupt)
                  fault.corrupt(reading);
                else
                  reading.value = *frozen;
                payload = reading.name.empty() ? "" : payload_of(reading);
              },
              [&](Decision const& d) {
                auto const found = d.faults.find(sensor);
                seen = seen || (found != d.faults.end() && found->second == fault.expected);
              });
          EXPECT_TRUE(seen) << fault.name << " of " << sensor << " at " << begin << " s was not reported";
          EXPECT_LE(played.worst_excess(), dead_band)
              << fault.name << " of " << sensor << " at " << begin << " s for " << length << " s";
          worst = std::max(worst, played.worst_excess());
        }
    RecordProperty(fault.name, std::to_string(worst) + " um");
  }
}

TEST_F(PaperLoop, FadesWhenEverySensorIsSilent) {
  auto compensation = loop();
  double last_offset = 0.0;
  Support last = Support::waiting;
  auto const silent = [&](double time, std::string const&, std::string& payload) {
    if (time > 3600.0) payload.clear();
  };
  close_loop(compensation, machine(), silent, [&](Decision const& d) { last_offset = d.offset, last = d.support; });
  EXPECT_EQ(last, Support::off);
  EXPECT_EQ(last_offset, 0.0);
}

TEST_F(PaperLoop, NamesTheInputsThatDidNotCome) {
  auto compensation = loop();
  close_loop(compensation, machine(), [](double, std::string const& topic, std::string& payload) {
    if (topic.ends_with("/T10")) payload.clear();
  });
  compensation.require_inputs(29.0);
  try {
    compensation.require_inputs(30.0);
    FAIL() << "not refused";
  } catch (thermal::InputError const& error) {
    EXPECT_STREQ(error.what(), "no reading of T10 within 30 s; the model needs every one of its inputs");
  }
}

// --- whatever comes --------------------------------------------------------------------------------------------------

/// Bytes, texts and numbers that somebody might send.
class Hostile {
 public:
  explicit Hostile(std::uint64_t seed) : random_(seed) {}

  std::string payload(std::string const& name, double time) {
    switch (random_() % 8) {
      case 0:
        return bytes(random_() % 200);
      case 1:
        return std::string(random_() % 3000, '{');
      case 2:
        return payload_of({name, number(), "degC", time, "good"});
      case 3:
        return payload_of({name, 25.0, "degC", number(), "good"});
      case 4:
        return payload_of({bytes(5), 25.0, bytes(3), time, bytes(4)});
      case 5:
        return payload_of({name, 1000.0 * number(), "degC", time + double(random_() % 100), "good"});
      case 6:
        return cut(payload_of({name, 25.0, "degC", time, "good"}));
      default:
        return payload_of({name, 25.0 + 1e-3 * double(random_() % 1000), "degC", time, "good"});
    }
  }
  std::uint64_t draw(std::uint64_t below) { return random_() % below; }

 private:
  double number() {
    constexpr double wild[] = {0.0, -0.0, 1e308, -1e308, 5e-324, 1e11, -1e11, 120.0, -20.0, 119.9, 23.0};
    return wild[random_() % std::size(wild)];
  }
  std::string bytes(std::size_t count) {
    std::string text(count, ' ');
    for (auto& c : text) c = char(random_());
    return text;
  }
  std::string cut(std::string const& text) { return text.substr(0, random_() % text.size()); }

  std::mt19937_64 random_;
};

TEST(CompensationLoop, MissesNoCycleByRounding) {
  models::LinearForm form;
  form.coefficients = Eigen::MatrixXd::Ones(1, 1);
  CompensationLoop loop({SavedModel({"linear", {"T1"}, 0.0, 1.0, form, ""}), {}}, {0.01, 1.0, 15.0, 30.0});
  for (int i = 0; i < 10'000; ++i) {
    double const time = 0.01 * i;
    ASSERT_TRUE(loop.take("thermotwin/sensor/T1", payload_of({"T1", 20.0, "degC", time, "good"}), time)) << i;
  }
}

TEST(CompensationLoop, KeepsItsLimitsWhateverComes) {
  ShiftLimits const limits{1.0, 1.0, 0.5, 20.0};
  models::LinearForm form;
  form.coefficients = Eigen::Vector2d(3.0, -40.0);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Hostile hostile(seed);
    CompensationLoop loop({SavedModel({"linear", {"T1", "T2"}, 0.0, 3.0, form, ""}), {limits, {}, {60.0, 60.0}}},
                          {1.0, 1.0, 30.0, 30.0});
    auto const topics = loop.topics();
    double wall = 0.0, last = 0.0, last_wall = 0.0;
    for (int i = 0; i < 5000; ++i) {
      wall += 1e-3 * double(hostile.draw(400));
      auto const which = hostile.draw(3);
      auto const decision = which == 2
                                ? loop.take("thermotwin/#", "{}", wall)
                                : loop.take(topics[which], hostile.payload(which == 0 ? "T1" : "T2", wall), wall);
      if (!decision) continue;
      ASSERT_LE(std::abs(decision->offset), limits.largest);
      ASSERT_EQ(decision->offset, std::round(decision->offset));
      ASSERT_LE(std::abs(decision->offset - last), limits.slew * (wall - last_wall) + limits.resolution + 1e-9);
      last = decision->offset;
      last_wall = wall;
    }
    EXPECT_LE(loop.refusals().size(), 101u);
    EXPECT_GT(loop.refusals().size(), 5u);
  }
}

/// Two senders of two leap by a day, so that the loop believes them: the offset still moves with our own clock.
TEST(CompensationLoop, MovesWithItsOwnClockWhateverTimeItIsTold) {
  models::LinearForm form;
  form.coefficients = Eigen::Vector2d(1.0, 1.0);
  CompensationSettings set{{0.1, 0.0, 0.01, 50.0}, {}, {}};
  CompensationLoop loop({SavedModel({"linear", {"T1", "T2"}, 0.0, 3.0, form, ""}), set}, {1.0, 1.0, 30.0, 30.0});
  double offset = 0.0, last = 0.0;
  for (int i = 0; i < 100; ++i)
    for (std::string const name : {"T1", "T2"}) {
      last = i + (i < 50 ? 0.0 : 86'400.0);
      if (auto const decision = loop.take("thermotwin/sensor/" + name,
                                          payload_of({name, i < 40 ? 20.0 : 20.2 + 1e-6 * i, "degC", last, "good"}), i))
        offset = decision->offset;
    }
  EXPECT_TRUE(loop.refusals().empty());
  EXPECT_NEAR(offset, -0.4, 0.05 + 1e-9);
  EXPECT_LE(std::abs(offset), 0.01 * 60.0 + 0.1);
}

TEST(CompensationLoop, NamesOnlyTheSilentAsLongAsMostAre) {
  models::LinearForm form;
  form.coefficients = Eigen::Vector2d(1.0, 1.0);
  CompensationLoop loop({SavedModel({"linear", {"T1", "T2"}, 0.0, 3.0, form, ""}), {}}, {1.0, 1.0, 30.0, 30.0});
  for (int i = 0; i < 40; ++i) {
    EXPECT_FALSE(loop.take("thermotwin/sensor/T1", payload_of({"T1", 20.0, "degC", double(i), "good"}), i));
    EXPECT_FALSE(loop.idle(i + 0.5));
  }
  try {
    loop.require_inputs(40.0);
    FAIL() << "not refused";
  } catch (thermal::InputError const& error) {
    EXPECT_STREQ(error.what(), "no reading of T2 within 30 s; the model needs every one of its inputs");
  }
}

TEST(CompensationLoop, RefusesSettingsThatAreNone) {
  models::LinearForm form;
  form.coefficients = Eigen::MatrixXd::Ones(1, 1);
  Compensator const compensator(SavedModel({"linear", {"T1"}, 0.0, 1.0, form, ""}), {});
  EXPECT_THROW(CompensationLoop(compensator, {0.0, 1.0, 30.0, 30.0}), thermal::InputError);
  EXPECT_THROW(CompensationLoop(compensator, {1.0, -1.0, 30.0, 30.0}), thermal::InputError);
}

}  // namespace
}  // namespace thermotwin::twin
