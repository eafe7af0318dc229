#include "twin/study/study_twin.h"

#include <map>

#include "thermal/error.h"
#include "twin/challenge/hidden_world.h"
#include "twin/diagnosis/expected_noise.h"
#include "twin/diagnosis/run_files.h"
#include "twin/run.h"
#include "twin/study/study_runs.h"

namespace thermotwin::twin {
namespace {

using thermal::InputError;

constexpr std::uint64_t first_seed = 77'000;  // of the files that twins start from
constexpr int iterations = 12;
constexpr double run_tolerance = 1e-6;

Value calibrated(WorldRuns const& runs, int repetition, std::vector<std::size_t> const& training) {
  std::map<std::string, double> drawn;
  Value const start = vary_parameters(runs.nominal, first_seed + std::uint64_t(repetition), 1.0, drawn);
  Machine const machine = Machine::build(start);
  std::vector<MeasuredRun> measured;
  for (auto const r : training)
    measured.push_back(measured_run(runs.runs[std::size_t(repetition)][r], machine, runs.experiments[r]->title));
  auto const data = binned(measured);
  Estimation const estimation = expected_estimation(start, data);
  if (estimation.numbers().empty()) throw InputError("the machine has no number that calibration could change");
  return estimation.document_at(estimation.fit(estimation.prior_mean(), iterations).x);
}

}  // namespace

TwinCourses twin_courses(StudyWorld const& world, WorldData const& data, int repetition, Question const& question) {
  auto const& runs = *data.runs;
  if (question.runs.empty()) return {{}, "the twin is calibrated on whole runs only"};
  for (auto const& experiment : runs.experiments)
    if (!experiment) return {{}, "the twin is driven by experiments; some of these runs were measured"};
  try {
    Machine const twin = Machine::build(calibrated(runs, repetition, question.runs));
    TwinCourses courses;
    RunOptions options;
    options.integration.relative_tolerance = options.integration.absolute_tolerance = run_tolerance;
    for (auto const& experiment : runs.experiments)
      courses.runs.push_back(true_batch(world, data, run(twin, *experiment, options).dataset));
    return courses;
  } catch (InputError const& error) {
    return {{}, std::string("the twin: ") + error.what()};
  }
}

Question less_twin(Question question, TwinCourses const& twin) {
  for (std::size_t k = 0; k < question.training.size(); ++k) {
    auto const& said = twin.runs[question.runs[k]];
    question.training[k].temperature_rise -= said.temperature_rise(Eigen::all, question.columns);
    question.training[k].error -= said.error;
  }
  for (auto& asked : question.asked) {
    asked.batch.temperature_rise -= twin.runs[asked.run].temperature_rise;
    asked.said_by_twin = twin.runs[asked.run].error;
  }
  return question;
}

}  // namespace thermotwin::twin
