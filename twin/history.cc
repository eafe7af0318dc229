#include "twin/history.h"

#include <algorithm>
#include <fmt/format.h>

#include "scenarios/feed_program.h"
#include "thermal/error.h"
#include "thermal/units.h"
#include "twin/instruments/sampling.h"
#include "twin/instruments/temperature_specimen.h"

namespace thermotwin::twin {
namespace {

constexpr double to_um = 1e6;

/// Of a screw in a row of values: the parting of its seats [m], the strain of what it is measured against [1], the
/// rises of its cells [K].
constexpr std::size_t screw_seats = 0, screw_reference = 1, screw_zero = 2, screw_cells = 3;

std::size_t width_of(Screw const& screw) { return screw_cells + screw.screw.edges.size() - 1; }

Eigen::VectorXd vector_of(std::vector<double> const& values) {
  return Eigen::Map<Eigen::VectorXd const>(values.data(), Eigen::Index(values.size()));
}

/// Of the rows, those that are samples.
Eigen::ArrayXd sampled(History const& history, Eigen::VectorXd const& column) {
  Eigen::ArrayXd values(Eigen::Index(history.sampled().size()));
  for (Eigen::Index k = 0; k < values.size(); ++k) values[k] = column[Eigen::Index(history.sampled()[std::size_t(k)])];
  return values;
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
  auto const times = history.times(), samples = vector_of(history.sample_times());
  auto const& sensors = history.machine().sensors;
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    channel.name = sensors[s].description.name;
    auto const readings = read(misread(sensors[s].description, history.machine(), channel), channel,
                               {times, history.sensor_body(s), history.sensor_air(s)}, samples);
    note(dataset, channel.name, readings.drawn);
    dataset.readings[s].values = readings.values;
  }
}

/// A displacement without a probe is shown as it is.
void measure_displacements(History const& history, InstrumentChannel channel, output::Dataset& dataset) {
  for (std::size_t c = 0; c < dataset.displacements.size(); ++c)
    dataset.displacements[c].values = dataset.truth_displacements[c].values;
  auto const& channels = history.machine().displacements;
  for (auto const& probe : history.machine().probes)
    for (std::size_t c = 0; c < channels.size(); ++c) {
      if (channels[c].name != probe.of) continue;
      channel.name = probe.name;
      DisplacementCourse const course{history.times(), history.displacement(c), history.air(), history.spindle_speed()};
      auto const readings = read(probe, channel, course, vector_of(history.sample_times()));
      note(dataset, channel.name, readings.drawn);
      dataset.displacements[c].values = readings.values;
    }
}

/// Channels X1 … Z of the nest are added; its errors take the place of the channels that they measure.
void measure_nest(History const& history, InstrumentChannel channel, output::Dataset& dataset) {
  auto const& machine = history.machine();
  if (!machine.nest) return;
  SpindleCourse course;
  course.time = history.times();
  course.errors = FiveColumns::Zero(course.time.size(), 5);
  course.air = history.air();
  course.spindle_speed = history.spindle_speed();
  auto const column_of = [&](std::string const& name) {
    std::string const plain = name.starts_with("E_A") || name.starts_with("E_B") ? name.substr(2) : name;
    auto const it = std::find_if(machine.displacements.begin(), machine.displacements.end(),
                                 [&](auto const& d) { return d.name == name || d.name == plain; });
    return it == machine.displacements.end() ? -1 : int(it - machine.displacements.begin());
  };
  for (int k = 0; k < 5; ++k)
    if (int const c = column_of(error_names[std::size_t(k)]); c >= 0)
      course.errors.col(k) = history.displacement(std::size_t(c));
  channel.name = "nest";
  auto const readings = read(*machine.nest, channel, course, vector_of(history.sample_times()));
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
  auto const times = sampled(history, history.times()), air = sampled(history, history.air());
  for (auto const& term : history.machine().reading_terms)
    for (auto& channel : dataset.displacements)
      if (term.of_displacement && channel.name == term.channel)
        channel.values += to_um * (term.drift * times + term.per_air * (air - air[0])).matrix();
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
  auto const& machine = history.machine();
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
  course.air = history.air();
  channel.name = "laser";
  auto const readings = read(machine.laser, channel, *experiment.laser, experiment.duration, course);
  note(dataset, channel.name, readings.drawn);
  dataset.positioning = {readings.readings};
  dataset.truth_positioning = {readings.truth};
}

}  // namespace

std::vector<NodeWeights> watched_sums(Machine const& machine) {
  std::vector<NodeWeights> sums;
  for (auto const& sensor : machine.sensors) sums.push_back(sensor.weights);
  for (auto const& channel : machine.displacements) sums.push_back(channel.weights);
  for (auto const& screw : machine.screws) {
    sums.push_back(screw.seat_growth);
    sums.push_back(screw.reference_strain);
    sums.push_back(screw.zero_shift);
    for (int i = 0; i + 1 < int(screw.screw.edges.size()); ++i) sums.push_back({{screw.first_node + i, 1.0}});
  }
  return sums;
}

