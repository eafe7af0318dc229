#include "twin/diagnosis/lump_interiors.h"

#include <algorithm>
#include <gtest/gtest.h>

#include "thermal/material.h"
#include "twin/diagnosis/linear_unknowns.h"
#include "twin/experiment_file.h"
#include "twin/file/value.h"
#include "twin/run.h"

namespace thermotwin::twin {
namespace {

constexpr double edge = 0.1, power = 100.0;

/// A cube of cast iron that is heated and loses nothing, and something that has no inside.
Value cube() {
  return parse_toml(R"toml(
    name = "cube"
    [[lump]]
    name = "cube"
    material = "GJL-300"
    mass = "7.25 kg"
    corner = ["0 mm", "0 mm", "0 mm"]
    size = ["100 mm", "100 mm", "100 mm"]
    [[lump]]
    name = "oil"
    heat_capacity = "5000 J/K"
    corner = ["200 mm", "0 mm", "0 mm"]
    size = ["100 mm", "100 mm", "100 mm"]
    [[joint]]
    name = "none"
    from = "cube"
    to = "oil"
    conductance = "1e-6 W/K"
    [[film]]
    name = "none"
    on = "oil"
    correlation = "constant"
    coefficient = "1 W/(m2 K)"
    area = "1e-6 m2"
    [[heat]]
    name = "heater"
    at = "cube"
    power = "100 W"
    [[temperature_sensor]]
    name = "T1"
    at = "cube"
    kind = "ideal"
    [[temperature_sensor]]
    name = "T2"
    at = "oil"
    kind = "ideal"
    [[displacement]]
    name = "E_Z"
    direction = "z"
    [[displacement.segment]]
    of = "cube"
    length = "100 mm")toml",
                    "cube.toml");
}

/// After two hours the slab has its shape: the heated face leads the mean by q L/(3 k A), A = L².
TEST(LumpInteriors, LeadTheMeanAsAHeatedSlabDoes) {
  Machine const machine = Machine::build(cube());
  auto const experiment = read_experiment(parse_toml(R"(
    machine = "cube"
    duration = "2 h"
    ambient.mean = "20 degC")",
                                                     "two hours"),
                                          "two hours");
  MeasuredRun const run = measured_run(twin::run(machine, experiment, {}).dataset, machine, "cube");
  BinnedRun const data = bin(run, 60.0);
  LumpInteriors const interiors(cube());
  auto const& unknowns = interiors.unknowns();
  ASSERT_EQ(unknowns.size(), 3);
  EXPECT_EQ(unknowns[0].name, "inside of cube");
  EXPECT_EQ(unknowns[1].name, "growth of cube");
  EXPECT_EQ(unknowns[2].name, "T1 within cube");

  auto const responses = interiors.responses(data);
  auto const rows = data.time.size();
  auto const last = [&](Eigen::Index channel, Eigen::Index unknown) {
    return responses((channel + 1) * rows - 1, unknown);
  };
  double const lead = power / (3.0 * thermal::material("GJL-300").conductivity * edge);
  double const growth = thermal::material("GJL-300").expansion * edge;
  enum { T1, T2, E_Z };
  enum { inside, grows, reads };
  EXPECT_NEAR(last(T1, inside), lead, 5e-3 * lead);
  EXPECT_NEAR(last(E_Z, inside), growth * lead, 5e-3 * growth * lead);  // as long as the tool follows the lump
  EXPECT_NEAR(last(E_Z, grows), -growth * lead, 5e-3 * growth * lead);  // the mean is where it was
  EXPECT_NEAR(last(T1, reads), -lead, 5e-3 * lead);
  for (auto const& [channel, unknown] : {std::pair{T2, inside}, {T2, grows}, {T2, reads}, {T1, grows}, {E_Z, reads}})
    EXPECT_NEAR(last(channel, unknown), 0.0, 1e-4 * lead);

  // The oil stays as cold as it was: a sensor a tenth of the way to it sees a tenth less of the rise P t/C.
  auto const& iron = thermal::material("GJL-300");
  double const rise = power * data.time[rows - 1] / (7.25 * iron.specific_heat);
  LinearUnknowns const all(cube(), {data}, {"T1", "T2", "E_Z"}, true);
  auto const near =
      std::find_if(all.all().begin(), all.all().end(), [](auto const& u) { return u.name == "T1 near oil"; });
  ASSERT_NE(near, all.all().end());
  Eigen::VectorXd const nearer = all.columns().col(near - all.all().begin());
  EXPECT_NEAR(nearer[(T1 + 1) * rows - 1], -0.1 * rise, 5e-3 * rise);
  EXPECT_EQ(nearer[(T2 + 1) * rows - 1], 0.0);
  EXPECT_EQ(nearer[(E_Z + 1) * rows - 1], 0.0);

  // C d(δT)/dt = C_i (q/C) exp(−t/τ'), τ' = L² (1 + π²/3)/(π² α), from the start on.
  double const time = edge * edge * (1.0 / (M_PI * M_PI) + 1.0 / 3.0) / thermal::diffusivity(iron);
  for (Eigen::Index r = 0; r < rows; ++r)
    EXPECT_NEAR(responses(r, inside), lead * (1.0 - std::exp(-data.time[r] / time)), 5e-3 * lead) << data.time[r];
}

}  // namespace
}  // namespace thermotwin::twin
