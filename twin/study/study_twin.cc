#include "twin/study/study_twin.h"

#include <algorithm>
#include <cstddef>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <set>

#include "scenarios/course.h"
#include "thermal/error.h"
#include "twin/challenge/hidden_world.h"
#include "twin/compensation/observed_run.h"
#include "twin/diagnosis/expected_noise.h"
#include "twin/diagnosis/observed_noise.h"
#include "twin/diagnosis/prediction.h"
#include "twin/diagnosis/run_files.h"
#include "twin/diagnosis/start.h"
#include "twin/run.h"
#include "twin/study/study_runs.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using thermal::InputError;

constexpr std::uint64_t first_seed = 77'000;  // of the files that twins start from
constexpr int iterations = 12;
constexpr double run_tolerance = 1e-6;

struct Window {
  double from, to;  ///< [s]
};

/// The times of a run's rows that a question trains on.
std::vector<Window> windows_of(std::vector<RunPart> const& parts, std::size_t run, Eigen::VectorXd const& time) {
  std::vector<Window> windows;
  for (auto const& part : parts)
    if (part.run == run) {
      Index const behind = part.first + part.count;
      windows.push_back({part.first > 0 ? time[part.first] : -std::numeric_limits<double>::infinity(),
                         behind < time.size() ? time[behind] : std::numeric_limits<double>::infinity()});
    }
  return windows;
}

/// What was read outside of the windows, which count from the first reading, is forgotten.
void keep(MeasuredRun& run, std::vector<Window> const& windows) {
  double const zero = run.time[first_reading(run)];
  for (Index i = 0; i < run.time.size(); ++i) {
    double const t = run.time[i] - zero;
    if (std::any_of(windows.begin(), windows.end(), [&](auto const& w) { return t >= w.from && t < w.to; })) continue;
    for (auto& channel : run.channels) channel.values[i] = std::numeric_limits<double>::quiet_NaN();
  }
}

bool all_measured(WorldRuns const& runs) {
  return std::all_of(runs.measured.begin(), runs.measured.end(), [](auto const& run) { return run != nullptr; });
}

Value calibrated(WorldData const& data, int repetition, Question const& question) {
  auto const& runs = *data.runs;
  auto const& train = data.train[std::size_t(repetition)];
  std::map<std::string, double> drawn;
  Value const start = all_measured(runs)
                          ? runs.nominal
                          : vary_parameters(runs.nominal, first_seed + std::uint64_t(repetition), 1.0, drawn);
  Machine const machine = Machine::build(start);
  std::vector<MeasuredRun> measured;
  for (std::size_t r = 0; r < train.size(); ++r) {
    auto const windows = windows_of(question.parts, r, train[r].seen.time);
    if (windows.empty()) continue;
    measured.push_back(runs.measured[r]
                           ? *runs.measured[r]
                           : measured_run(runs.runs[std::size_t(repetition)][r], machine, runs.experiments[r]->title));
    keep(measured.back(), windows);
  }
  auto const rows = binned(measured);
  Estimation const estimation = expected_estimation(start, rows).with_form_of_file();
  if (estimation.numbers().empty()) throw InputError("the machine has no number that calibration could change");
  Eigen::VectorXd best;
  double least = std::numeric_limits<double>::infinity();
  for (auto const& point : starts(estimation)) {
    auto const first = estimation.fit(point, iterations);
    auto const heard = estimation.with(observed_noise(estimation, first.x, estimation.noise()));
    auto const fit = heard.fit(first.x, iterations);
    double const misfit = fit.evidence + heard.noise_scale();
    if (best.size() > 0 && !(misfit < least)) continue;
    least = misfit;
    best = fit.x;
  }
  return estimation.document_at(best);
}

output::Dataset said_of(Machine const& twin, MeasuredRun const& run, std::optional<double> sampling) {
  Eigen::MatrixXd const values = predict(twin, run);
  auto said = dataset_of(run, sampling, &values);
  said.truth_readings = said.readings;
  said.truth_displacements = said.displacements;
  return said;
}

StudyRun const& run_of(WorldData const& data, int repetition, std::size_t run) {
  auto const& train = data.train[std::size_t(repetition)];
  return run < train.size() ? train[run] : data.test[std::size_t(repetition)][run - train.size()];
}

/// Those that a question trains on or asks about.
std::set<std::size_t> runs_of(Question const& question) {
  std::set<std::size_t> runs;
  for (auto const& part : question.parts) runs.insert(part.run);
  for (auto const& asked : question.asked) runs.insert(asked.run);
  return runs;
}

/// What a run's displacement shows beyond what is said of it, in the mean of the rows trained on; where there are none,
/// at first.
double zero_of(Question const& question, std::size_t run, VectorXd const& shown, VectorXd const& said) {
  double sum = 0.0, rows = 0.0;
  for (auto const& part : question.parts) {
    if (part.run != run) continue;
    sum += (shown - said).segment(part.first, part.count).sum();
    rows += double(part.count);
  }
  return rows > 0.0 ? sum / rows : shown[0] - said[0];
}

/// Those of the sensors that the twin has on bodies, in its order.
std::vector<std::string> observing(Machine const& twin, std::set<std::string> const& chosen) {
  std::vector<std::string> sensors;
  for (auto const& sensor : twin.sensors)
    if (!sensor.weights.empty() && chosen.contains(sensor.description.name)) sensors.push_back(sensor.description.name);
  return sensors;
}

