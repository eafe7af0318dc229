#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <string>

#include "scenarios/course.h"
#include "scenarios/experiment.h"
#include "tests/twin/golden_tables.h"
#include "thermal/integrate.h"
#include "twin/machine.h"

/// The lumped machines against the golden tables: every cell to 0.02 K and 0.1 µm (and half a printed digit).
namespace thermotwin::twin {
namespace {

std::filesystem::path const machines = std::filesystem::path(THERMOTWIN_SOURCE_DIR) / "twin" / "machines";

/// A run that keeps every node's temperature once a minute.
struct Course {
  Machine machine;
  std::vector<std::vector<double>> temperatures;  ///< per minute, per node [K]
  thermal::IntegrationSummary summary;

  [[nodiscard]] double rise(std::string const& body, int minute, int cell = 0) const {
    int const node = machine.network().range(body).first + cell;
    return temperatures.at(std::size_t(minute))[std::size_t(node)] - temperatures[0][std::size_t(node)];
  }
  [[nodiscard]] double displacement(std::string const& name, int minute) const {
    for (auto const& channel : machine.displacements)
      if (channel.name == name) {
        double sum = 0.0;
        for (auto const& [node, weight] : channel.weights)
          sum += weight * (temperatures[std::size_t(minute)][std::size_t(node)] - temperatures[0][std::size_t(node)]);
        return sum * 1e6;
      }
    ADD_FAILURE() << "no displacement " << name;
    return 0.0;
  }
  [[nodiscard]] double position_error(int screw, double x, int minute) const {
    auto const& s = machine.screws.at(std::size_t(screw));
    std::vector<double> rise;
    for (std::size_t i = 0; i + 1 < s.screw.edges.size(); ++i) {
      auto const node = std::size_t(s.first_node) + i;
      rise.push_back(temperatures[std::size_t(minute)][node] - temperatures[0][node]);
    }
    return s.screw.position_error(x, rise) * 1e6;
  }
};

Course simulate(std::string const& machine_name, scenarios::Experiment const& experiment) {
  Course course{Machine::read(machines / (machine_name + ".toml")), {}, {}};
  scenarios::ExperimentCourse const input(experiment, course.machine.limits);
  std::vector<double> times;
  for (double t = 0.0; t <= experiment.duration; t += 60.0) times.push_back(t);
  std::vector<double> const start(std::size_t(course.machine.network().nodes()), experiment.ambient.mean);
  course.summary = thermal::integrate(course.machine.network(), input, start, times, {}, [&](thermal::Sample const& s) {
    course.temperatures.emplace_back(s.temperatures.begin(), s.temperatures.begin() + std::ptrdiff_t(start.size()));
  });
  EXPECT_LT(course.summary.energy_imbalance(), 1e-9);
  return course;
}

scenarios::Experiment spindle_run(double rpm, double ambient, double run, double rest) {
  scenarios::Experiment experiment;
  experiment.duration = run + rest;
  experiment.ambient.mean = ambient;
  experiment.spindle.emplace();
  experiment.spindle->blocks.push_back({run, rpm * 2.0 * M_PI / 60.0, {}});
  return experiment;
}

/// Golden temperatures are printed to 0.01 K, displacements to 0.1 µm.
void expect_rise(double actual, double golden, std::string const& what) { EXPECT_NEAR(actual, golden, 0.02) << what; }
void expect_um(double actual, double golden, std::string const& what) { EXPECT_NEAR(actual, golden, 0.1) << what; }

TEST(GoldenTableB, WarmUpAndCoolDown) {
  struct Column {
    char const* body;
    int cell;
  };
  constexpr Column columns[] = {{"shaft", 2},      {"front_ring", 0},  {"cartridge", 0},  {"cartridge", 6},
                                {"cartridge", 12}, {"test_bar", 0},    {"head_front", 0}, {"head_rear", 0},
                                {"motor", 0},      {"column_front", 0}};
  constexpr Column cooling[] = {{"shaft", 2}, {"front_ring", 0}, {"cartridge", 0}, {"head_front", 0}, {"motor", 0}};
  for (double rpm : {2000.0, 4000.0, 6000.0}) {
    auto const course = simulate("v450", spindle_run(rpm, 295.15, 4 * 3600.0, 4 * 3600.0));
    for (auto const& row : golden::table_b) {
      if (row[0] != rpm) continue;
      int const minute = int(row[1]);
      for (std::size_t c = 0; c < std::size(columns); ++c)
        expect_rise(course.rise(columns[c].body, minute, columns[c].cell), row[2 + c],
                    fmt::format("{} rpm, {} min, {}[{}]", rpm, minute, columns[c].body, columns[c].cell));
      expect_um(course.displacement("E_Z", minute), row[12], fmt::format("{} rpm, {} min, E_Z", rpm, minute));
      expect_um(course.displacement("E_Y", minute), row[13], fmt::format("{} rpm, {} min, E_Y", rpm, minute));
      expect_um(course.displacement("A", minute), row[14], fmt::format("{} rpm, {} min, A", rpm, minute));
    }
    for (auto const& row : golden::table_b_cooling) {
      if (row[0] != rpm) continue;
      int const minute = 240 + int(row[1]);
      for (std::size_t c = 0; c < std::size(cooling); ++c)
        expect_rise(course.rise(cooling[c].body, minute, cooling[c].cell), row[2 + c],
                    fmt::format("{} rpm, {} min, {}", rpm, minute, cooling[c].body));
      expect_um(course.displacement("E_Z", minute), row[7], fmt::format("{} rpm, {} min, E_Z", rpm, minute));
      expect_um(course.displacement("E_Y", minute), row[8], fmt::format("{} rpm, {} min, E_Y", rpm, minute));
    }
  }
}

TEST(GoldenTableC, Spindle) {
  constexpr char const* bodies[] = {"shaft_front",     "shaft_rear",     "ring_front", "ring_rear", "stator", "oil",
                                    "headstock_front", "headstock_rear", "bed_top",    "bed_base",  "tank",   "slide"};
  for (double rpm : {1500.0, 3000.0, 4500.0}) {
    auto experiment = spindle_run(rpm, 295.15, 6 * 3600.0, 0.0);
    experiment.coolant.on = true;
    auto const course = simulate("g200", experiment);
    for (auto const& row : golden::table_c) {
      if (row[0] != rpm) continue;
      int const minute = int(row[1]);
      for (std::size_t c = 0; c < std::size(bodies); ++c)
        expect_rise(course.rise(bodies[c], minute), row[2 + c],
                    fmt::format("{} rpm, {} min, {}", rpm, minute, bodies[c]));
      expect_um(course.displacement("E_X", minute), row[14], fmt::format("{} rpm, {} min, E_X", rpm, minute));
      expect_um(course.displacement("E_Z", minute), row[15], fmt::format("{} rpm, {} min, E_Z", rpm, minute));
      expect_um(course.displacement("B", minute), row[16], fmt::format("{} rpm, {} min, B", rpm, minute));
    }
  }
}

/// physics.md 6.3: without coolant the slow part of the drift does not turn round.
TEST(GoldenTableC, WithoutCoolant) {
  auto const course = simulate("g200", spindle_run(4500.0, 295.15, 6 * 3600.0, 0.0));
  constexpr double golden[][2] = {{60, 25.9}, {120, 30.7}, {240, 33.1}, {360, 33.7}};
  for (auto const& [minute, drift] : golden) expect_um(course.displacement("E_X", int(minute)), drift, "E_X");
}

TEST(GoldenTableA, FeedAxis) {
  struct Column {
    char const* body;
    int cell;
  };
  constexpr Column columns[] = {{"motor", 0},      {"flange", 0},    {"coupling", 0},   {"upper_ring", 0},
                                {"upper_cap", 0},  {"screw", 21},    {"nut", 0},        {"bracket", 0},
                                {"lower_ring", 0}, {"lower_cap", 0}, {"column_top", 0}, {"head", 0}};
  for (double feed : {8000.0, 12000.0, 16000.0}) {
    scenarios::Experiment experiment;
    experiment.duration = 4 * 3600.0;
    experiment.ambient.mean = 293.15;
    scenarios::FeedProgram program;
    program.blocks.push_back({experiment.duration, feed / 60e3, {}});
    program.duty = 0.88;
    experiment.axes.push_back(program);
    auto const course = simulate("vmc850", experiment);
    for (auto const& row : golden::table_a) {
      if (row[0] != feed) continue;
      int const minute = int(row[1]);
      for (std::size_t c = 0; c < std::size(columns); ++c)
        expect_rise(course.rise(columns[c].body, minute, columns[c].cell), row[2 + c],
                    fmt::format("{} mm/min, {} min, {}", feed, minute, columns[c].body));
    }
    for (auto const& row : golden::table_a_error) {
      if (row[0] != feed) continue;
      int const minute = int(row[1]);
      constexpr double x[] = {0.12, 0.42, 0.72};
      for (int k = 0; k < 6; ++k)
        expect_um(course.position_error(k / 3, x[k % 3], minute), row[2 + k],
                  fmt::format("{} mm/min, {} min, E({}) {}", feed, minute, x[k % 3], k < 3 ? "fix-sup" : "fix-fix"));
    }
  }
}

}  // namespace
}  // namespace thermotwin::twin
