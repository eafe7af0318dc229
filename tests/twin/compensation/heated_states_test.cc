#include "twin/compensation/heated_states.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "scenarios/course.h"
#include "thermal/physical_constant.h"
#include "twin/experiment_file.h"
#include "twin/file/document.h"
#include "twin/file/text_file.h"
#include "twin/room_air.h"
#include "twin/run.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double um_per_m = 1e6;

/// Every twenty minutes of a machine's experiment: how warm it is over its room, and what its sensors show of that.
class HeatedStatesTest : public testing::Test {
 protected:
  struct Instant {
    VectorXd rise;
    RunBegin begin;
  };

  Machine const machine_ = Machine::read(machine_file("v450"));
  HeatedStates const states_{machine_};

  [[nodiscard]] RunBegin begin_of(VectorXd const& rise, double air, std::vector<double> given) const {
    auto const& network = machine_.network();
    RunBegin begin;
    begin.rest.assign(std::size_t(network.nodes()), air);
    begin.given = std::move(given);
    begin.standing.assign(begin.given.size(), 0.0);
    for (std::size_t i = 0; i < std::size_t(network.external_channels()); ++i)
      if (network.channel_names()[i] == "ambient.floor_temperature") begin.given[i] = begin.standing[i] = air;
    for (auto const& sensor : machine_.sensors) {
      if (sensor.weights.empty()) continue;
      begin.first.sensors.push_back(sensor.description.name);
      begin.first.weights.conservativeResize(Index(begin.first.sensors.size()), network.nodes());
      begin.first.weights.bottomRows(1).setZero();
      for (auto const& [node, weight] : sensor.weights) begin.first.weights.bottomRows(1)(0, node) += weight;
    }
    begin.first.rise = begin.first.weights * rise;
    return begin;
  }

  [[nodiscard]] std::vector<Instant> instants(std::string const& name) const {
    auto experiment = read_experiment(read_toml(experiment_file(name)), experiment_file(name));
    experiment.sampling = 1200.0;
    RunOptions options;
    options.node_temperatures = true;
    auto const data = run(machine_, experiment, options).dataset;
    scenarios::ExperimentCourse const course(experiment, machine_.limits);
    RoomAir const air(course);
    auto const& network = machine_.network();
    std::vector<double> values(course.channels().size());
    std::vector<Instant> result;
    for (Index row = 3; row < data.time_s.size(); ++row) {
      course.evaluate(data.time_s[row], values);
      std::vector<double> given(std::size_t(network.given_channels()), 0.0);
      for (std::size_t i = 0; i < std::size_t(network.external_channels()); ++i)
        if (int const place = course.index_of(network.channel_names()[i]); place >= 0)
          given[i] = values[std::size_t(place)];
      double const room = air.at(0.0, values);
      VectorXd const rise =
          data.node_temperatures->row(row).cast<double>().transpose().array() + thermal::zero_celsius - room;
      result.push_back({rise, begin_of(rise, room, given)});
    }
    return result;
  }

  /// Of the tool along Z [um per K].
  [[nodiscard]] VectorXd growth() const {
    VectorXd weights = VectorXd::Zero(machine_.network().nodes());
    for (auto const& channel : machine_.linear_channels)
      if (channel.name == "E_Z")
        for (auto const& [node, weight] : channel.weights) weights[node] += um_per_m * weight;
    return weights;
  }

  struct Missed {
    double heated = 0.0, anything = 0.0;  ///< rms of E_Z [um]: of the machine's own heat, of any
    double in_deviations = 0.0;           ///< rms of the former, each over its own deviation
    int instants = 0, contradicted = 0;
  };
  /// `wrong` [K]: how far the sensors, one after another, are wrong.
  [[nodiscard]] Missed missed(std::string const& name, double wrong = 0.0) const {
    VectorXd const weights = growth();
    Missed sum;
    for (auto [rise, begin] : instants(name)) {
      Index const sensor = sum.instants % begin.first.rise.size();
      begin.first.rise[sensor] += wrong;
      auto const anything = warm_start(machine_, begin);
      if (!anything) continue;
      auto const likely = states_.likely(begin, *anything);
      double const error = weights.dot(likely.rise - rise);
      ++sum.instants;
      sum.heated += error * error;
      sum.in_deviations += error * error / weights.dot(likely.covariance * weights);
      sum.anything += std::pow(weights.dot(anything->fields * anything->likely - rise), 2);
      sum.contradicted += likely.contradicted == begin.first.sensors[std::size_t(sensor)];
    }
    for (auto* each : {&sum.heated, &sum.in_deviations, &sum.anything}) *each = std::sqrt(*each / sum.instants);
    return sum;
  }
};

