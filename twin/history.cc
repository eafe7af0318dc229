#include "twin/history.h"

#include <algorithm>
#include <fmt/format.h>

#include "scenarios/feed_program.h"
#include "thermal/error.h"
#include "thermal/units.h"
#include "twin/instruments/temperature_specimen.h"

namespace thermotwin::twin {
namespace {

constexpr double to_um = 1e6;

/// First entry of a screw's cells in History::screw_rise.
std::size_t first_cell(Machine const& machine, std::size_t screw) {
  std::size_t first = 0;
  for (std::size_t s = 0; s < screw; ++s) first += machine.screws[s].screw.edges.size() - 1;
  return first;
}

void note(output::Dataset& dataset, std::string const& instrument, std::map<std::string, double> const& drawn) {
  for (auto const& [property, value] : drawn)
    dataset.provenance["instrument." + instrument + "." + property] = thermal::format_number(value);
}

/// The sensor as it was drawn, with what the machine's parts do to its reading.
SensorDescription misread(SensorDescription sensor, Machine const& machine, InstrumentChannel const& channel) {
  for (auto const& term : machine.reading_terms) {
    if (term.of_displacement || term.channel != sensor.name) continue;
    auto const drawn = draw_specimen(sensor, channel);
    sensor.drift = drawn.drift + term.drift;
    sensor.lag = drawn.lag + term.lag;
    sensor.stem_loss = drawn.stem_loss + term.air_share;
  }
  return sensor;
}

void measure_temperatures(History const& history, InstrumentChannel channel, output::Dataset& dataset) {
  auto const times = history.times();
  auto const& sensors = history.machine->sensors;
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    channel.name = sensors[s].description.name;
    auto const readings =
        read(misread(sensors[s].description, *history.machine, channel), channel,
             {times, history.column(history.sensor_body, s), history.column(history.sensor_air, s)}, times);
    note(dataset, channel.name, readings.drawn);
    dataset.readings[s].values = readings.values;
  }
}

/// A displacement without a probe is shown as it is.
void measure_displacements(History const& history, InstrumentChannel channel, output::Dataset& dataset) {
  auto const times = history.times();
  auto const air = Eigen::Map<Eigen::VectorXd const>(history.air.data(), times.size());
  auto const speed = Eigen::Map<Eigen::VectorXd const>(history.spindle_speed.data(), times.size());
  for (std::size_t c = 0; c < dataset.displacements.size(); ++c)
    dataset.displacements[c].values = dataset.truth_displacements[c].values;
  auto const& channels = history.machine->displacements;
  for (auto const& probe : history.machine->probes)
    for (std::size_t c = 0; c < channels.size(); ++c) {
      if (channels[c].name != probe.of) continue;
      channel.name = probe.name;
      auto const readings =
          read(probe, channel, DisplacementCourse{times, history.column(history.displacement, c), air, speed}, times);
      note(dataset, channel.name, readings.drawn);
      dataset.displacements[c].values = readings.values;
    }
}

/// Channels X1 … Z of the nest are added; its errors take the place of the channels that they measure.
void measure_nest(History const& history, InstrumentChannel channel, output::Dataset& dataset) {
  auto const& machine = *history.machine;
  if (!machine.nest) return;
  auto const times = history.times();
  SpindleCourse course;
  course.time = times;
  course.errors = FiveColumns::Zero(times.size(), 5);
  course.air = Eigen::Map<Eigen::VectorXd const>(history.air.data(), times.size());
  course.spindle_speed = Eigen::Map<Eigen::VectorXd const>(history.spindle_speed.data(), times.size());
  auto const column_of = [&](std::string const& name) {
    std::string const plain = name.starts_with("E_A") || name.starts_with("E_B") ? name.substr(2) : name;
    auto const it = std::find_if(machine.displacements.begin(), machine.displacements.end(),
                                 [&](auto const& d) { return d.name == name || d.name == plain; });
    return it == machine.displacements.end() ? -1 : int(it - machine.displacements.begin());
  };
  for (int k = 0; k < 5; ++k)
    if (int const c = column_of(error_names[std::size_t(k)]); c >= 0)
      course.errors.col(k) = history.column(history.displacement, std::size_t(c));
  channel.name = "nest";
  auto const readings = read(*machine.nest, channel, course, times);
  note(dataset, channel.name, readings.drawn);
  for (int k = 0; k < 5; ++k) {
    if (int const c = column_of(error_names[std::size_t(k)]); c >= 0)
      dataset.displacements[std::size_t(c)].values = readings.errors.col(k);
    auto const& name = probe_names[std::size_t(k)];
    std::string const title = "probe " + name + " of the nest";
    dataset.displacements.push_back({name, "um", title, readings.probes.col(k)});
    dataset.truth_displacements.push_back({name, "um", title, readings.truth_probes.col(k)});
  }
}

/// What the machine's parts do to the readings of displacements.
void misread_displacements(History const& history, output::Dataset& dataset) {
  auto const times = history.times();
  auto const air = Eigen::Map<Eigen::VectorXd const>(history.air.data(), times.size());
  auto const& channels = history.machine->displacements;
  for (auto const& term : history.machine->reading_terms)
    for (std::size_t c = 0; c < channels.size(); ++c)
      if (term.of_displacement && channels[c].name == term.channel)
        dataset.displacements[c].values +=
            to_um * (term.drift * times.array() + term.per_air * (air.array() - air[0])).matrix();
}

Screw const& screw_of_laser(Machine const& machine, scenarios::LaserMeasurement const& laser) {
  auto const screw = std::find_if(machine.screws.begin(), machine.screws.end(),
                                  [&](auto const& s) { return s.description.axis == laser.axis; });
  if (screw == machine.screws.end())
    throw thermal::InputError(
        fmt::format("laser.axis: the laser measures axis '{}', but the machine has no ball_screw on it", laser.axis));
  return *screw;
}

void measure_positions(History const& history, scenarios::Experiment const& experiment, InstrumentChannel channel,
                       output::Dataset& dataset) {
  if (!experiment.laser) return;
  auto const& machine = *history.machine;
  auto const screw = std::size_t(&screw_of_laser(machine, *experiment.laser) - machine.screws.data());
  auto const limits = std::find_if(machine.limits.axes.begin(), machine.limits.axes.end(),
                                   [&](auto const& a) { return a.name == experiment.laser->axis; });
  double const start = limits == machine.limits.axes.end() ? 0.0 : limits->stroke_from;
  auto const times = history.times();
  auto const targets = scenarios::targets(*experiment.laser);
  Eigen::VectorXd positions = Eigen::Map<Eigen::VectorXd const>(targets.data(), Eigen::Index(targets.size()));
  Eigen::MatrixXd error(times.size(), positions.size());
  for (Eigen::Index r = 0; r < error.rows(); ++r)
    for (Eigen::Index p = 0; p < error.cols(); ++p)
      error(r, p) = history.position_error(screw, start + positions[p], std::size_t(r));
  LaserCourse course;
  course.error = error_table(times, positions, error);
  course.time = times;
  course.air = Eigen::Map<Eigen::VectorXd const>(history.air.data(), times.size());
  channel.name = "laser";
  auto const readings = read(machine.laser, channel, *experiment.laser, experiment.duration, course);
  note(dataset, channel.name, readings.drawn);
  dataset.positioning = {readings.readings};
  dataset.truth_positioning = {readings.truth};
}

}  // namespace

