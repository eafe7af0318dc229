#include "twin/study/study_data.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "thermal/nearest_name.h"
#include "twin/axis_record.h"
#include "twin/complete_rows.h"
#include "twin/history.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;

/// Of a run's readings: a sensor that lacks more is left out, and not the rows that lack it.
constexpr double largest_missing_share = 0.1;

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
  [[nodiscard]] models::Batch true_batch(output::Dataset const& data, std::vector<Index> const& kept,
                                         std::string const& name) const;

 private:
  [[nodiscard]] std::vector<std::string> candidates() const;
  [[nodiscard]] Eigen::ArrayX<bool> rows_with_any(output::Dataset const& data) const;
  [[nodiscard]] std::string unusable(std::string const& sensor, output::Dataset const& data,
                                     std::string const& run) const;
  void check_sensors();
  [[nodiscard]] std::vector<Index> complete(output::Dataset const& data, std::string const& name,
                                            std::vector<std::string>& remarks) const;
  [[nodiscard]] StudyRun run_of(output::Dataset const& data, std::string const& name,
                                std::vector<std::string>& remarks) const;
  [[nodiscard]] models::Batch batch(View const& view, Eigen::VectorXd const& time, std::vector<Index> const& kept,
                                    std::string const& name) const;
  [[nodiscard]] models::AxisRecord record(View const& readings, View const& errors, Eigen::VectorXd const& time,
                                          std::vector<Index> const& kept, std::string const& name) const;
  [[nodiscard]] Eigen::MatrixXd rises(View const& view, std::vector<Index> const& kept) const;
  [[nodiscard]] std::vector<std::string> components() const;
  void check_instants() const;
  void remark_measured();
  void remark_repeated();
  [[nodiscard]] std::string missing_readings(MeasuredRun const& run) const;
  [[nodiscard]] std::vector<std::string> run_names() const;
  [[nodiscard]] std::vector<std::string> reader_remarks(std::string const& run) const;

  StudyWorld const& world_;
  WorldRuns const& runs_;
  WorldData data_;
};

std::vector<std::string> WorldReader::candidates() const {
  std::vector<std::string> known;
  for (auto const& sensor : runs_.sensors) known.push_back(sensor.name);
  return world_.sensors.empty() ? known : world_.sensors;
}

std::vector<std::string> WorldReader::run_names() const {
  std::vector<std::string> names = world_.train;
  names.insert(names.end(), world_.test.begin(), world_.test.end());
  return names;
}

/// Those of which something could be learnt: with the error, and at least one sensor.
Eigen::ArrayX<bool> WorldReader::rows_with_any(output::Dataset const& data) const {
  Eigen::ArrayX<bool> any = Eigen::ArrayX<bool>::Constant(data.time_s.size(), false);
  for (auto const& sensor : data_.sensors)
    if (auto const* channel = find_channel(data.readings, sensor)) any = any || channel->values.array().isFinite();
  if (auto const* error = find_channel(data.displacements, world_.error)) any = any && error->values.array().isFinite();
  return any;
}

/// Why no model of the world gets to see the sensor; empty: they do.
std::string WorldReader::unusable(std::string const& sensor, output::Dataset const& data,
                                  std::string const& run) const {
  auto const* channel = find_channel(data.readings, sensor);
  if (!channel) return fmt::format("{} does not have it", run);
  Eigen::ArrayX<bool> const missing = !channel->values.array().isFinite(), asked = rows_with_any(data);
  if (missing.all()) return fmt::format("it is dead in {}", run);
  auto const lacking = (missing && asked).count();
  if (double(lacking) <= largest_missing_share * double(asked.count())) return {};
  return fmt::format("{} of {} readings are missing in {}, more than {:g} %", lacking, asked.count(), run,
                     100.0 * largest_missing_share);
}

void WorldReader::check_sensors() {
  auto const names = run_names();
  for (auto const& repetition : runs_.runs)
    for (std::size_t i = 0; i < repetition.size(); ++i)
      for (auto const& sensor : std::vector<std::string>(data_.sensors))
        if (auto const why = unusable(sensor, repetition[i], names[i]); !why.empty()) {
          std::erase(data_.sensors, sensor);
          data_.remarks.push_back(fmt::format("{} is left out: {}", sensor, why));
        }
  if (data_.sensors.empty())
    throw thermal::InputError(fmt::format("no sensor is left: {}", fmt::join(data_.remarks, "; ")));
}

/// What is left out is remarked.
std::vector<Index> WorldReader::complete(output::Dataset const& data, std::string const& name,
                                         std::vector<std::string>& remarks) const {
  std::vector<output::Channel const*> channels;
  for (auto const& sensor : data_.sensors) channels.push_back(find_channel(data.readings, sensor));
  if (auto const* error = find_channel(data.displacements, world_.error)) channels.push_back(error);
  auto known = reader_remarks(name);
  auto const before = Index(known.size());
  auto const rows = complete_rows(channels, name, known);
  remarks.insert(remarks.end(), known.begin() + before, known.end());
  return rows;
}

