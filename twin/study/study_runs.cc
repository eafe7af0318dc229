#include "twin/study/study_runs.h"

#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>

#include "scenarios/course.h"
#include "thermal/course_inputs.h"
#include "thermal/nearest_name.h"
#include "thermal/physical_constant.h"
#include "twin/diagnosis/measured_data.h"
#include "twin/diagnosis/measured_run.h"
#include "twin/experiment_file.h"
#include "twin/file/document.h"
#include "twin/file/value.h"
#include "twin/history.h"
#include "twin/parallel.h"
#include "twin/run.h"
#include "twin/study/combinations.h"

namespace thermotwin::twin {
namespace {

namespace fs = std::filesystem;

constexpr double tolerance = 1e-6;

/// A run as a world names it.
struct Source {
  fs::path file;
  bool measured = false;
  Location named = {};  ///< where in the study's file
};

fs::path measured_folder() { return fs::path(THERMOTWIN_SOURCE_DIR) / "scenarios" / "measured"; }

Source source_of(std::string const& name, fs::path const& directory) {
  fs::path const given = name;
  if (given.extension() == ".toml" || given.extension() == ".h5" || given.extension() == ".csv") {
    auto const file = given.is_absolute() ? given : directory / given;
    if (!fs::exists(file)) throw thermal::InputError(fmt::format("'{}' is not there: {}", name, file.string()));
    return {file, given.extension() != ".toml" || !read_toml(file).find("duration")};
  }
  if (auto const shipped = measured_folder() / (name + ".toml"); fs::exists(shipped)) return {shipped, true};
  return {experiment_file(name), false};
}

Value nominal_machine(StudyWorld const& world, fs::path const& directory) {
  fs::path const given = world.machine;
  bool const beside = given.extension() == ".toml" && fs::exists(directory / given);
  return read_toml(beside ? directory / given : machine_file(world.machine));
}

Value changed_machine(StudyWorld const& world, Value document) {
  for (auto const& change : world.changes) {
    auto const equals = change.find('=');
    if (equals == std::string::npos)
      throw thermal::InputError(fmt::format("'{}': write a change as path=value", change));
    set_parameter(document, change.substr(0, equals), change.substr(equals + 1));
  }
  Value const added = parse_toml(world.added, "add");
  for (auto const& [kind, where, tables] : std::get<Value::Table>(added.content)) {
    if (!tables.is_list())
      throw FileError(where, fmt::format("'{}' is no [[{}]]; only tables can be added", kind, kind));
    for (auto const& table : std::get<Value::List>(tables.content)) append_table(document, kind, table);
  }
  return document;
}

/// What a world asks for: the machine, if it names one, and the runs, by file.
struct Order {
  StudyWorld const* world;
  std::vector<Source> sources;
  Value nominal{};
  std::optional<Machine> machine{};
  std::vector<WorldSensor> sensors{};
  std::string unit{};
};

template <class Action>
auto in_world(StudyWorld const& world, Action action) {
  try {
    return action();
  } catch (FileError const&) {
    throw;
  } catch (thermal::InputError const& error) {
    throw about(world, error.what());
  }
}

/// A complaint about a run stands where the study names it.
FileError about(StudyWorld const& world, Source const& source, std::string const& complaint) {
  return FileError(source.named, fmt::format("world '{}': {}", world.name, complaint));
}

/// A complaint about what the world changes stands in the study's file.
Machine machine_of(StudyWorld const& world, Value const& nominal) {
  if (world.changes.empty() && world.added.empty()) return in_world(world, [&] { return Machine::build(nominal); });
  try {
    return Machine::build(changed_machine(world, nominal));
  } catch (thermal::InputError const& error) {
    throw about(world, error.what());
  }
}

std::vector<Source> sources_of(StudyWorld const& world, fs::path const& directory) {
  std::vector<Source> sources;
  for (auto const& [key, names] : {std::pair{"train", &world.train}, {"test", &world.test}})
    for (std::size_t i = 0; i < names->size(); ++i) {
      sources.push_back(source_of((*names)[i], directory));
      if (world.table.is_table()) sources.back().named = where_of_item(world.table, key, i);
    }
  return sources;
}

/// Before hours of runs.
std::string unit_of_error(StudyWorld const& world, std::vector<output::Channel> const& displacements,
                          std::string const& whose) {
  if (world.slope()) return "um/m";
  auto const* channel = find_channel(displacements, world.error);
  if (!channel)
    throw thermal::InputError(fmt::format("{} has no displacement '{}'; {}", whose, world.error,
                                          thermal::did_you_mean(world.error, names_of(displacements))));
  return thermal::dimension_of(channel->unit) == thermal::dimension::angle ? "urad" : "um";
}

/// Of a measured run nobody knows what a laser would have seen.
void refuse_slope_of_measured(StudyWorld const& world, std::vector<Source> const& sources) {
  if (!world.slope()) return;
  for (auto const& source : sources)
    if (source.measured)
      throw about(world, source,
                  fmt::format("'{}' was measured, and a slope is of simulated experiments only; give a displacement as "
                              "'error' in place of '{}'",
                              source.file.filename().string(), world.error));
}

void check_axis(Order const& order, std::optional<scenarios::LaserMeasurement> const& laser) {
  auto const& error = order.world->error;
  if (!order.world->slope() || (laser && laser->axis == error.substr(slope_prefix.size()))) return;
  std::set<std::string> axes;
  for (auto const& screw : order.machine->screws) axes.insert(screw.description.axis);
  throw thermal::InputError(
      fmt::format("the experiment has no laser measurement of axis '{}', which '{}' is of; {}",
                  error.substr(slope_prefix.size()), error,
                  axes.empty() ? "the machine has no ball_screw that one could measure"
                               : fmt::format("its [laser] can measure, by the machine: {}", fmt::join(axes, ", "))));
}

/// `last` [s] is the time of the run's last reading.
void check_split(StudyWorld const& world, Source const& source, double last) {
  if (!world.split || *world.split < last) return;
  auto const text = [](double time) { return thermal::format_quantity(time, thermal::dimension::time); };
  throw FileError(world.table.is_table() ? where_of(world.table, "split") : Location{},
                  fmt::format("world '{}': 'split' is {}, but {} ends at {}; a time before is due", world.name,
                              text(*world.split), source.file.filename().string(), text(last)));
}

/// Before hours of runs.
void check_candidates(Order const& order) {
  auto const& world = *order.world;
  std::vector<std::string> known;
  for (auto const& sensor : order.sensors) known.push_back(sensor.name);
  for (auto const& name : world.sensors)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw thermal::InputError(fmt::format("{} has no sensor '{}'; {}",
                                            order.machine ? "the machine" : world.train.front(), name,
                                            thermal::did_you_mean(name, known)));
}

scenarios::Experiment experiment_of(Order const& order, Source const& source) {
  auto experiment = read_experiment(read_toml(source.file), source.file);
  if (order.world->sampling) experiment.sampling = *order.world->sampling;
  return experiment;
}

/// Before hours of runs: a complaint says which of the world's experiments it is.
void check_experiments(Order const& order) {
  for (auto const& source : order.sources) {
    if (source.measured) continue;
    scenarios::Experiment experiment;
    try {
      experiment = experiment_of(order, source);
      check_laser(*order.machine, experiment);
      check_axis(order, experiment.laser);
      scenarios::ExperimentCourse const course(experiment, order.machine->limits);
      thermal::CourseInputs const inputs(order.machine->network(), course);
    } catch (thermal::InputError const& error) {
      auto const complaint = located_in(read_toml(source.file), error);
      throw about(*order.world, source, fmt::format("'{}': {}", source.file.filename().string(), complaint.what()));
    }
    check_split(*order.world, source, experiment.duration);
  }
}

void take_machine(Order& order, fs::path const& directory) {
  auto const& world = *order.world;
  Value const nominal = in_world(world, [&] { return nominal_machine(world, directory); });
  order.machine = machine_of(world, nominal);
  for (auto const& sensor : order.machine->sensors)
    order.sensors.push_back({sensor.description.name, sensor.description.component});
  in_world(world, [&] {
    order.unit = unit_of_error(world, displacement_channels(*order.machine), "the machine");
    bool const simulated = std::any_of(order.sources.begin(), order.sources.end(), [](auto& s) { return !s.measured; });
    order.nominal = simulated ? nominal : changed_machine(world, nominal);
  });
  check_experiments(order);
}

/// A world that names no machine knows what its first run shows.
void take_first_run(Order& order) {
  auto const& world = *order.world;
  for (auto const& source : order.sources)
    if (!source.measured)
      throw about(
          world, source,
          fmt::format("'{}' is an experiment; give the 'machine' that is put through it", source.file.stem().string()));
  in_world(world, [&] {
    auto const data = read_measured_data(order.sources.front().file);
    for (auto const& sensor : data.readings) order.sensors.push_back({sensor.name, sensor.name});
    order.unit = unit_of_error(world, data.displacements, world.train.front());
  });
}

Order order_of(StudyWorld const& world, fs::path const& directory) {
  Order order{&world, in_world(world, [&] { return sources_of(world, directory); })};
  refuse_slope_of_measured(world, order.sources);
  if (world.machine.empty())
    take_first_run(order);
  else
    take_machine(order, directory);
  in_world(world, [&] { check_candidates(order); });
  return order;
}

/// One data set to be made, for all worlds that share it.
struct Job {
  Order const* order;
  Source source;
  int seed = 0;  ///< of the instruments; 0: measured
  output::Dataset data;
  std::shared_ptr<MeasuredRun const> run;  ///< what was measured
};

std::string key_of(Order const& order, Source const& source, int seed) {
  return fmt::format("{}|{}|{}|{}|{}|{}", order.world->machine, order.world->added,
                     fmt::join(order.world->changes, ","), source.file.string(), order.world->sampling.value_or(0.0),
                     seed);
}

/// What lacks the machine's inputs can be studied without it.
MeasuredRun run_on(std::optional<Machine> const& machine, fs::path const& file) {
  auto const data = read_measured_data(file);
  auto const name = file.stem().string();
  if (!machine) return measured_run(data, name);
  try {
    return measured_run(data, *machine, name);
  } catch (MissingInputs const& error) {
    throw thermal::InputError(fmt::format("{}; without 'machine' the world is its readings alone", error.what()));
  }
}

/// A complaint about what the run lacks stands where the study names it.
MeasuredRun read_run(Order const& order, Source const& source) {
  try {
    return naming(source.file, [&] { return run_on(order.machine, source.file); });
  } catch (FileError const&) {
    throw;
  } catch (thermal::InputError const& error) {
    if (source.named.line == 0) throw;
    throw about(*order.world, source, error.what());
  }
}

MeasuredRun measured(Order const& order, Source const& source) {
  auto run = read_run(order, source);
  check_split(*order.world, source, run.time[run.time.size() - 1] - run.time[first_reading(run)]);
  auto const& sampling = order.world->sampling;
  double const own = usual_interval({run.time.data(), std::size_t(run.time.size())});
  if (sampling && *sampling < own * (1.0 - 1e-6))
    throw thermal::InputError(fmt::format("'sampling' is {:g} s, finer than the {:g} s between the rows of {}",
                                          *sampling, own, source.file.filename().string()));
  return run;
}

output::Dataset simulated(Job const& job, std::atomic<bool> const* stop) {
  auto experiment = experiment_of(*job.order, job.source);
  experiment.seed = job.seed;
  RunOptions options;
  options.integration.relative_tolerance = options.integration.absolute_tolerance = tolerance;
  options.stop = stop;
  return run(*job.order->machine, experiment, options).dataset;
}

/// What no world has, nobody can choose. What only some have, the others refuse.
void check_selections(Study const& study, std::vector<Order> const& orders) {
  std::vector<std::string> known;
  std::size_t most = 0;
  for (auto const& order : orders) {
    most = std::max(most, order.sensors.size());
    for (auto const& sensor : order.sensors)
      if (std::find(known.begin(), known.end(), sensor.name) == known.end()) known.push_back(sensor.name);
  }
  std::vector<std::pair<std::string, NamedSelection>> written;
  for (auto const& text : study.description.selections) written.emplace_back(text, named_selection(text));
  for (auto const& text : study.description.also)
    written.emplace_back(text, named_selection(named_combination(text).selection));
  for (auto const& [text, selection] : written) {
    for (auto const& name : selection.sensors)
      if (std::find(known.begin(), known.end(), name) == known.end())
        throw about(study.document, fmt::format("'{}': no world of the study has a sensor '{}'; {}", text, name,
                                                thermal::did_you_mean(name, known)));
    if (selection.count && std::size_t(*selection.count) > most)
      throw about(study.document, fmt::format("'{}': the worlds of the study have {} sensors at most", text, most));
  }
}

std::vector<Order> orders_of(Study const& study) {
  std::vector<Order> orders;
  for (auto const& world : study.description.worlds) orders.push_back(order_of(world, study.directory));
  check_selections(study, orders);
  return orders;
}

}  // namespace

void check_worlds(Study const& study) {
  for (auto const& order : orders_of(study))
    for (auto const& source : order.sources)
      if (source.measured && source.file.parent_path() != measured_folder())
        in_world(*order.world, [&] { static_cast<void>(measured(order, source)); });
}

std::vector<WorldRuns> study_runs(Study const& study, std::function<void(double)> const& progress,
                                  std::atomic<bool> const* stop) {
  std::vector<Order> const orders = orders_of(study);
  std::map<std::string, int> ordinal;  // of each different run
  for (auto const& order : orders)
    for (auto const& source : order.sources) ordinal.emplace(source.file.string(), int(ordinal.size()));

  std::vector<Job> jobs;
  std::map<std::string, std::size_t> made;
  std::vector<std::vector<std::vector<std::size_t>>> used;  // world, repetition, run → job
  std::vector<std::size_t> made_for;
  for (auto const& order : orders) {
    bool const simulated = std::any_of(order.sources.begin(), order.sources.end(), [](auto& s) { return !s.measured; });
    auto& repetitions = used.emplace_back(std::size_t(simulated ? study.description.seeds : 1));
    for (std::size_t r = 0; r < repetitions.size(); ++r)
      for (auto const& source : order.sources) {
        int const seed = source.measured ? 0 : 1 + ordinal.at(source.file.string()) + int(ordinal.size() * r);
        auto const [place, fresh] = made.emplace(key_of(order, source, seed), jobs.size());
        if (fresh) jobs.push_back({&order, source, seed, {}, {}});
        repetitions[r].push_back(place->second);
      }
    made_for.push_back(jobs.size() - std::accumulate(made_for.begin(), made_for.end(), std::size_t(0)));
  }
  in_parallel(jobs.size(), progress, stop, [&](std::size_t j) {
    in_world(*jobs[j].order->world, [&] {
      if (jobs[j].source.measured) {
        jobs[j].run = std::make_shared<MeasuredRun const>(measured(*jobs[j].order, jobs[j].source));
        jobs[j].data = dataset_of(*jobs[j].run, jobs[j].order->world->sampling);
      } else {
        jobs[j].data = simulated(jobs[j], stop);
      }
      return 0;
    });
  });

  std::vector<WorldRuns> worlds;
  for (std::size_t w = 0; w < orders.size(); ++w) {
    WorldRuns runs{orders[w].machine, orders[w].sensors, orders[w].unit, {}, orders[w].nominal, {}, {}, made_for[w]};
    for (auto const& source : orders[w].sources)
      runs.experiments.push_back(source.measured ? std::nullopt : std::optional(experiment_of(orders[w], source)));
    for (auto const& repetition : used[w]) {
      auto& sets = runs.runs.emplace_back();
      for (auto const j : repetition) sets.push_back(jobs[j].data);
    }
    for (auto const j : used[w].front()) runs.measured.push_back(jobs[j].run);
    worlds.push_back(std::move(runs));
  }
  return worlds;
}

Eigen::Index first_reading(MeasuredRun const& run) {
  Eigen::Index first = run.time.size() - 1;
  for (auto const& channel : run.channels)
    for (Eigen::Index i = 0; i < first; ++i)
      if (!std::isnan(channel.values[i])) first = i;
  return first;
}

output::Dataset dataset_of(MeasuredRun const& run, std::optional<double> sampling, Eigen::MatrixXd const* values) {
  auto const first = first_reading(run), rows = run.time.size() - first;
  output::Dataset data;
  data.time_s = run.time.tail(rows).array() - run.time[first];
  for (std::size_t c = 0; c < run.channels.size(); ++c) {
    auto const& channel = run.channels[c];
    Eigen::VectorXd const shown = (values ? Eigen::VectorXd(values->col(Eigen::Index(c))) : channel.values).tail(rows);
    if (channel.displacement)
      data.displacements.push_back({channel.name, "um", "", 1e6 * shown});
    else
      data.readings.push_back({channel.name, "degC", "", shown.array() - thermal::zero_celsius});
  }
  return sampling ? averaged(data, *sampling) : data;
}

output::Dataset averaged(output::Dataset const& data, double period) {
  auto const stretch = [&](double time) { return Eigen::Index(std::floor(time / period + 1e-9)); };
  Eigen::Index const first = stretch(data.time_s[0]), rows = stretch(data.time_s[data.time_s.size() - 1]) - first + 1;
  output::Dataset result;
  result.title = data.title;
  result.time_s = period * Eigen::VectorXd::LinSpaced(rows, double(first), double(first + rows - 1));
  auto const mean = [&](output::Channel channel) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(rows), count = sum;
    for (Eigen::Index i = 0; i < data.time_s.size(); ++i) {
      if (!std::isfinite(channel.values[i])) continue;
      sum[stretch(data.time_s[i]) - first] += channel.values[i];
      count[stretch(data.time_s[i]) - first] += 1.0;
    }
    channel.values = (count.array() > 0.0).select(sum.array() / count.array(), std::nan(""));
    return channel;
  };
  for (auto const& channel : data.readings) result.readings.push_back(mean(channel));
  for (auto const& channel : data.displacements) result.displacements.push_back(mean(channel));
  return result;
}

}  // namespace thermotwin::twin
