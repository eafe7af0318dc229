#include <gtest/gtest.h>
#include <numeric>
#include <string>

#include "scenarios/course.h"
#include "thermal/growth_field.h"
#include "thermal/integrate.h"
#include "twin/machine.h"

/// The machines in cells against the same machines in lumps.
namespace thermotwin::twin {
namespace {

using Bodies = std::vector<std::string>;
using Experiment = scenarios::Experiment;

Machine machine(std::string const& name) { return Machine::read(machine_file(name)); }

double capacity(Machine const& machine, Bodies const& bodies) {
  double sum = 0.0;
  for (auto const& body : bodies) {
    auto const& range = machine.network().range(body);
    auto const begin = machine.network().capacity().begin() + range.first;
    sum = std::accumulate(begin, begin + range.count, sum);
  }
  return sum;
}

/// What is one part of the machine in both files.
struct Part {
  Bodies lumped, fine;
};

std::vector<Part> const parts_b = {
    {{"shaft"}, {"shaft"}},           {{"test_bar"}, {"test_bar"}},   {{"cartridge"}, {"cartridge"}},
    {{"front_ring"}, {"front_ring"}}, {{"rear_ring"}, {"rear_ring"}}, {{"head_front", "head_rear"}, {"head"}},
    {{"motor"}, {"motor"}},           {{"rotor"}, {"rotor"}},         {{"column_front", "column_rear"}, {"column"}},
    {{"bed"}, {"bed", "table"}}};
std::vector<Part> const parts_a = {
    {{"screw"}, {"screw"}},
    {{"nut"}, {"nut"}},
    {{"bracket"}, {"bracket"}},
    {{"head"}, {"head"}},
    {{"upper_ring"}, {"upper_ring"}},
    {{"lower_ring"}, {"lower_ring"}},
    {{"upper_cap"}, {"upper_cap"}},
    {{"lower_cap"}, {"lower_cap"}},
    {{"motor"}, {"motor"}},
    {{"flange"}, {"flange"}},
    {{"coupling"}, {"coupling"}},
    {{"column_top", "column_middle", "column_bottom"}, {"column_wall", "column", "guideway_left", "guideway_right"}},
    {{"bed"}, {"bed", "table"}}};
std::vector<Part> const parts_c = {
    {{"shaft_front", "shaft_middle", "shaft_rear"}, {"shaft", "nose", "rotor", "rear_flange"}},
    {{"ring_front"}, {"ring_front"}},
    {{"ring_rear"}, {"ring_rear"}},
    {{"stator"}, {"stator"}},
    {{"oil"}, {"oil"}},
    {{"headstock_front", "headstock_rear"}, {"headstock", "housing_front", "housing_middle", "housing_rear"}},
    {{"bed_top", "bed_base"}, {"bed"}},
    {{"tank"}, {"tank"}},
    {{"slide"}, {"slide", "turret"}}};

void expect_same_masses(std::string const& name, std::vector<Part> const& parts) {
  Machine const lumped = machine(name), fine = machine(name + "_fine");
  EXPECT_GE(fine.network().nodes(), 10000) << name;
  double all_lumped = 0.0, all_fine = 0.0;
  for (auto const& part : parts) {
    double const c = capacity(lumped, part.lumped), c_fine = capacity(fine, part.fine);
    EXPECT_NEAR(c_fine / c, 1.0, 0.01) << name << ": " << part.fine[0];
    all_lumped += c;
    all_fine += c_fine;
  }
  auto const total = [](Machine const& m) {
    return std::accumulate(m.network().capacity().begin(), m.network().capacity().end(), 0.0);
  };
  EXPECT_NEAR(all_lumped, total(lumped), 1e-9 * all_lumped) << name << ": a body is not in the list";
  EXPECT_NEAR(all_fine, total(fine), 1e-9 * all_fine) << name << ": a body is not in the list";
}

TEST(FineMachine, HasTheMassesOfTheLumpedOneInTenThousandCells) {
  expect_same_masses("v450", parts_b);
  expect_same_masses("vmc850", parts_a);
  expect_same_masses("g200", parts_c);
}

/// Temperature rises of all nodes after four hours at constant load.
struct Course {
  Machine machine;
  std::vector<double> rise;

