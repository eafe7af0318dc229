// Shipped machines through 9 h of spectrum at a relative tolerance of 1e-6, the integration alone: 40 % of what the
// machine can, then 75 %, 100 %, rest and so on; and v450 with forward sensitivities to 40 of its numbers.
// spectrum.py is the peer of Spectrum/v450, g200 and vmc850.
#include <benchmark/benchmark.h>
#include <string>
#include <utility>
#include <vector>

#include "scenarios/course.h"
#include "thermal/integrate.h"
#include "twin/machine.h"
#include "twin/sensitivity.h"

namespace thermotwin::twin {
namespace {

std::vector<std::pair<double, double>> const spectrum = {{0.25, 3600.0}, {0.5, 3600.0}, {0.75, 3600.0},
                                                         {1.0, 3600.0},  {0.0, 1800.0}, {0.75, 5400.0},
                                                         {0.5, 3600.0},  {1.0, 3600.0}, {0.0, 3600.0}};

constexpr char const* numbers[] = {"bar.shaft.outer_diameter",
                                   "bar.cartridge.outer_diameter",
                                   "lump.front_ring.heat_capacity",
                                   "lump.rear_ring.heat_capacity",
                                   "lump.head_front.mass",
                                   "lump.head_rear.mass",
                                   "lump.motor.mass",
                                   "lump.rotor.mass",
                                   "lump.column_front.mass",
                                   "lump.column_rear.mass",
                                   "lump.bed.mass",
                                   "joint.taper.conductance",
                                   "joint.front_seat.coefficient",
                                   "joint.front_seat.area",
                                   "joint.rear_seat.coefficient",
                                   "joint.rear_seat.area",
                                   "joint.cartridge_head.coefficient",
                                   "joint.cartridge_head.area",
                                   "joint.head.conductance",
                                   "joint.motor_flange.conductance",
                                   "joint.motor_gap.conductance",
                                   "joint.guide.conductance",
                                   "joint.column.conductance",
                                   "joint.column_front_foot.conductance",
                                   "joint.column_rear_foot.conductance",
                                   "bearing.front.conductance",
                                   "bearing.rear.conductance",
                                   "motor_loss.stator.constant",
                                   "motor_loss.stator.hysteresis",
                                   "motor_loss.stator.eddy",
                                   "motor_loss.rotor.constant",
                                   "motor_loss.rotor.hysteresis",
                                   "belt.belt.loss",
                                   "film.head_front.area",
                                   "film.head_rear.area",
                                   "film.motor.coefficient",
                                   "film.motor.area",
                                   "film.column_front.area",
                                   "film.column_rear.area",
                                   "film.bed.area"};

scenarios::Experiment experiment_on(Machine const& machine) {
  scenarios::Experiment experiment;
  experiment.ambient.mean = 295.15;
  experiment.duration = 0.0;
  for (auto const& [share, duration] : spectrum) experiment.duration += duration;
  if (machine.name != "vmc850") {
    experiment.spindle.emplace();
    for (auto const& [share, duration] : spectrum) experiment.spindle->blocks.push_back({duration, {}, share});
  } else {
    auto& axis = experiment.axes.emplace_back();
    axis.duty = 0.88;
    for (auto const& [share, duration] : spectrum) axis.blocks.push_back({duration, 0.27 * share, {}});
  }
  return experiment;
}

void integrate_spectrum(benchmark::State& state, std::string const& name,
                        std::vector<thermal::NetworkDerivative> const& parameters) {
  auto const machine = Machine::read(machine_file(name));
  auto const experiment = experiment_on(machine);
  scenarios::ExperimentCourse const course(experiment, machine.limits);
  auto const times = scenarios::sample_times(experiment);
  std::vector<double> const start(std::size_t(machine.network().nodes()), 295.15);
  thermal::IntegrationOptions options;
  options.parameters = parameters;
  for (auto _ : state) {
    auto const summary = thermal::integrate(machine.network(), course, start, times, options, [](auto const&) {});
    state.counters["nodes"] = double(start.size());
    state.counters["steps"] = double(summary.steps);
    state.counters["energy_imbalance"] = summary.energy_imbalance();
    state.SetLabel(std::string(name_of(summary.solver)));
  }
}

void Spectrum(benchmark::State& state, std::string const& name) { integrate_spectrum(state, name, {}); }
BENCHMARK_CAPTURE(Spectrum, v450, "v450")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Spectrum, vmc850, "vmc850")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Spectrum, g200, "g200")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Spectrum, v450_fine, "v450_fine")->Unit(benchmark::kMillisecond);

void SpectrumWithSensitivities(benchmark::State& state, std::string const& name) {
  auto const document = read_toml(machine_file(name));
  std::vector<thermal::NetworkDerivative> parameters;
  for (auto const* path : numbers) parameters.push_back(differentiate(document, path).network);
  integrate_spectrum(state, name, parameters);
}
BENCHMARK_CAPTURE(SpectrumWithSensitivities, v450, "v450")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace thermotwin::twin