/// What the observer says at every row of a run's data set [µm].
VectorXd followed(StudyWorld const& world, WorldData const& data, int repetition, std::size_t run,
                  TwinObserver const& observer) {
  auto const& runs = *data.runs;
  if (runs.measured[run]) return observed_error(observer, *runs.measured[run], world.sampling);
  scenarios::ExperimentCourse const programmed(*runs.experiments[run], runs.machine->limits);
  return observed_error(observer, runs.runs[std::size_t(repetition)][run], programmed, 0.0);
}

/// Between the rows of the first run trained on, as an observer follows them: a measured run's own [s].
double followed_interval(WorldData const& data, Question const& question) {
  if (auto const* measured = data.runs->measured[question.parts.front().run].get())
    return usual_interval({measured->time.data(), std::size_t(measured->time.size())});
  auto const& time = question.training.front().time;
  return time[1] - time[0];
}

/// Σ (measured − said)² over the rows trained on.
double missed(Question const& question, std::map<std::size_t, VectorXd> const& said) {
  double sum = 0.0;
  for (std::size_t k = 0; k < question.parts.size(); ++k) {
    auto const& part = question.parts[k];
    sum += (question.training[k].error - said.at(part.run).segment(part.first, part.count)).squaredNorm();
  }
  return sum;
}

}  // namespace

TwinRuns twin_runs(StudyWorld const& world, WorldData const& data, int repetition, Question const& question) {
  auto const& runs = *data.runs;
  if (!runs.machine) return {{}, std::string(no_machine), {}};
  try {
    TwinRuns result;
    result.machine = std::make_shared<Machine const>(Machine::build(calibrated(data, repetition, question)));
    auto const& twin = *result.machine;
    RunOptions options;
    options.integration.relative_tolerance = options.integration.absolute_tolerance = run_tolerance;
    for (std::size_t r = 0; r < runs.measured.size(); ++r)
      result.runs.push_back(runs.measured[r] ? said_of(twin, *runs.measured[r], world.sampling)
                                             : run(twin, *runs.experiments[r], options).dataset);
    return result;
  } catch (InputError const& error) {
    return {{}, std::string("the twin: ") + error.what(), {}};
  }
}

std::string twin_key(StudyWorld const& world, WorldData const& data, int repetition, Question const& question) {
  std::string key =
      fmt::format("{}|{}|{}|{}|{}|{}|{}", world.machine, world.added, fmt::join(world.changes, ","),
                  fmt::join(world.train, ","), fmt::join(world.test, ","), world.sampling.value_or(0.0), repetition);
  auto const& train = data.train[std::size_t(repetition)];
  for (std::size_t r = 0; r < train.size(); ++r)
    for (auto const& window : windows_of(question.parts, r, train[r].seen.time))
      key += fmt::format("|{}: {} to {}", r, window.from, window.to);
  return key;
}

Question less_twin(Question question, StudyWorld const& world, WorldData const& data, int repetition,
                   TwinRuns const& twin) {
  std::map<std::size_t, models::Batch> said;
  for (auto const run : runs_of(question)) {
    auto const& shown = run_of(data, repetition, run);
    auto own = true_batch(world, data, twin.runs[run], shown.kept);
    if (data.runs->measured[run]) own.error.array() += zero_of(question, run, shown.seen.error, own.error);
    said.emplace(run, std::move(own));
  }
  for (std::size_t k = 0; k < question.training.size(); ++k) {
    auto const own = rows_of(said.at(question.parts[k].run), question.parts[k]);
    question.training[k].temperature_rise -= own.temperature_rise(Eigen::all, question.columns);
    question.training[k].before -= own.before(Eigen::all, question.columns);
    question.training[k].error -= own.error;
  }
  for (auto& asked : question.asked) {
    auto const own = rows_of(said.at(asked.run), 0, asked.batch.time.size());
    asked.batch.temperature_rise -= own.temperature_rise;
    asked.said_by_twin = own.error;
  }
  return question;
}

FittedModel observed(StudyWorld const& world, WorldData const& data, int repetition, Question const& question,
                     Machine const& twin, std::vector<Index> const& columns) {
  std::set<std::string> chosen;
  for (auto const column : columns) chosen.insert(data.sensors[std::size_t(column)]);
  FittedModel result{nothing_more({chosen.begin(), chosen.end()}), "", {}};
  try {
    double least = std::numeric_limits<double>::infinity();
    for (auto const& options : observer_choices(followed_interval(data, question))) {
      TwinObserver const observer(twin, world.error, options, observing(twin, chosen));
      std::map<std::size_t, VectorXd> said;
      for (auto const run : runs_of(question)) {
        auto const& shown = run_of(data, repetition, run);
        VectorXd own = followed(world, data, repetition, run, observer)(shown.kept);
        if (data.runs->measured[run]) own.array() += zero_of(question, run, shown.seen.error, own);
        said.emplace(run, std::move(own));
      }
      double const sum = missed(question, said);
      if (!(sum < least)) continue;
      least = sum;
      result.observed.clear();
      for (auto const& asked : question.asked)
        result.observed.push_back(said.at(asked.run).head(asked.batch.time.size()));
      result.model.remark = text_of(options);
    }
  } catch (InputError const& error) {
    result.refused = std::string("the observer: ") + error.what();
  }
  return result;
}

std::vector<std::string> observer_remarks(StudyWorld const& world, WorldRuns const& runs) {
  std::vector<std::string> remarks;
  for (std::size_t r = 0; r < runs.measured.size(); ++r) {
    auto const remark = runs.measured[r] ? observer_remark(*runs.measured[r]) : std::string();
    auto const trained = world.train.size();
    if (!remark.empty()) remarks.push_back((r < trained ? world.train[r] : world.test[r - trained]) + ": " + remark);
  }
  return remarks;
}

}  // namespace thermotwin::twin