Eigen::VectorXd History::times() const {
  return Eigen::Map<Eigen::VectorXd const>(time.data(), Eigen::Index(time.size()));
}

Eigen::VectorXd History::column(std::vector<std::vector<double>> const& rows, std::size_t index) const {
  Eigen::VectorXd values(Eigen::Index(rows.size()));
  for (std::size_t r = 0; r < rows.size(); ++r) values[Eigen::Index(r)] = rows[r][index];
  return values;
}

double History::position_error(std::size_t screw, double x, std::size_t row) const {
  auto const& built = machine->screws[screw].screw;
  std::span<double const> const rise(screw_rise[row].data() + first_cell(*machine, screw), built.edges.size() - 1);
  return built.position_error(x, rise, screw_seats[row][screw]) - screw_reference[row][screw] * x;
}

std::vector<output::Channel> displacement_channels(Machine const& machine) {
  std::vector<output::Channel> channels;
  for (auto const& d : machine.displacements) channels.push_back({d.name, d.rotation ? "urad" : "um", d.title, {}});
  for (auto const& s : machine.screws)
    for (double x : s.description.positions)
      channels.push_back({s.channel_at(x),
                          "um",
                          fmt::format("position error of axis {} at {:g} mm of the {} screw", s.description.axis,
                                      x * 1e3, s.description.support),
                          {}});
  return channels;
}

Eigen::VectorXd displacement_row(History const& history, std::size_t row) {
  std::vector<double> values = history.displacement[row];
  auto const& screws = history.machine->screws;
  for (std::size_t s = 0; s < screws.size(); ++s)
    for (double x : screws[s].description.positions) values.push_back(history.position_error(s, x, row));
  return Eigen::Map<Eigen::VectorXd>(values.data(), Eigen::Index(values.size())) * to_um;
}

void check_laser(Machine const& machine, scenarios::Experiment const& experiment) {
  if (!experiment.laser) return;
  static_cast<void>(screw_of_laser(machine, *experiment.laser));
  static_cast<void>(scenarios::targets(*experiment.laser));
  static_cast<void>(scenarios::measurement_times(*experiment.laser, experiment.duration));
}

void measure(History const& history, scenarios::Experiment const& experiment, output::Dataset& dataset) {
  InstrumentChannel const channel{"", std::uint64_t(experiment.seed)};
  measure_temperatures(history, channel, dataset);
  measure_displacements(history, channel, dataset);
  measure_nest(history, channel, dataset);
  misread_displacements(history, dataset);
  measure_positions(history, experiment, channel, dataset);
}

}  // namespace thermotwin::twin
