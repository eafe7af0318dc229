// How long the study of paper 004 takes: 18 batches, eight selections, all models, five seeds, nothing kept from before
// (docs/study.md).
//
//   thermotwin_bench --benchmark_filter=Study
#include "twin/study/study.h"

#include <benchmark/benchmark.h>

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

}  // namespace
}  // namespace thermotwin::twin