/// Of spectra that are none of the histories. Shaft and test bar have no sensor.
TEST_F(HeatedStatesTest, KnowTheShaftFromWhatTheRestShows) {
  for (auto const* name : {"spindle_standard", "spindle_random", "golden_b_4000"}) {
    auto const sum = missed(name);
    EXPECT_GE(sum.instants, 10) << name;
    EXPECT_LT(sum.heated, 0.3 * sum.anything) << name;
    EXPECT_LT(sum.heated, 2.5) << name;
  }
}

TEST_F(HeatedStatesTest, AreNotSurerThanTheyAreRight) {
  for (auto const* name : {"spindle_standard", "spindle_random", "golden_b_6000"}) {
    auto const sum = missed(name);
    EXPECT_LT(sum.in_deviations, 1.0) << name;
    EXPECT_GT(sum.in_deviations, 0.1) << name;
  }
}

TEST_F(HeatedStatesTest, DoNotFollowASensorThatAllOthersContradict) {
  auto const right = missed("spindle_standard"), wrong = missed("spindle_standard", 4.0);
  EXPECT_EQ(right.contradicted, 0);
  EXPECT_GE(wrong.contradicted, wrong.instants * 8 / 10);
  EXPECT_LT(wrong.heated, right.heated + 2.0);
}

/// A machine that came in from a warm yard: 8 K everywhere, which no work of its own makes.
TEST_F(HeatedStatesTest, GiveWayToHeatFromElsewhere) {
  VectorXd const rise = VectorXd::Constant(machine_.network().nodes(), 8.0);
  auto const begin = begin_of(rise, 293.15, std::vector<double>(std::size_t(machine_.network().given_channels()), 0.0));
  auto const anything = warm_start(machine_, begin);
  ASSERT_TRUE(anything);
  auto const likely = states_.likely(begin, *anything);
  EXPECT_EQ(likely.contradicted, "");
  EXPECT_LT((begin.first.weights * likely.rise - begin.first.rise).cwiseAbs().maxCoeff(), 1.0);
  for (auto const* body : {"column_rear", "head_front", "shaft"}) {
    auto const& names = anything->nodes;
    auto const node =
        std::find_if(names.begin(), names.end(), [&](auto const& name) { return name.starts_with(body); });
    ASSERT_NE(node, names.end()) << body;
    EXPECT_NEAR(likely.rise[node - names.begin()], 8.0, 4.0) << body;
  }
}

/// It has a switch of its own, so that no history can be run: what anything may have warmed counts alone.
TEST_F(HeatedStatesTest, AreNoneOfAMachineThatNoExperimentDrives) {
  auto const text = text_of_file(machine_file("v450")) +
                    "[[heat]]\nname = \"pump\"\nat = \"bed\"\npower = \"60 W\"\nwhile_on = \"pump.on\"\n";
  HeatedStates const none(Machine::build(parse_toml(text, "pumped.toml")));
  auto const begin = instants("golden_b_6000")[6].begin;
  auto const anything = warm_start(machine_, begin);
  ASSERT_TRUE(anything);
  Eigen::VectorXd const expected = anything->fields * anything->likely;
  EXPECT_GT(expected.cwiseAbs().maxCoeff(), 10.0);
  EXPECT_LT((none.likely(begin, *anything).rise - expected).cwiseAbs().maxCoeff(),
            0.1 * expected.cwiseAbs().maxCoeff());
}

}  // namespace
}  // namespace thermotwin::twin
