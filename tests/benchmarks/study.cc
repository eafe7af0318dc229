// How long the study of paper 004 takes: 18 batches, all selections, all models, five seeds, nothing kept from
// before; and how long one model takes to fit to one of its batches, of 91 readings of ten sensors (docs/study.md).
//
//   thermotwin_bench --benchmark_filter='Study|Training'
#include "twin/study/study.h"

#include <benchmark/benchmark.h>

#include "models/error_model.h"
#include "twin/study/study_data.h"
#include "twin/study/study_file.h"

namespace thermotwin::twin {
namespace {

void StudyOfPaper004(benchmark::State& state) {
  auto const study = read_study(study_file("paper_004"));
  for (auto _ : state) {
    auto const report = run_study(study);
    state.counters["combinations"] = double(report.rows.size());
    state.counters["repetitions"] = double(report.repetitions.front());
  }
}
BENCHMARK(StudyOfPaper004)->Unit(benchmark::kSecond)->Iterations(1)->MeasureProcessCPUTime()->UseRealTime();

models::Batch const& batch_of_paper004() {
  static models::Batch const batch = [] {
    auto study = read_study(study_file("paper_004"));
    study.description.worlds.front().train.resize(1);
    study.description.worlds.front().test.resize(1);
    study.description.seeds = 1;
    return study_data(study, {}, nullptr).front().train.front().front().seen;
  }();
  return batch;
}

void Training(benchmark::State& state, char const* model) {
  auto const& batch = batch_of_paper004();
  for (auto _ : state) benchmark::DoNotOptimize(models::model_method(model).fit({&batch, 1}, {}));
  state.counters["samples"] = double(batch.error.size());
  state.counters["sensors"] = double(batch.sensors.size());
}
BENCHMARK_CAPTURE(Training, linear, "linear")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Training, LS_SVM, "least_squares_support_vector")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Training, SVR, "support_vector")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Training, back_propagation, "back_propagation")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Training, genetic_back_propagation, "genetic_back_propagation")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace thermotwin::twin
