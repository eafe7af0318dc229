#include <benchmark/benchmark.h>
#include <cmath>
#include <cvodes/cvodes.h>
#include <filesystem>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_sparse.h>

#include "scenarios/course.h"
#include "thermal/evaluation.h"
#include "thermal/integrate.h"
#include "thermal/modal_integration.h"
#include "twin/machine.h"
#include "twin/run.h"

/// What a campaign is measured against: 24 h of random spectrum on v450 with CVODES as it comes, a sparse matrix, KLU,
/// the same right-hand side and Jacobian; scalar tolerances of 1e-6, of temperatures in kelvin: 3e-4 K. Its results are
/// thrown away. Beside it the same integration by us to several tolerances, by BDF and in modes, and the whole run as a
/// campaign makes it.
/// `rms_K`: over all nodes and samples, against a tolerance of 1e-10.
namespace thermotwin::twin {
namespace {

struct Problem {
  Machine machine = Machine::read(std::filesystem::path(THERMOTWIN_SOURCE_DIR) / "twin/machines/v450.toml");
  scenarios::Experiment experiment;

  Problem() {
    experiment.duration = 24 * 3600.0;
    experiment.sampling = 600.0;
    experiment.ambient.mean = 295.15;
    experiment.spindle.emplace().random.emplace().run = experiment.duration;
  }
};

using States = std::vector<std::vector<double>>;

using Method = decltype(&thermal::integrate_in_modes);

struct Integrated {
  States states;
  thermal::IntegrationSummary summary;
};

Integrated integrated(Problem const& problem, double tolerance, Method integrate = thermal::integrate) {
  scenarios::ExperimentCourse const course(problem.experiment, problem.machine.limits);
  std::vector<double> const start(std::size_t(problem.machine.network().nodes()), 295.15);
  thermal::IntegrationOptions options;
  options.relative_tolerance = options.absolute_tolerance = tolerance;
  States states;
  auto const summary =
      integrate(problem.machine.network(), course, start, scenarios::sample_times(problem.experiment), options,
                [&](auto const& sample) { states.emplace_back(sample.state.begin(), sample.state.end()); });
  return {states, summary};
}

double rms_error(Problem const& problem, States const& states) {
  static States const exact = integrated(problem, 1e-10).states;
  double sum = 0.0, count = 0.0;
  for (std::size_t s = 0; s < exact.size(); ++s)
    for (std::size_t i = 0; i < exact[s].size(); ++i, ++count) sum += std::pow(states[s][i] - exact[s][i], 2);
  return std::sqrt(sum / count);
}

struct Loop {
  Loop(Problem const& problem)
      : evaluation(problem.machine.network()), course(problem.experiment, problem.machine.limits) {
    auto const& network = problem.machine.network();
    raw.resize(course.channels().size());
    input.resize(std::size_t(network.channels()));
    for (int c = 0; c < network.external_channels(); ++c)
      for (std::size_t i = 0; i < raw.size(); ++i)
        if (course.channels()[i].name == network.channel_names()[std::size_t(c)]) source.push_back(i);
  }

  double const* at(double t) {
    course.evaluate(t < end ? t : std::nextafter(end, 0.0), raw);
    for (std::size_t i = 0; i < source.size(); ++i) input[i] = raw[source[i]];
    return input.data();
  }

  static int rate(double t, N_Vector y, N_Vector rates, void* self) {
    auto& loop = *static_cast<Loop*>(self);
    loop.evaluation.rate(N_VGetArrayPointer(y), loop.at(t), N_VGetArrayPointer(rates));
    return 0;
  }
  static int jacobian(double t, N_Vector y, N_Vector, SUNMatrix matrix, void* self, N_Vector, N_Vector, N_Vector) {
    auto& loop = *static_cast<Loop*>(self);
    auto const values = loop.evaluation.jacobian(N_VGetArrayPointer(y), loop.at(t));
    std::copy_n(values.outerIndexPtr(), values.cols() + 1, SUNSparseMatrix_IndexPointers(matrix));
    std::copy_n(values.innerIndexPtr(), values.nonZeros(), SUNSparseMatrix_IndexValues(matrix));
    std::copy_n(values.valuePtr(), values.nonZeros(), SUNSparseMatrix_Data(matrix));
    return 0;
  }

