#include "thermal/stroke.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>
#include <numeric>

#include "tests/thermal/function_course.h"
#include "thermal/bar.h"
#include "thermal/error.h"
#include "thermal/integrate.h"
#include "thermal/laws.h"

namespace thermotwin::thermal {
namespace {

using testing::HasSubstr;

Material steel() { return {"steel", 42.0, 0.0, 7850.0, 470.0, 0.0, 11.5e-6, 210e9, 0.3, 0.25}; }
Body screw(int cells = 42) {
  return make_body("screw", Bar{steel(), {0, 0, 0}, {1, 0, 0}, 0.84, 0.04, 0.0, {}, cells});
}
Site track(int cells = 42) { return face(screw(cells), "surface"); }

double sum_of_shares(Site const& site) {
  return std::accumulate(site.contacts.begin(), site.contacts.end(), 0.0,
                         [](double s, Contact const& c) { return s + c.share; });
}

TEST(Dwell, IsTheMeanOfTheWindowsOverManyPositions) {
  double const from = 0.137, to = 0.611, window = 0.093;
  std::vector<double> mean(42, 0.0);
  int const n = 20000;
  for (int i = 0; i < n; ++i) {
    double const centre = from + (to - from) * (i + 0.5) / n;
    for (auto const& c : face(screw(), "surface", centre - 0.5 * window, centre + 0.5 * window).contacts)
      mean[std::size_t(c.node)] += c.share / n;
  }
  Site const site = dwell(track(), from, to, window);
  EXPECT_NEAR(sum_of_shares(site), 1.0, 1e-13);
  for (auto const& c : site.contacts) EXPECT_NEAR(c.share, mean[std::size_t(c.node)], 1e-6);
  EXPECT_NEAR(site.area(), std::numbers::pi * 0.04 * window, 1e-14);
}

TEST(Dwell, OfNoStrokeIsTheWindowItself) {
  Site const still = dwell(track(), 0.4, 0.4, 0.1), window = face(screw(), "surface", 0.35, 0.45);
  ASSERT_EQ(still.contacts.size(), window.contacts.size());
  for (std::size_t i = 0; i < still.contacts.size(); ++i)
    EXPECT_NEAR(still.contacts[i].share, window.contacts[i].share, 1e-14);
}

TEST(Dwell, IsUniformInsideTheStrokeWithLinearRampsAtItsEnds) {
  double const from = 0.2, to = 0.6, window = 0.1;
  for (auto const& c : dwell(track(420), from, to, window).contacts) {
    double const x = 0.5 * (c.low + c.high);
    double const ramp = std::max(0.0, std::min({1.0, (x - 0.15) / window, (0.65 - x) / window}));
    EXPECT_NEAR(c.share / 0.002, ramp / (to - from), 0.03);
  }
}

TEST(Dwell, RefusesToLeaveTheTrack) {
  try {
    (void)dwell(track(), 0.02, 0.6, 0.1);
    FAIL() << "the window reaches to −30 mm";
  } catch (InputError const& error) {
    EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("-0.03"), HasSubstr("'screw'"), HasSubstr("0.84")));
  }
  EXPECT_THROW((void)dwell(face(screw(), "start"), 0.1, 0.2, 0.05), InputError);
}

/// A nut of 60 W that goes to and fro on the screw.
struct MovingNut {
  static constexpr double period = 20.0, from = 0.2, to = 0.6, window = 0.1;

  static Network network(bool resolved) {
    NetworkBuilder builder;
    int const part = builder.part("nut");
    Body const body = screw();
    add_to(builder, part, body);
    Port const room = builder.add_boundary({"room", 293.15, {}});
    for (auto const& c : track().contacts) builder.connect(part, port_of(builder, track(), c), room, 5.0 * c.area);
    int const position = builder.channel("position");
    Port const under = resolved ? add_moving_average(builder, track(), position, position, window)
                                : port_of(builder, dwell(track(), from, to, window));
    builder.add<SwitchedHeat>(builder.part("friction"), {under}, {60.0}, {builder.channel("run")});
    return builder.build();
  }

