#include "twin/run.h"

#include <fmt/format.h>

#include "output/dataset_file.h"
#include "output/fields.h"
#include "output/picture.h"
#include "thermal/error.h"
#include "thermal/modal_integration.h"
#include "thermal/physical_constant.h"
#include "thermal/units.h"
#include "twin/checkpoint.h"
#include "twin/edge_unit.h"
#include "twin/history.h"
#include "twin/room_air.h"
#include "twin/version.h"

namespace thermotwin::twin {
namespace {

/// What only other channels are made of is not shown.
bool is_shown(thermal::InputChannel const& channel) {
  return channel.name != "ambient.floor_temperature" && !channel.name.starts_with("clock.");
}

/// Of the sensors that have a place: none hangs in the air.
std::vector<output::SensorPlace> sensor_places(Machine const& machine) {
  std::vector<output::SensorPlace> places;
  for (auto const& sensor : machine.sensors)
    if (!sensor.weights.empty()) places.push_back({sensor.description.name, sensor.position});
  return places;
}

Eigen::VectorXd placed_readings(Machine const& machine, Eigen::VectorXd const& readings) {
  std::vector<double> placed;
  for (std::size_t i = 0; i < machine.sensors.size(); ++i)
    if (!machine.sensors[i].weights.empty()) placed.push_back(readings[Eigen::Index(i)]);
  return Eigen::Map<Eigen::VectorXd>(placed.data(), Eigen::Index(placed.size()));
}

/// Collects what the integrator shows and passes it on: history, partial file, fields.
class Recorder {
 public:
  Recorder(Machine const& machine, scenarios::Experiment const& experiment, scenarios::ExperimentCourse const& course,
           RunOptions const& options);
  /// When it has to be shown the machine.
  [[nodiscard]] std::vector<double> const& looks() const { return history_.looks(); }
  void operator()(thermal::Sample const& sample);
  output::Dataset finish(std::map<std::string, std::string> const& provenance);
  [[nodiscard]] output::Dataset const& dataset() const { return dataset_; }
  [[nodiscard]] ExtrapolationWatch const& watch() const { return watch_; }
  /// "; the rows so far are in run.h5.partial", if there are any.
  [[nodiscard]] std::string rows_so_far() const;

 private:
  output::Dataset make_head() const;
  /// Whether the look is one of the data set's samples.
  bool record_history(thermal::Sample const& sample);
  output::Row make_row(thermal::Sample const& sample);
  void keep(output::Row const& row);
  output::Frame make_frame(thermal::Sample const& sample);
  void show_field(thermal::Sample const& sample);
  void watch_ranges(thermal::Sample const& sample);

