#include "thermal/network.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "tests/scenarios/refusal.h"
#include "tests/thermal/verification.h"
#include "thermal/error.h"
#include "thermal/laws.h"

namespace thermotwin::thermal {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using thermotwin::tests::refusal;

std::string rejection(auto action) {
  NetworkBuilder builder;
  return refusal([&] { action(builder); });
}

/// A body that reaches the room, for cases that fail elsewhere.
Port sound_body(NetworkBuilder& builder, std::string const& name = "bed") {
  Port const body = builder.add_body(name, {1000.0, 2000.0});
  Port const second{Port::Kind::node, body.index + 1};
  builder.connect(builder.part("inside"), body, second, 2.0);
  builder.connect(builder.part("film"), second, builder.add_boundary({"room", T0, {}}), 1.0);
  return body;
}

TEST(NetworkBuilder, RefusesANetworkWithoutABody) {
  EXPECT_THAT(rejection([](auto& b) { (void)b.build(); }), HasSubstr("no body"));
}

TEST(NetworkBuilder, RefusesTwoBodiesOfOneName) {
  EXPECT_THAT(rejection([](auto& b) {
                sound_body(b);
                b.add_body("bed", {1.0});
              }),
              AllOf(HasSubstr("'bed'"), HasSubstr("two")));
}

TEST(NetworkBuilder, RefusesCapacitiesThatAreNotPositive) {
  for (double c : {0.0, -5.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_THAT(rejection([&](auto& b) {
                  b.add_body("column", {1.0, c});
                }),
                AllOf(HasSubstr("'column'"), HasSubstr("J/K")));
}

TEST(NetworkBuilder, NamesTheNodeWithoutAPathToTheSurroundings) {
  EXPECT_THAT(rejection([](auto& b) {
                sound_body(b);
                b.add_body("head", {10.0});
                (void)b.build();
              }),
              AllOf(HasSubstr("'head'"), HasSubstr("no path")));
  EXPECT_THAT(rejection([](auto& b) {
                sound_body(b);
                Port const shaft = b.add_body("shaft", {10.0, 10.0, 10.0});
                b.connect(b.part("fit"), shaft, {Port::Kind::node, 0}, 1.0);
                b.connect(b.part("fit"), shaft, {Port::Kind::node, shaft.index + 1}, 1.0);
                b.connect(b.part("fit"), shaft, {Port::Kind::node, shaft.index + 2}, 0.0);  // leads nothing
                (void)b.build();
              }),
              AllOf(HasSubstr("'shaft[2]'"), HasSubstr("no path")));
}

TEST(NetworkBuilder, HeatSourcesAreNoPath) {
  EXPECT_THAT(rejection([](auto& b) {
                sound_body(b);
                Port const motor = b.add_body("motor", {10.0});
                b.template add<SwitchedHeat>(b.part("loss"), {motor}, {100.0}, {b.channel("on")});
                (void)b.build();
              }),
              HasSubstr("'motor'"));
}

TEST(NetworkBuilder, AnAverageIsAPath) {
  NetworkBuilder builder;
  Port const bar = builder.add_body("bar", {10.0, 10.0});
  Average average;
  average.name = "mean of bar";
  average.nodes = {bar.index, bar.index + 1};
  average.weights = {0.5, 0.5};
  Port const mean = builder.add_average(average);
  builder.connect(builder.part("film"), mean, builder.add_boundary({"room", T0, {}}), 1.0);
  EXPECT_NO_THROW((void)builder.build());
}

TEST(NetworkBuilder, RefusesNegativeConductances) {
  EXPECT_THAT(rejection([](auto& b) {
                Port const body = sound_body(b);
                b.connect(b.part("seat"), body, {Port::Kind::node, 1}, -3.0);
              }),
              AllOf(HasSubstr("'seat'"), HasSubstr("-3")));
}

TEST(NetworkBuilder, RefusesAveragesThatDoNotAddUpToOne) {
  EXPECT_THAT(rejection([](auto& b) {
                Port const body = sound_body(b);
                Average average;
                average.name = "mean of bed";
                average.nodes = {body.index, body.index + 1};
                average.weights = {0.5, 0.6};
                b.add_average(average);
              }),
              AllOf(HasSubstr("'mean of bed'"), HasSubstr("1.1")));
}

TEST(NetworkBuilder, RefusesElementsThatDoNotFitTheirLaw) {
  EXPECT_THAT(
      rejection([](auto& b) {
        Port const body = sound_body(b);
        b.template add<SwitchedHeat>(b.part("motor"), {body}, {1.0, 2.0}, {b.channel("on")});
      }),
      AllOf(HasSubstr("'motor'"), HasSubstr("'switched heat'"), HasSubstr("1 coefficients"), HasSubstr("not 1, 2")));
  EXPECT_THAT(rejection([](auto& b) {
                Port const body = sound_body(b);
                b.template add<SwitchedHeat>(b.part("motor"), {body}, {std::nan("")}, {b.channel("on")});
              }),
              AllOf(HasSubstr("'motor'"), HasSubstr("nan")));
}

TEST(NetworkBuilder, RefusesARelayWithoutABand) {
  EXPECT_THAT(rejection([](auto& b) {
                Port const body = sound_body(b);
                b.add_relay("chiller", body, body, 1.0, 1.0);
              }),
              HasSubstr("'chiller'"));
}

TEST(Network, KnowsItsBodiesByName) {
  NetworkBuilder builder;
  sound_body(builder, "headstock");
  builder.connect(builder.part("film"), builder.add_body("bed", {5.0}), {Port::Kind::boundary, 0}, 1.0);
  Network const network = builder.build();
  EXPECT_EQ(network.range("headstock").count, 2);
  EXPECT_EQ(network.node_name(1), "headstock[1]");
  EXPECT_EQ(network.node_name(2), "bed");
  try {
    (void)network.range("headstok");
    FAIL();
  } catch (InputError const& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("'headstok'"), HasSubstr("'headstock'")));
  }
}

TEST(Network, StateAndTemperatureAreInverse) {
  NetworkBuilder builder;
  Port const body = builder.add_body("ring", {100.0}, 1.5e-3);
  builder.connect(builder.part("film"), body, builder.add_boundary({"room", T0, {}}), 1.0);
  Network const network = builder.build();
  for (double T : {250.0, 293.15, 293.16, 350.0}) {
    double const y = network.state_of_temperature(0, T);
    EXPECT_NEAR(network.temperature_of_state(0, y), T, 1e-10);
    // C dy = C(T) dT
    double const slope = (network.state_of_temperature(0, T + 1e-3) - network.state_of_temperature(0, T - 1e-3)) / 2e-3;
    EXPECT_NEAR(slope, 1.0 + 1.5e-3 * (T - T0), 1e-8);
  }
}

TEST(Network, RelayStatesComeAfterWhatACourseMustGive) {
  NetworkBuilder builder;
  Port const body = sound_body(builder);
  int const relay = builder.add_relay("chiller", body, {Port::Kind::boundary, 0}, 0.5, -0.5);
  builder.add<SwitchedHeat>(builder.part("chiller"), {body}, {-5.0}, {relay});
  builder.add<SwitchedHeat>(builder.part("motor"), {body}, {5.0}, {builder.channel("speed")});
  Network const network = builder.build();
  EXPECT_EQ(network.external_channels(), 1);
  EXPECT_THAT(network.channel_names(), testing::ElementsAre("speed", "chiller.state"));
  EXPECT_EQ(network.groups().back().inputs, (std::vector<int>{1, 0}));
}

TEST(Network, KnowsWhichOfItsChannelsAreShares) {
  NetworkBuilder builder;
  Port const body = sound_body(builder);
  builder.add<SwitchedHeat>(builder.part("pump"), {body}, {5.0}, {builder.share("pump.on")});
  builder.add<SwitchedHeat>(builder.part("motor"), {body}, {5.0}, {builder.channel("speed")});
  EXPECT_EQ(builder.share("pump.on"), builder.channel("pump.on"));
  Network const network = builder.build();
  EXPECT_THAT(network.shares(), testing::ElementsAre("pump.on"));
  EXPECT_THAT(network.channel_names(), testing::ElementsAre("pump.on", "speed"));
}

TEST(Network, MeanOverlapIsTheOverlapAveragedOverTheCentre) {
  double const low = 0.2, high = 0.3, window = 0.08, from = 0.1, to = 0.27;
  double sum = 0.0;
  int const n = 100000;
  for (int i = 0; i < n; ++i) {
    double const centre = from + (to - from) * (i + 0.5) / n;
    sum += std::max(0.0, std::min(high, centre + 0.5 * window) - std::max(low, centre - 0.5 * window)) / n;
  }
  EXPECT_NEAR(mean_overlap(low, high, window, from, to), sum, 1e-8);
  EXPECT_NEAR(mean_overlap(low, high, window, 0.25, 0.25), 0.08, 1e-15);
  EXPECT_NEAR(mean_overlap(low, high, window, 0.19, 0.19), 0.03, 1e-15);
}

}  // namespace
}  // namespace thermotwin::thermal
