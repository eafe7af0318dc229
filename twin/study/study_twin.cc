#include "twin/study/study_twin.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

#include "thermal/error.h"
#include "twin/challenge/hidden_world.h"
#include "twin/diagnosis/expected_noise.h"
#include "twin/diagnosis/observed_noise.h"
#include "twin/diagnosis/prediction.h"
#include "twin/diagnosis/run_files.h"
#include "twin/run.h"
#include "twin/study/study_runs.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;
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
  auto const first = estimation.fit(estimation.prior_mean(), iterations);
  auto const heard = estimation.with(observed_noise(estimation, first.x, estimation.noise()));
  return estimation.document_at(heard.fit(first.x, iterations).x);
}

output::Dataset said_of(Machine const& twin, MeasuredRun const& run, std::optional<double> sampling) {
  Eigen::MatrixXd const values = predict(twin, run);
  auto said = dataset_of(run, sampling, &values);
  said.truth_readings = said.readings;
  said.truth_displacements = said.displacements;
  return said;
}

/// What a run's displacement shows beyond the twin's, in the mean of the rows trained on; where there are none, at
/// first.
double zero_of(Question const& question, Asked const& asked, models::Batch const& said) {
  double sum = 0.0, rows = 0.0;
  for (std::size_t k = 0; k < question.parts.size(); ++k) {
    if (question.parts[k].run != asked.run) continue;
    sum += (question.training[k].error - rows_of(said, question.parts[k]).error).sum();
    rows += double(question.parts[k].count);
  }
  return rows > 0.0 ? sum / rows : asked.batch.error[0] - said.error[0];
}

}  // namespace

TwinRuns twin_runs(StudyWorld const& world, WorldData const& data, int repetition, Question const& question) {
  auto const& runs = *data.runs;
  try {
    Machine const twin = Machine::build(calibrated(data, repetition, question));
    TwinRuns result;
    RunOptions options;
    options.integration.relative_tolerance = options.integration.absolute_tolerance = run_tolerance;
    for (std::size_t r = 0; r < runs.measured.size(); ++r)
      result.runs.push_back(runs.measured[r] ? said_of(twin, *runs.measured[r], world.sampling)
                                             : run(twin, *runs.experiments[r], options).dataset);
    return result;
  } catch (InputError const& error) {
    return {{}, std::string("the twin: ") + error.what()};
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
  std::vector<models::Batch> said;
  for (auto const* list : {&data.train[std::size_t(repetition)], &data.test[std::size_t(repetition)]})
    for (auto const& run : *list) said.push_back(true_batch(world, data, twin.runs[said.size()], run.rows));
  for (auto const& asked : question.asked)
    if (data.runs->measured[asked.run]) said[asked.run].error.array() += zero_of(question, asked, said[asked.run]);
  for (std::size_t k = 0; k < question.training.size(); ++k) {
    auto const own = rows_of(said[question.parts[k].run], question.parts[k]);
    question.training[k].temperature_rise -= own.temperature_rise(Eigen::all, question.columns);
    question.training[k].error -= own.error;
  }
  for (auto& asked : question.asked) {
    auto const own = rows_of(said[asked.run], 0, asked.batch.time.size());
    asked.batch.temperature_rise -= own.temperature_rise;
    asked.said_by_twin = own.error;
  }
  return question;
}

}  // namespace thermotwin::twin