  /// A triangle: there and back in one period.
  static FunctionCourse course() {
    std::vector<double> turns;
    for (int i = 1; i < 1000; ++i) turns.push_back(0.5 * period * i);
    return {{"position", "run"},
            [](double t, std::span<double> u) {
              double const phase = std::fmod(t, period) / period;
              u[0] = from + (to - from) * (phase < 0.5 ? 2.0 * phase : 2.0 - 2.0 * phase);
              u[1] = 1.0;
            },
            turns};
  }
};

TEST(MovingAverage, FollowsThePositionWithoutSteps) {
  Network const network = MovingNut::network(true);
  Evaluation evaluation(network);
  std::vector<double> state, watts(42);
  for (int i = 0; i < 42; ++i) state.push_back(293.15 + 0.3 * i);
  double before = 0.0;
  for (double x = 0.2; x < 0.6; x += 1e-4) {
    std::vector<double> input{x, 1.0};
    double const reading = evaluation.temperatures(state.data(), input.data()).back();
    EXPECT_NEAR(reading, 293.15 + 0.3 * (x / 0.02 - 0.5), 0.02);  // a linear field, up to the cells' steps
    if (x > 0.2) {
      EXPECT_NEAR(reading - before, 0.3 * 1e-4 / 0.02, 1e-3);
    }
    before = reading;
    evaluation.source_of_nodes(state.data(), input.data(), watts);
    EXPECT_NEAR(std::accumulate(watts.begin(), watts.end(), 0.0), 60.0, 1e-12);
  }
}

TEST(MovingAverage, OverManyStrokesHeatsLikeTheDwellWeights) {
  Network const resolved = MovingNut::network(true), averaged = MovingNut::network(false);
  std::vector<double> const start(42, 293.15), times{0.0, 60.0 * 20.0};
  std::vector<double> a, b;
  auto const keep = [](std::vector<double>& to) {
    return [&to](Sample const& s) { to.assign(s.temperatures.begin(), s.temperatures.begin() + 42); };
  };
  auto const run = integrate(resolved, MovingNut::course(), start, times, {}, keep(a));
  integrate(averaged, MovingNut::course(), start, times, {}, keep(b));
  EXPECT_LT(run.energy_imbalance(), 1e-9);
  EXPECT_NEAR(run.energy.supplied, 60.0 * 1200.0, 1e-4);
  for (std::size_t i = 0; i < 42; ++i) EXPECT_NEAR(a[i], b[i], 0.05 * (b[i] - 293.15) + 0.3) << i;
  EXPECT_NEAR(std::accumulate(a.begin(), a.end(), 0.0), std::accumulate(b.begin(), b.end(), 0.0), 0.05);
}

TEST(MovingAverage, OfAStrokeGivenByItsEndsIsTheDwell) {
  NetworkBuilder builder;
  int const part = builder.part("nut");
  add_to(builder, part, screw());
  builder.connect(part, {Port::Kind::node, 0}, builder.add_boundary({"room", 293.15, {}}), 1.0);
  Port const under = add_moving_average(builder, track(), builder.channel("from"), builder.channel("to"), 0.1);
  builder.add<SwitchedHeat>(part, {under}, {1.0}, {builder.channel("run")});
  Network const network = builder.build();
  std::vector<double> state(42, 293.15), watts(42), expected(42, 0.0), input{0.2, 0.6, 1.0};
  Evaluation(network).source_of_nodes(state.data(), input.data(), watts);
  for (auto const& c : dwell(track(), 0.2, 0.6, 0.1).contacts) expected[std::size_t(c.node)] = c.share;
  for (std::size_t i = 0; i < 42; ++i) EXPECT_NEAR(watts[i], expected[i], 1e-13);
}

}  // namespace
}  // namespace thermotwin::thermal
