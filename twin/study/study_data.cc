#include "twin/study/study_data.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

#include "thermal/nearest_name.h"
#include "twin/axis_record.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;

output::Channel const* channel_of(std::vector<output::Channel> const& group, std::string const& name) {
  auto const it = std::find_if(group.begin(), group.end(), [&](auto const& c) { return c.name == name; });
  return it == group.end() ? nullptr : &*it;
}

std::vector<std::string> names_of(std::vector<output::Channel> const& group) {
  std::vector<std::string> names;
  for (auto const& channel : group) names.push_back(channel.name);
  return names;
}

/// What of a data set models get to see: its readings and errors, or the true ones.
struct View {
  std::vector<output::Channel> const& readings;
  std::vector<output::Channel> const& displacements;
  std::vector<output::Positioning> const& positioning;
};

class WorldReader {
 public:
  WorldReader(StudyWorld const& world, WorldRuns const& runs) : world_(world), runs_(runs) {}
  WorldReader(StudyWorld const& world, WorldData const& data) : WorldReader(world, *data.runs) {
    data_.sensors = data.sensors;
  }
  WorldData read();
  [[nodiscard]] StudyRun run_of(output::Dataset const& data, std::string const& name) const;

 private:
  [[nodiscard]] std::vector<std::string> candidates() const;
  void leave_out(std::string const& sensor, std::string const& why);
  void check_sensors();
  [[nodiscard]] models::Batch batch(View const& view, Eigen::VectorXd const& time, std::string const& name) const;
  [[nodiscard]] models::AxisRecord record(View const& readings, View const& errors, Eigen::VectorXd const& time,
                                          std::string const& name) const;
  [[nodiscard]] Eigen::MatrixXd rises(View const& view) const;
  [[nodiscard]] std::vector<std::string> components() const;
  void check_instants() const;
  void remark_measured();
  [[nodiscard]] std::string missing_readings(MeasuredRun const& run) const;
  [[nodiscard]] std::vector<std::string> run_names() const;

  StudyWorld const& world_;
  WorldRuns const& runs_;
  WorldData data_;
};

std::vector<std::string> WorldReader::candidates() const {
  std::vector<std::string> known;
  for (auto const& sensor : runs_.machine.sensors) known.push_back(sensor.description.name);
  if (world_.sensors.empty()) return known;
  for (auto const& name : world_.sensors)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw thermal::InputError(
          fmt::format("the machine has no sensor '{}'; {}", name, thermal::did_you_mean(name, known)));
  return world_.sensors;
}

void WorldReader::leave_out(std::string const& sensor, std::string const& why) {
  std::erase(data_.sensors, sensor);
  data_.remarks.push_back(fmt::format("{} is left out: {}", sensor, why));
}

std::vector<std::string> WorldReader::run_names() const {
  std::vector<std::string> names = world_.train;
  names.insert(names.end(), world_.test.begin(), world_.test.end());
  return names;
}

void WorldReader::check_sensors() {
  auto const names = run_names();
  for (auto const& repetition : runs_.runs)
    for (std::size_t i = 0; i < repetition.size(); ++i)
      for (auto const& sensor : std::vector<std::string>(data_.sensors)) {
        auto const* channel = channel_of(repetition[i].readings, sensor);
        if (!channel)
          leave_out(sensor, fmt::format("{} does not have it", names[i]));
        else if (auto const missing = (!channel->values.array().isFinite()).count(); missing == channel->values.size())
          leave_out(sensor, fmt::format("it is dead in {}", names[i]));
        else if (missing > 0)
          leave_out(sensor,
                    fmt::format("{} of {} readings are missing in {}", missing, channel->values.size(), names[i]));
      }
  if (data_.sensors.empty())
    throw thermal::InputError(fmt::format("no sensor is left: {}", fmt::join(data_.remarks, "; ")));
}

/// "T1 3, E_Z 12", of what models get to see.
std::string WorldReader::missing_readings(MeasuredRun const& run) const {
  std::vector<std::string> counts;
  for (auto const& channel : run.channels) {
    auto const missing = channel.values.tail(run.time.size() - first_reading(run)).array().isNaN().count();
    bool const asked = channel.displacement
                           ? channel.name == world_.error
                           : std::find(data_.sensors.begin(), data_.sensors.end(), channel.name) != data_.sensors.end();
    if (asked && missing > 0) counts.push_back(fmt::format("{} {}", channel.name, missing));
  }
  return fmt::format("{}", fmt::join(counts, ", "));
}

void WorldReader::remark_measured() {
  auto const names = run_names();
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!runs_.measured[i]) continue;
    auto const& run = *runs_.measured[i];
    for (auto const& remark : run.remarks) data_.remarks.push_back(names[i] + ": " + remark);
    auto const missing = world_.sampling ? missing_readings(run) : std::string();
    if (!missing.empty())
      data_.remarks.push_back(fmt::format("{}: of {} rows, readings are missing, and the means are over the others: {}",
                                          names[i], run.time.size() - first_reading(run), missing));
  }
}