  Machine const& machine_;
  scenarios::Experiment const& experiment_;
  scenarios::ExperimentCourse const& course_;
  RunOptions const& options_;
  thermal::Evaluation evaluation_;
  History history_;
  std::vector<NodeWeights> sums_;  ///< that the history watches
  std::vector<double> watched_;
  output::Dataset dataset_;
  std::vector<output::Row> rows_;
  std::unique_ptr<output::DatasetWriter> writer_;
  std::unique_ptr<output::FieldSeries> fields_;
  std::vector<double> first_temperatures_, inputs_, watts_;
  std::vector<std::size_t> shown_inputs_, shown_parts_;
  std::vector<thermal::Unit> edge_units_;  ///< of the inputs shown
  double last_time_;                       ///< of the readings
  ExtrapolationWatch watch_;
  std::optional<output::Frame> last_frame_;
  double last_frame_time_ = 0.0;
};

Recorder::Recorder(Machine const& machine, scenarios::Experiment const& experiment,
                   scenarios::ExperimentCourse const& course, RunOptions const& options)
    : machine_(machine),
      experiment_(experiment),
      course_(course),
      options_(options),
      evaluation_(machine.network()),
      history_(machine, course, scenarios::sample_times(experiment)),
      sums_(watched_sums(machine)),
      watched_(sums_.size()),
      inputs_(course.channels().size()),
      watts_(machine.network().parts().size()),
      last_time_(history_.sample_times().back()),
      watch_(machine.network(), last_time_) {
  for (std::size_t i = 0; i < course.channels().size(); ++i)
    if (is_shown(course.channels()[i])) shown_inputs_.push_back(i);
  for (std::size_t p = 0; p < machine.network().parts().size(); ++p)
    if (!machine.network().parts()[p].starts_with("joint.") && machine.network().parts()[p] != "conduction")
      shown_parts_.push_back(p);
  dataset_ = make_head();
  for (auto const& input : dataset_.inputs) edge_units_.push_back(read_edge_unit(input.unit));
  if (options.dataset) writer_ = std::make_unique<output::DatasetWriter>(*options.dataset, dataset_);
  if (options.fields)
    fields_ = std::make_unique<output::FieldSeries>(
        *options.fields, machine.geometry,
        output::FieldOptions{experiment.ambient.mean - thermal::zero_celsius,
                             {{"machine", machine.name}, {"experiment", experiment.title}},
                             sensor_places(machine),
                             machine.up});
}

output::Dataset Recorder::make_head() const {
  output::Dataset head = head_of_run(machine_, experiment_, course_);
  for (std::size_t p : shown_parts_)
    head.heat.push_back({machine_.network().parts()[p], "W", "heat given to the bodies", {}});
  if (options_.node_temperatures) {
    head.node_temperatures.emplace(0, machine_.network().nodes());
    for (int i = 0; i < machine_.network().nodes(); ++i) head.node_names.push_back(machine_.network().node_name(i));
  }
  head.provenance.insert(options_.provenance.begin(), options_.provenance.end());
  head.provenance["nodes"] = options_.node_temperatures ? "yes" : "no";
  head.provenance["tolerance.relative"] = thermal::format_number(options_.integration.relative_tolerance);
  head.provenance["tolerance.absolute_K"] = thermal::format_number(options_.integration.absolute_tolerance);
  head.provenance["checkpoint_s"] = thermal::format_number(options_.checkpoint_interval);
  return head;
}

bool Recorder::record_history(thermal::Sample const& sample) {
  for (std::size_t w = 0; w < sums_.size(); ++w) {
    watched_[w] = 0.0;
    for (auto const& [node, weight] : sums_[w]) watched_[w] += weight * sample.temperatures[std::size_t(node)];
  }
  return history_.add(inputs_, watched_);
}

output::Row Recorder::make_row(thermal::Sample const& sample) {
  auto const row = history_.rows() - 1;
  output::Row out;
  out.time_s = sample.time;
  out.inputs.resize(Eigen::Index(shown_inputs_.size()));
  for (std::size_t k = 0; k < shown_inputs_.size(); ++k)
    out.inputs[Eigen::Index(k)] = edge_value(inputs_[shown_inputs_[k]], edge_units_[k]);
  out.truth_readings = history_.bodies_at(row).array() - thermal::zero_celsius;
  out.truth_displacements = history_.displacements_at(row);
  double const missing = std::nan("");
  out.readings = Eigen::VectorXd::Constant(out.truth_readings.size(), missing);
  out.displacements = Eigen::VectorXd::Constant(out.truth_displacements.size(), missing);
  evaluation_.heat_of_parts(sample.state.data(), sample.input.data(), watts_);
  out.heat.resize(Eigen::Index(shown_parts_.size()));
  for (std::size_t k = 0; k < shown_parts_.size(); ++k) out.heat[Eigen::Index(k)] = watts_[shown_parts_[k]];
  if (options_.node_temperatures) {
    int const n = machine_.network().nodes();
    out.node_temperatures = Eigen::Map<Eigen::VectorXd const>(sample.temperatures.data(), n).cast<float>().array() -
                            float(thermal::zero_celsius);
  }
  return out;
}

output::Frame Recorder::make_frame(thermal::Sample const& sample) {
  int const n = machine_.network().nodes();
  output::Frame frame;
  frame.temperature_degC =
      Eigen::Map<Eigen::VectorXd const>(sample.temperatures.data(), n).array() - thermal::zero_celsius;
  frame.heat_source_W.resize(n);
  evaluation_.source_of_nodes(sample.state.data(), sample.input.data(), {frame.heat_source_W.data(), std::size_t(n)});
  Eigen::VectorXd const rise = Eigen::Map<Eigen::VectorXd const>(sample.temperatures.data(), n) -
                               Eigen::Map<Eigen::VectorXd const>(first_temperatures_.data(), n);
  frame.displacement_m = thermal::growth_field(machine_.growing, {rise.data(), std::size_t(n)});
  return frame;
}

void Recorder::show_field(thermal::Sample const& sample) {
  bool const last = sample.time >= last_time_;
  bool const due = sample.time == 0.0 || last || sample.time >= last_frame_time_ + options_.field_interval - 1e-6;
  if (!due || (!fields_ && !(options_.picture && last))) return;
  last_frame_ = make_frame(sample);
  last_frame_time_ = sample.time;
  last_frame_->sensor_degC = placed_readings(machine_, rows_.back().truth_readings);
  if (fields_) fields_->add(sample.time, *last_frame_);
}

void Recorder::watch_ranges(thermal::Sample const& sample) {
  if (!watch_.is_due(sample.time)) return;
  auto const temperatures = evaluation_.temperatures(sample.state.data(), sample.input.data());
  watch_.look(sample.time, temperatures.data(), evaluation_.inputs().data());
}

void Recorder::operator()(thermal::Sample const& sample) {
  for (int i = 0; i < machine_.network().nodes(); ++i)
    check_temperature(machine_.network(), i, sample.temperatures[std::size_t(i)], sample.time);
  course_.evaluate(sample.time, inputs_);
  if (first_temperatures_.empty()) first_temperatures_.assign(sample.temperatures.begin(), sample.temperatures.end());
  if (record_history(sample)) {
    rows_.push_back(make_row(sample));
    if (writer_) writer_->append(rows_.back());
    show_field(sample);
    if (options_.watch_ranges) watch_ranges(sample);
  }
  if (options_.progress) options_.progress(experiment_.duration > 0.0 ? sample.time / experiment_.duration : 1.0);
  if (!options_.stop || !*options_.stop) return;
  if (!options_.dataset && !options_.fields) throw Interrupted("stopped; nothing was written");
  throw Interrupted(
      fmt::format("stopped at t = {:.0f} s of {:.0f} s{}{}", sample.time, experiment_.duration, rows_so_far(),
                  options_.checkpoint ? "; the same command with --resume goes on from the last checkpoint" : ""));
}

std::string Recorder::rows_so_far() const {
  return writer_ && !rows_.empty() ? "; the rows so far are in " + writer_->partial_path().string() : "";
}

/// Turns the rows into the data set's courses.
void Recorder::keep(output::Row const& row) {
  auto const put = [&](std::vector<output::Channel>& channels, Eigen::VectorXd const& values, Eigen::Index r) {
    for (std::size_t c = 0; c < channels.size(); ++c) channels[c].values[r] = values[Eigen::Index(c)];
  };
  auto const r = Eigen::Index(&row - rows_.data());
  dataset_.time_s[r] = row.time_s;
  put(dataset_.inputs, row.inputs, r);
  put(dataset_.truth_readings, row.truth_readings, r);
  put(dataset_.truth_displacements, row.truth_displacements, r);
  put(dataset_.heat, row.heat, r);
  if (options_.node_temperatures) dataset_.node_temperatures->row(r) = row.node_temperatures;
}

output::Dataset Recorder::finish(std::map<std::string, std::string> const& provenance) {
  output::resize_rows(dataset_, Eigen::Index(rows_.size()));
  for (auto const& row : rows_) keep(row);
  measure(history_, experiment_, dataset_);
  for (auto const& [key, text] : provenance) dataset_.provenance[key] = text;
  if (writer_) {
    writer_->set_measured(dataset_.readings, dataset_.displacements, dataset_.truth_displacements);
    writer_->set_positioning(dataset_.positioning, dataset_.truth_positioning);
    writer_->finish(dataset_.provenance);
  }
  if (options_.picture && last_frame_) {
    output::PictureOptions picture;
    picture.title = machine_.title;
    picture.time_s = last_frame_time_;
    picture.up = machine_.up;
    for (auto const& sensor : machine_.sensors)
      if (!sensor.weights.empty()) picture.sensors.push_back({sensor.description.name, sensor.position});
    output::render_picture(machine_.geometry, *last_frame_, *options_.picture, picture);
  }
  return dataset_;
}

std::map<std::string, std::string> solver_provenance(thermal::IntegrationSummary const& summary) {
  return {{"solver.linear", std::string(name_of(summary.solver))},
          {"solver.steps", std::to_string(summary.steps)},
          {"solver.rate_evaluations", std::to_string(summary.rate_evaluations)},
          {"solver.jacobian_evaluations", std::to_string(summary.jacobian_evaluations)},
          {"solver.restarts", std::to_string(summary.restarts)},
          {"solver.relay_switches", std::to_string(summary.relay_switches)},
          {"energy.supplied_J", thermal::format_number(summary.energy.supplied)},
          {"energy.withdrawn_J", thermal::format_number(summary.energy.withdrawn)},
          {"energy.lost_J", thermal::format_number(summary.energy.lost)},
          {"energy.stored_J", thermal::format_number(summary.stored)},
          {"energy.imbalance", thermal::format_number(summary.energy_imbalance())}};
}

std::vector<double> jumps_of(thermal::Course const& course, double duration) {
  std::vector<double> jumps;
  for (double t = course.next_jump(0.0); t <= duration; t = course.next_jump(t)) jumps.push_back(t);
  return jumps;
}

RunResult run_in_modes(Machine const& machine, scenarios::Experiment const& experiment, RunOptions const& options) {
  scenarios::ExperimentCourse const course(experiment, machine.limits);
  check_laser(machine, experiment);
  Recorder recorder(machine, experiment, course, options);
  RunResult result;
  result.jumps = jumps_of(course, experiment.duration);
  result.summary = thermal::integrate_in_modes(
      machine.network(), course, initial_temperatures(machine, experiment, course), recorder.looks(),
      options.integration, [&](thermal::Sample const& sample) { recorder(sample); });
  result.dataset = recorder.finish({{"solver.steps", std::to_string(result.summary.steps)},
                                    {"solver.rate_evaluations", std::to_string(result.summary.rate_evaluations)}});
  return result;
}

}  // namespace

void check_temperature(thermal::Network const& network, int node, double temperature, double time) {
  if ((temperature >= 0.0 && temperature <= hottest_temperature) || network.signals()[std::size_t(node)]) return;
  throw thermal::InputError(fmt::format(
      "'{}' is at {:.4g} °C at t = {:.6g} s; a run ends where a temperature leaves 0 to {:g} K ({:g} to {:g} °C): is "
      "a heat, a speed or a conductance wrong by powers of ten?",
      network.node_name(node), temperature - thermal::zero_celsius, time, hottest_temperature, -thermal::zero_celsius,
      hottest_temperature - thermal::zero_celsius));
}

std::string balance_remark(thermal::IntegrationSummary const& summary) {
  double const imbalance = summary.energy_imbalance();
  if (imbalance <= largest_imbalance || imbalance * summary.moved() <= least_gap) return "";
  return fmt::format(
      "the heat balance closes to {:.1e} only, where {:.0e} is due: the numbers of this run are not to be trusted; is "
      "a length, a mass or a conductance wrong by powers of ten?",
      imbalance, largest_imbalance);
}

std::vector<double> initial_temperatures(Machine const& machine, scenarios::Experiment const& experiment,
                                         thermal::Course const& course) {
  std::vector<double> values(course.channels().size());
  course.evaluate(0.0, values);
  RoomAir const air(course);
  std::vector<double> temperatures;
  for (double const height : heights_of_nodes(machine))
    temperatures.push_back(experiment.initial_temperature.value_or(air.at(height, values)));
  for (std::size_t i = 0; i < temperatures.size(); ++i)
    if (machine.network().signals()[i]) temperatures[i] = 0.0;  // a controller has no past
  return temperatures;
}

output::Dataset head_of_run(Machine const& machine, scenarios::Experiment const& experiment,
                            scenarios::ExperimentCourse const& course) {
  output::Dataset head;
  head.title = experiment.title.empty() ? machine.name : fmt::format("{}: {}", machine.name, experiment.title);
  head.inputs = input_channels(course);
  for (auto const& sensor : machine.sensors)
    head.readings.push_back({sensor.description.name, "degC", sensor.description.title, {}});
  head.displacements = displacement_channels(machine);
  head.truth_readings = head.readings;
  head.truth_displacements = head.displacements;
  head.provenance["version"] = std::string(version());
  head.provenance["commit"] = std::string(commit());
  head.provenance["seed"] = std::to_string(experiment.seed);
  return head;
}

std::vector<output::Channel> input_channels(scenarios::ExperimentCourse const& course) {
  std::vector<output::Channel> channels;
  for (auto const& channel : course.channels())
    if (is_shown(channel)) channels.push_back({channel.name, edge_unit(channel), channel.description, {}});
  return channels;
}

RunResult run(Machine const& machine, scenarios::Experiment const& experiment, RunOptions const& options) {
  if (options.in_modes) return run_in_modes(machine, experiment, options);
  scenarios::ExperimentCourse const course(experiment, machine.limits);
  check_laser(machine, experiment);
  auto const& network = machine.network();
  auto state = thermal::start_of_run(network, initial_temperatures(machine, experiment, course), 0.0);
  Recorder recorder(machine, experiment, course, options);
  auto const& times = recorder.looks();
  std::optional<Checkpoint> checkpoint;
  std::size_t done = 0;
  if (options.checkpoint) {
    checkpoint.emplace(*options.checkpoint, recorder.dataset().provenance, options.resume);
    done = checkpoint->replay(network, state, [&](thermal::Sample const& sample) { recorder(sample); });
  }
  auto const observe = [&](thermal::Sample const& sample) {
    recorder(sample);
    if (checkpoint) checkpoint->keep(sample);
  };
  try {
    for (std::size_t const end : stretches(times, options.checkpoint_interval)) {
      if (end <= done) continue;
      integrate(network, course, state, std::span(times).subspan(done, end - done), options.integration, observe);
      done = end;
      if (checkpoint && done < times.size()) checkpoint->write(state);
    }
  } catch (thermal::InputError const& error) {
    throw thermal::InputError(error.what() + recorder.rows_so_far());
  } catch (thermal::IntegrationError const& error) {
    throw thermal::IntegrationError(error.what() + recorder.rows_so_far());
  }
  RunResult result;
  result.jumps = jumps_of(course, experiment.duration);
  result.summary = state.summary;
  result.dataset = recorder.finish(solver_provenance(result.summary));
  result.extrapolated = recorder.watch().found(result.summary.moved());
  if (checkpoint) checkpoint->remove();
  return result;
}

}  // namespace thermotwin::twin