/// What the reader of a measured run had to say of it.
std::vector<std::string> WorldReader::reader_remarks(std::string const& run) const {
  auto const names = run_names();
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == run && runs_.measured[i]) return runs_.measured[i]->remarks;
  return {};
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

/// What is learnt is no prediction where the same is asked, whatever its file is called.
void WorldReader::remark_repeated() {
  for (std::size_t i = 0; i < data_.test.front().size(); ++i)
    for (std::size_t k = 0; k < data_.train.front().size(); ++k)
      if (same_data(data_.test.front()[i].seen, data_.train.front()[k].seen))
        data_.remarks.push_back(fmt::format("{} has the same data as {}, which is trained on: it tests nothing",
                                            world_.test[i], world_.train[k]));
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
    for (auto const& sensor : runs_.sensors)
      if (sensor.name == name) result.push_back(sensor.component);
  return result;
}

Eigen::MatrixXd WorldReader::rises(View const& view, std::vector<Index> const& kept) const {
  Eigen::MatrixXd rise(Index(kept.size()), Index(data_.sensors.size()));
  for (std::size_t j = 0; j < data_.sensors.size(); ++j) {
    auto const& values = find_channel(view.readings, data_.sensors[j])->values;
    rise.col(Index(j)) = values(kept).array() - values[kept.front()];
  }
  return rise;
}

models::Batch WorldReader::batch(View const& view, Eigen::VectorXd const& time, std::vector<Index> const& kept,
                                 std::string const& name) const {
  auto const* error = find_channel(view.displacements, world_.error);
  if (!error)
    throw thermal::InputError(fmt::format("{} has no displacement '{}'; {}", name, world_.error,
                                          thermal::did_you_mean(world_.error, names_of(view.displacements))));
  return {name, time(kept), data_.sensors, components(), rises(view, kept), error->values(kept)};
}

models::AxisRecord WorldReader::record(View const& readings, View const& errors, Eigen::VectorXd const& time,
                                       std::vector<Index> const& kept, std::string const& name) const {
  auto const axis = world_.error.substr(slope_prefix.size());
  return axis_record({name, time(kept), data_.sensors, components(), rises(readings, kept), {}},
                     laser_of(errors.positioning, axis, name), world_.from, world_.to);
}

View seen_of(output::Dataset const& data) { return {data.readings, data.displacements, data.positioning}; }

View truth_of(output::Dataset const& data) {
  return {data.truth_readings, data.truth_displacements, data.truth_positioning};
}

models::Batch WorldReader::true_batch(output::Dataset const& data, std::vector<Index> const& kept,
                                      std::string const& name) const {
  auto const truth = truth_of(data);
  return world_.slope() ? models::slope_batch(record(truth, truth, data.time_s, kept, name))
                        : batch(truth, data.time_s, kept, name);
}

StudyRun WorldReader::run_of(output::Dataset const& data, std::string const& name,
                             std::vector<std::string>& remarks) const {
  auto const kept = complete(data, name, remarks);
  auto const seen = seen_of(data);
  bool const known = !data.truth_readings.empty();
  auto const truth = known ? std::optional(true_batch(data, kept, name)) : std::nullopt;
  if (!world_.slope()) {
    auto shown = batch(seen, data.time_s, kept, name);
    if (!known) shown.error.array() -= shown.error[0];
    return {shown, truth, {}, {}, kept};
  }
  auto const axis = record(seen, seen, data.time_s, kept, name);
  return {models::slope_batch(axis), truth, axis, record(seen, known ? truth_of(data) : seen, data.time_s, kept, name),
          kept};
}

WorldData WorldReader::read() {
  data_.sensors = candidates();
  check_sensors();
  data_.unit = runs_.unit;
  auto const names = run_names();
  for (auto const& repetition : runs_.runs) {
    bool const first = data_.train.empty();
    auto& train = data_.train.emplace_back();
    auto& test = data_.test.emplace_back();
    for (std::size_t i = 0; i < repetition.size(); ++i) {
      std::vector<std::string> remarks;
      (i < world_.train.size() ? train : test).push_back(run_of(repetition[i], names[i], remarks));
      for (auto const& remark : remarks)
        if (first) data_.remarks.push_back(names[i] + ": " + remark);
    }
  }
  remark_repeated();
  remark_measured();
  check_instants();
  return std::move(data_);
}

}  // namespace

models::Batch true_batch(StudyWorld const& world, WorldData const& data, output::Dataset const& dataset,
                         std::vector<Index> const& kept) {
  return WorldReader(world, data).true_batch(dataset, kept, "the twin");
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