/// No pass of the laser is taken for one that was never made.
void WorldReader::check_instants() const {
  for (auto const& instant : world_.instants)
    for (auto const* list : {&data_.train.front(), &data_.test.front()})
      for (auto const& run : *list) {
        if (run.seen.name != instant.experiment) continue;
        auto const& time = run.axis->time;
        double const apart = time.size() > 1 ? usual_interval({time.data(), std::size_t(time.size())}) : 0.0;
        if ((time.array() - instant.time).abs().minCoeff() > 0.5 * apart + 1e-6)
          throw thermal::InputError(fmt::format(
              "no pass of the laser in {} at {:g} min; they are from {:g} min to {:g} min, {:g} min apart",
              instant.experiment, instant.time / 60.0, time[0] / 60.0, time[time.size() - 1] / 60.0, apart / 60.0));
      }
}

std::vector<std::string> WorldReader::components() const {
  std::vector<std::string> result;
  for (auto const& name : data_.sensors)
    for (auto const& sensor : runs_.machine.sensors)
      if (sensor.description.name == name) result.push_back(sensor.description.component);
  return result;
}

Eigen::MatrixXd WorldReader::rises(View const& view) const {
  Eigen::MatrixXd rise;
  for (std::size_t j = 0; j < data_.sensors.size(); ++j) {
    auto const& values = channel_of(view.readings, data_.sensors[j])->values;
    rise.conservativeResize(values.size(), Index(j) + 1);
    rise.col(Index(j)) = values.array() - values[0];
  }
  return rise;
}

models::Batch WorldReader::batch(View const& view, Eigen::VectorXd const& time, std::string const& name) const {
  auto const* error = channel_of(view.displacements, world_.error);
  if (!error)
    throw thermal::InputError(fmt::format("{} has no displacement '{}'; {}", name, world_.error,
                                          thermal::did_you_mean(world_.error, names_of(view.displacements))));
  models::Batch batch{name, time, data_.sensors, components(), rises(view), error->values};
  for (Index i = 0; i < time.size(); ++i)
    if (!std::isfinite(error->values[i]))
      throw thermal::InputError(fmt::format("{}: {} has no value at {:g} s", name, world_.error, time[i]));
  return batch;
}

models::AxisRecord WorldReader::record(View const& readings, View const& errors, Eigen::VectorXd const& time,
                                       std::string const& name) const {
  auto const axis = world_.error.substr(slope_prefix.size());
  return axis_record({name, time, data_.sensors, components(), rises(readings), {}},
                     laser_of(errors.positioning, axis, name), world_.from, world_.to);
}

StudyRun WorldReader::run_of(output::Dataset const& data, std::string const& name) const {
  View const seen{data.readings, data.displacements, data.positioning};
  View const true_ones{data.truth_readings, data.truth_displacements, data.truth_positioning};
  bool const known = !data.truth_readings.empty();
  if (!world_.slope())
    return {batch(seen, data.time_s, name),
            known ? std::optional(batch(true_ones, data.time_s, name)) : std::nullopt,
            {},
            {}};
  auto const axis = record(seen, seen, data.time_s, name);
  return {models::slope_batch(axis),
          known ? std::optional(models::slope_batch(record(true_ones, true_ones, data.time_s, name))) : std::nullopt,
          axis, record(seen, known ? true_ones : seen, data.time_s, name)};
}

WorldData WorldReader::read() {
  data_.sensors = candidates();
  check_sensors();
  remark_measured();
  if (world_.slope()) data_.unit = "um/m";
  for (auto const& repetition : runs_.runs) {
    auto& train = data_.train.emplace_back();
    auto& test = data_.test.emplace_back();
    for (std::size_t i = 0; i < repetition.size(); ++i)
      if (i < world_.train.size())
        train.push_back(run_of(repetition[i], world_.train[i]));
      else
        test.push_back(run_of(repetition[i], world_.test[i - world_.train.size()]));
  }
  check_instants();
  data_.no_modes = runs_.no_modes;
  if (runs_.mode_shapes.size() == 0) return std::move(data_);
  std::vector<Index> rows;
  for (auto const& name : data_.sensors)
    for (std::size_t s = 0; s < runs_.machine.sensors.size(); ++s)
      if (runs_.machine.sensors[s].description.name == name) rows.push_back(Index(s));
  data_.mode_shapes = runs_.mode_shapes(rows, Eigen::all);
  return std::move(data_);
}

}  // namespace

models::Batch true_batch(StudyWorld const& world, WorldData const& data, output::Dataset const& dataset) {
  return WorldReader(world, data).run_of(dataset, "the twin").truth.value();
}

std::vector<WorldData> study_data(Study const& study, std::function<void(double)> const& progress,
                                  std::atomic<bool> const* stop) {
  auto runs = study_runs(study, progress, stop);
  std::vector<WorldData> worlds;
  for (std::size_t w = 0; w < runs.size(); ++w) {
    auto const& world = study.description.worlds[w];
    try {
      auto const kept = std::make_shared<WorldRuns const>(std::move(runs[w]));
      worlds.push_back(WorldReader(world, *kept).read());
      worlds.back().runs = kept;
    } catch (std::invalid_argument const& error) {
      throw about(world, error.what());
    } catch (thermal::InputError const& error) {
      throw about(world, error.what());
    }
  }
  return worlds;
}

}  // namespace thermotwin::twin