  Course(std::string const& name, Experiment const& experiment) : machine(twin::machine(name)) {
    scenarios::ExperimentCourse const input(experiment, machine.limits);
    std::vector<double> const start(std::size_t(machine.network().nodes()), experiment.ambient.mean);
    auto const summary =
        thermal::integrate(machine.network(), input, start, std::vector<double>{0.0, experiment.duration}, {},
                           [&](thermal::Sample const& s) {
                             rise.assign(s.temperatures.begin(), s.temperatures.begin() + std::ssize(start));
                           });
    for (double& t : rise) t -= experiment.ambient.mean;
    EXPECT_LT(summary.energy_imbalance(), 1e-9) << name;
  }

  /// Mean of the bodies, by capacity [K].
  [[nodiscard]] double mean(Bodies const& bodies) const {
    double heat = 0.0;
    for (auto const& body : bodies) {
      auto const& range = machine.network().range(body);
      for (int i = range.first; i < range.first + range.count; ++i)
        heat += machine.network().capacity()[std::size_t(i)] * rise[std::size_t(i)];
    }
    return heat / capacity(machine, bodies);
  }
  /// [µm] or [µrad]
  [[nodiscard]] double displacement(std::string const& name) const {
    double sum = 0.0;
    for (auto const& channel : machine.displacements)
      if (channel.name == name)
        for (auto const& [node, weight] : channel.weights) sum += 1e6 * weight * rise[std::size_t(node)];
    return sum;
  }
  [[nodiscard]] Eigen::Vector3d shown(std::string const& body, int cell) const {
    return 1e6 * thermal::growth_field(machine.growing, rise).col(machine.network().range(body).first + cell);
  }
};

Experiment spindle_run(double rpm, double hours) {
  Experiment experiment;
  experiment.duration = hours * 3600.0;
  experiment.ambient.mean = 295.15;
  experiment.spindle.emplace();
  experiment.spindle->blocks.push_back({experiment.duration, rpm * 2.0 * M_PI / 60.0, {}});
  return experiment;
}

Experiment feed_run(double hours) {
  Experiment experiment;
  experiment.duration = hours * 3600.0;
  experiment.ambient.mean = 293.15;
  auto& axis = experiment.axes.emplace_back();
  axis.axis = "z";
  axis.duty = 0.88;
  axis.blocks.push_back({experiment.duration, 16.0 / 60.0, {}});
  return experiment;
}

void expect_ratio(double fine, double lumped, double low, double high, std::string const& what) {
  EXPECT_GT(fine, low * lumped) << what;
  EXPECT_LT(fine, high * lumped) << what;
}

/// The cartridge's seat is spread along the head, so that little changes where heat enters it.
TEST(FineMachine, SpindleOfSetBWarmsAsTheLumpedOneDoes) {
  Course const lumped("v450", spindle_run(6000.0, 4.0)), fine("v450_fine", spindle_run(6000.0, 4.0));
  for (auto const& body : {"shaft", "test_bar", "cartridge", "front_ring", "rear_ring", "motor", "rotor"})
    expect_ratio(fine.mean({body}), lumped.mean({body}), 0.8, 1.2, body);
  expect_ratio(fine.mean({"head"}), lumped.mean({"head_front", "head_rear"}), 0.8, 1.2, "head");
  expect_ratio(fine.displacement("E_Z"), lumped.displacement("E_Z"), 0.8, 1.2, "E_Z");
  expect_ratio(fine.displacement("E_Y"), lumped.displacement("E_Y"), 0.8, 1.5, "E_Y");
}

/// Where heat enters a casting through a small seat, the cells around it are warmer than the casting's mean, which is
/// all that a lump knows: rings and caps rise by up to two thirds more, what they are bolted to no more than it did.
TEST(FineMachine, FeedDriveOfSetAWarmsAsTheLumpedOneDoes) {
  Course const lumped("vmc850", feed_run(4.0)), fine("vmc850_fine", feed_run(4.0));
  for (auto const& body : {"screw", "nut", "head", "motor"})
    expect_ratio(fine.mean({body}), lumped.mean({body}), 0.8, 1.35, body);
  for (auto const& body : {"upper_ring", "lower_ring", "upper_cap", "lower_cap"})
    expect_ratio(fine.mean({body}), lumped.mean({body}), 1.0, 1.85, body);
  expect_ratio(fine.mean(parts_a[11].fine), lumped.mean(parts_a[11].lumped), 0.5, 1.0, "column");
}

/// As above, and the nose cools the shaft less: it hangs on a thin tube, while the lump has one temperature to its tip.
TEST(FineMachine, SpindleOfSetCWarmsAsTheLumpedOneDoes) {
  auto experiment = spindle_run(4500.0, 4.0);
  experiment.coolant.on = true;
  Course const lumped("g200", experiment), fine("g200_fine", experiment);
  for (auto const& body : {"oil", "tank"}) expect_ratio(fine.mean({body}), lumped.mean({body}), 0.95, 1.05, body);
  expect_ratio(fine.mean(parts_c[0].fine), lumped.mean(parts_c[0].lumped), 0.9, 1.3, "spindle");
  expect_ratio(fine.mean(parts_c[5].fine), lumped.mean(parts_c[5].lumped), 1.0, 1.6, "headstock");
  for (auto const& body : {"ring_front", "ring_rear"})
    expect_ratio(fine.mean({body}), lumped.mean({body}), 1.0, 1.65, body);
  expect_ratio(fine.displacement("E_X"), lumped.displacement("E_X"), 0.8, 1.5, "E_X");
  expect_ratio(fine.displacement("E_Z"), lumped.displacement("E_Z"), 0.8, 1.2, "E_Z");
}

/// Every channel's loop closes: at one temperature it moves by Σ α · length, and tilts not at all.
TEST(FineMachine, MovesAtOneTemperatureByWhatTheLoopLeavesOpen) {
  constexpr double iron = 10.5, steel = 11.8;  // [µm/(m K)]
  auto const move = [](Machine const& m, std::string const& name) {
    for (auto const& channel : m.displacements)
      if (channel.name == name)
        return 1e6 * std::accumulate(channel.weights.begin(), channel.weights.end(), 0.0,
                                     [](double sum, auto const& w) { return sum + w.second; });
    return std::nan("");
  };
  Machine const mill = machine("v450_fine"), lathe = machine("g200_fine");
  EXPECT_NEAR(move(mill, "E_Z"), steel * (0.200 + 0.060 - 0.030) + iron * (0.150 - 0.750 + 0.170), 1e-5);
  EXPECT_NEAR(move(mill, "E_Y"), 0.0, 1e-5);
  EXPECT_NEAR(move(mill, "A"), 0.0, 1e-5);
  EXPECT_NEAR(move(lathe, "E_X"), 0.0, 1e-5);
  EXPECT_NEAR(move(lathe, "B"), 0.0, 1e-5);
  EXPECT_NEAR(move(lathe, "E_Z"), steel * (0.087 + 0.04775) + iron * (0.270 - 0.087), 1e-5);
}

/// Two ways to the same movement: influence weights of the solid, and sections that stay plane (physics.md 3.5).
TEST(FineMachine, ShowsInItsFieldWhatItsChannelsSay) {
  Course const mill("v450_fine", spindle_run(6000.0, 4.0));
  Eigen::Vector3d const tool = mill.shown("test_bar", 4 * 39), table = mill.shown("table", 7 + 14 * (5 + 10 * 2));
  EXPECT_NEAR(-(tool - table).z(), mill.displacement("E_Z"), 0.15 * mill.displacement("E_Z"));
  EXPECT_NEAR(-(tool - table).y(), mill.displacement("E_Y"), 0.3 * mill.displacement("E_Y"));
}

}  // namespace
}  // namespace thermotwin::twin