History::History(Machine const& machine, thermal::Course const& course, std::vector<double> const& sample_times)
    : machine_(&machine),
      samples_(sample_times),
      looks_(twin::looks(sample_times, course)),
      air_(course),
      speed_(course.index_of("spindle.speed")) {
  for (auto const& displacement : machine.displacements) motions_.emplace_back(displacement.input_terms, course);
  auto const width = first_of_screw(machine.screws.size()) + 2;
  values_.resize(Eigen::Index(looks_.size()), Eigen::Index(width));
}

std::size_t History::first_of_screw(std::size_t screw) const {
  std::size_t first = first_displacement() + machine_->displacements.size();
  for (std::size_t s = 0; s < screw; ++s) first += width_of(machine_->screws[s]);
  return first;
}

bool History::add(std::span<double const> inputs, std::span<double const> watched) {
  if (rows_ == 0) {
    first_inputs_.assign(inputs.begin(), inputs.end());
    first_watched_.assign(watched.begin(), watched.end());
  }
  double* const row = values_.data() + rows_ * std::size_t(values_.cols());
  auto const& sensors = machine_->sensors;
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    double const air = air_.at(sensors[s].position.dot(machine_->up), inputs);
    row[s] = sensors[s].weights.empty() ? air : watched[s];
    row[sensors.size() + s] = air;
  }
  double* next = row + first_displacement();
  for (std::size_t w = sensors.size(); w < watched.size(); ++w) *next++ = watched[w] - first_watched_[w];
  *next++ = speed_ < 0 ? 0.0 : inputs[std::size_t(speed_)];
  *next = air_.at(height_near_tool, inputs);
  for (std::size_t d = 0; d < motions_.size(); ++d) row[first_displacement() + d] += motions_[d](inputs, first_inputs_);
  bool const sample = looks_[rows_] == samples_[sampled_.size()];
  if (sample) sampled_.push_back(rows_);
  ++rows_;
  return sample;
}

Eigen::VectorXd History::column(std::size_t index) const {
  return values_.col(Eigen::Index(index)).head(Eigen::Index(rows_));
}

Eigen::VectorXd History::times() const { return Eigen::Map<Eigen::VectorXd const>(looks_.data(), Eigen::Index(rows_)); }
Eigen::VectorXd History::sensor_body(std::size_t sensor) const { return column(sensor); }
Eigen::VectorXd History::sensor_air(std::size_t sensor) const { return column(machine_->sensors.size() + sensor); }
Eigen::VectorXd History::displacement(std::size_t channel) const { return column(first_displacement() + channel); }
Eigen::VectorXd History::spindle_speed() const { return column(first_of_screw(machine_->screws.size())); }
Eigen::VectorXd History::air() const { return column(first_of_screw(machine_->screws.size()) + 1); }

Eigen::VectorXd History::bodies_at(std::size_t row) const {
  return values_.row(Eigen::Index(row)).head(Eigen::Index(machine_->sensors.size()));
}

double History::position_error(std::size_t screw, double x, std::size_t row) const {
  auto const& built = machine_->screws[screw].screw;
  double const* const own = values_.data() + row * std::size_t(values_.cols()) + first_of_screw(screw);
  std::span<double const> const rise(own + screw_cells, built.edges.size() - 1);
  return built.position_error(x, rise, own[screw_seats]) - own[screw_reference] * x + own[screw_zero];
}

Eigen::VectorXd History::displacements_at(std::size_t row) const {
  double const* const own = values_.data() + row * std::size_t(values_.cols()) + first_displacement();
  std::vector<double> values(own, own + machine_->displacements.size());
  auto const& screws = machine_->screws;
  for (std::size_t s = 0; s < screws.size(); ++s)
    for (double x : screws[s].description.positions) values.push_back(position_error(s, x, row));
  return vector_of(values) * to_um;
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

void check_laser(Machine const& machine, scenarios::Experiment const& experiment) {
  if (!experiment.laser) return;
  auto const& laser = *experiment.laser;
  static_cast<void>(screw_of_laser(machine, laser));
  auto const targets = scenarios::targets(laser);
  for (auto const& axis : machine.limits.axes) {
    if (axis.name != laser.axis) continue;
    auto const length = [](double x) { return thermal::format_quantity(x, thermal::dimension::length); };
    auto const on_screw = [&](std::string const& key, double target) {
      scenarios::require_on_screw(axis.stroke_from + target, axis,
                                  fmt::format("laser.{}: {} from the start of the stroke, ", key, length(target)));
    };
    on_screw("from", targets.front());
    on_screw("to", targets.back());
  }
  static_cast<void>(scenarios::measurement_times(laser, experiment.duration));
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