  thermal::Evaluation evaluation;
  scenarios::ExperimentCourse course;
  std::vector<double> raw, input;
  std::vector<std::size_t> source;
  double end = 0.0;
};

void UntunedCvodeKlu24h(benchmark::State& state) {
  Problem const problem;
  int const n = problem.machine.network().nodes();
  States states;
  for (auto _ : state) {
    states.clear();
    Loop loop(problem);
    SUNContext context = nullptr;
    SUNContext_Create(nullptr, &context);
    N_Vector y = N_VNew_Serial(n, context);
    N_VConst(295.15, y);
    double const* input = loop.at(0.0);
    auto const pattern = loop.evaluation.jacobian(N_VGetArrayPointer(y), input);
    SUNMatrix matrix = SUNSparseMatrix(n, n, pattern.nonZeros() + n, CSC_MAT, context);
    SUNLinearSolver solver = SUNLinSol_KLU(y, matrix, context);
    void* cvode = CVodeCreate(CV_BDF, context);
    CVodeInit(cvode, Loop::rate, 0.0, y);
    CVodeSetUserData(cvode, &loop);
    CVodeSStolerances(cvode, 1e-6, 1e-6);
    CVodeSetMaxNumSteps(cvode, 1'000'000);
    CVodeSetLinearSolver(cvode, solver, matrix);
    CVodeSetJacFn(cvode, Loop::jacobian);
    double t = 0.0;
    loop.end = loop.course.next_jump(0.0);
    for (double const out : scenarios::sample_times(problem.experiment)) {
      while (t < out) {
        CVodeSetStopTime(cvode, std::min(loop.end, 1e9));
        if (CVode(cvode, std::min(out, loop.end), y, &t, CV_NORMAL) < 0) return state.SkipWithError("CVODES gave up");
        if (t < loop.end) continue;
        loop.end = loop.course.next_jump(t);
        CVodeReInit(cvode, t, y);
      }
      states.emplace_back(N_VGetArrayPointer(y), N_VGetArrayPointer(y) + n);
    }
    CVodeFree(&cvode);
    SUNLinSolFree(solver);
    SUNMatDestroy(matrix);
    N_VDestroy(y);
    SUNContext_Free(&context);
  }
  state.counters["rms_K"] = rms_error(problem, states);
}
BENCHMARK(UntunedCvodeKlu24h)->Unit(benchmark::kMillisecond);

/// To a tolerance in millionths.
void Integration24h(benchmark::State& state, Method method) {
  Problem const problem;
  Integrated run;
  for (auto _ : state) run = integrated(problem, 1e-6 * double(state.range(0)), method);
  state.counters["nodes"] = double(problem.machine.network().nodes());
  state.counters["evaluations"] = double(run.summary.rate_evaluations);
  state.counters["rms_K"] = rms_error(problem, run.states);
}
BENCHMARK_CAPTURE(Integration24h, bdf, static_cast<Method>(&thermal::integrate))
    ->Unit(benchmark::kMillisecond)
    ->Arg(10)
    ->Arg(25)
    ->Arg(30);
BENCHMARK_CAPTURE(Integration24h, modes, &thermal::integrate_in_modes)->Unit(benchmark::kMillisecond)->Arg(10)->Arg(25);

void CampaignRun24h(benchmark::State& state, bool in_modes) {
  Problem const problem;
  RunOptions options;
  options.integration.relative_tolerance = options.integration.absolute_tolerance = 1e-5;
  options.in_modes = in_modes;
  for (auto _ : state) benchmark::DoNotOptimize(run(problem.machine, problem.experiment, options).summary.steps);
}
BENCHMARK_CAPTURE(CampaignRun24h, full, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(CampaignRun24h, modes, true)->Unit(benchmark::kMillisecond);

void MachineFromItsDocument(benchmark::State& state) {
  Value const document = read_toml(machine_file("v450"));
  for (auto _ : state) {
    Value changed = document;
    set_parameter(changed, "bearing.front.grease_factor", "0.6");
    benchmark::DoNotOptimize(Machine::build(changed).network().nodes());
  }
}
BENCHMARK(MachineFromItsDocument)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace thermotwin::twin
