// The only file, with sundials_vector.cc, that knows SUNDIALS.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cvodes/cvodes.h>
#include <exception>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <utility>

#include "thermal/course_inputs.h"
#include "thermal/error.h"
#include "thermal/fixed_blocks.h"
#include "thermal/forward_sensitivities.h"
#include "thermal/integrate.h"
#include "thermal/newton_system.h"
#include "thermal/physical_constant.h"
#include "thermal/sundials_vector.h"

namespace thermotwin::thermal {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Owns a C object that is freed by `Free(object)`.
template <class T, auto Free>
using Handle = std::unique_ptr<std::remove_pointer_t<T>, decltype([](auto* p) { Free(p); })>;

void free_cvode(void* memory) { CVodeFree(&memory); }
void free_context(SUNContext context) { SUNContext_Free(&context); }
void free_vector(N_Vector v) { N_VDestroy(v); }
void free_matrix(SUNMatrix m) { SUNMatDestroy(m); }
void free_solver(SUNLinearSolver s) { SUNLinSolFree(s); }

using ContextHandle = Handle<SUNContext, free_context>;
using VectorHandle = Handle<N_Vector, free_vector>;
using MatrixHandle = Handle<SUNMatrix, free_matrix>;
using SolverHandle = Handle<SUNLinearSolver, free_solver>;

/// A matrix and a linear solver that SUNDIALS may hold; what they stand for is the NewtonSystem of the run.
MatrixHandle matrix_shell(SUNContext context) {
  SUNMatrix matrix = SUNMatNewEmpty(context);
  matrix->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
  matrix->ops->destroy = [](SUNMatrix m) { SUNMatFreeEmpty(m); };
  return MatrixHandle(matrix);
}

SolverHandle solver_shell(SUNContext context, bool iterative) {
  SUNLinearSolver solver = SUNLinSolNewEmpty(context);
  if (iterative)
    solver->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_MATRIX_ITERATIVE; };
  else
    solver->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
  solver->ops->free = [](SUNLinearSolver self) {
    SUNLinSolFreeEmpty(self);
    return 0;
  };
  return SolverHandle(solver);
}

/// One run: owns everything that CVODES points to.
class Run {
 public:
  Run(Network const& network, Course const& course, IntegrationOptions const& options)
      : network_(network),
        options_(options),
        evaluation_(network),
        point_(network, course),
        solver_kind_(options.solver == LinearSolver::automatic ? choose_solver(network) : options.solver),
        newton_(network, solver_kind_) {
    SUNContext context = nullptr;
    SUNContext_Create(nullptr, &context);
    context_.reset(context);
  }

  void operator()(IntegrationState& state, std::span<double const> times, Observer const& observe);

 private:
  void set_up(IntegrationState const& from);
  void attach_linear_solver();
  void leave(IntegrationState& state);
  void restart(double t);
  void set_initial_step(double t);
  void advance(double target);
  bool follow(double goal);
  void emit(double t, Observer const& observe);
  void settle_relays(double t);
  double next_relay_wake(double t) const;
  [[noreturn]] void fail(int flag);
  Energy energy() const;
  double stored() const;
  void collect_counters();

  double const* input(double t) { return point_.at(t).data(); }
  double relay_distance(std::size_t r, double const* temperatures) const;

  /// Runs a callback; an exception is kept until CVODES has returned.
  template <class Body>
  int guarded(Body body) noexcept {
    try {
      return body();
    } catch (...) {
      failure_ = std::current_exception();
      return -1;
    }
  }

  static Run& self(void* user) { return *static_cast<Run*>(user); }
  static int rate(double t, N_Vector y, N_Vector ydot, void* user);
  static int newton_matrix(double t, N_Vector y, N_Vector fy, SUNMatrix, int reuse, int* current, double gamma,
                           void* user, N_Vector, N_Vector, N_Vector);
  static int solve(SUNLinearSolver solver, SUNMatrix, N_Vector x, N_Vector b, realtype tolerance);
  static int error_weights(N_Vector y, N_Vector weights, void* user);
  static int roots(double t, N_Vector y, double* g, void* user);
  static void collect_message(int code, char const*, char const* function, char* message, void* user);

  Network const& network_;
  IntegrationOptions const& options_;
  Evaluation evaluation_;
  CourseInputs point_;
  LinearSolver solver_kind_;
  NewtonSystem newton_;

  ContextHandle context_;
  VectorHandle y_;
  N_Vector weighted_ = nullptr;  ///< CVODES' vector that has the error weights already
  std::optional<ForwardSensitivities> sensitivities_;
  MatrixHandle matrix_;
  SolverHandle solver_;
  Handle<void*, free_cvode> cvode_;

  std::vector<double> initial_;
  std::vector<double> next_switch_;  ///< earliest time at which a relay may switch on again
  double t_ = 0.0;
  double step_end_ = 0.0;        ///< of CVODES' last step, which may lie beyond t_
  double next_root_ = infinity;  ///< within that step
  std::exception_ptr failure_;
  std::string message_;
  IntegrationSummary summary_;
};

int Run::rate(double t, N_Vector y, N_Vector ydot, void* user) {
  return self(user).guarded([&] {
    auto& run = self(user);
    int const n = run.network_.nodes();
    Energy const power = run.evaluation_.rate_and_power(data(y), run.input(t), data(ydot));
    double const unit = run.newton_.energy_unit();
    data(ydot)[n] = power.supplied / unit;
    data(ydot)[n + 1] = power.withdrawn / unit;
    data(ydot)[n + 2] = power.lost / unit;
    data(ydot)[n + 3] = power.exchanged / unit;
    double const sum =
        sum_of_terms(n + NewtonSystem::energies, [rates = data(ydot)](std::ptrdiff_t i) { return rates[i]; });
    return std::isfinite(sum) ? 0 : 1;
  });
}

int Run::newton_matrix(double t, N_Vector y, N_Vector, SUNMatrix, int reuse, int* current, double gamma, void* user,
                       N_Vector, N_Vector, N_Vector) {
  return self(user).guarded([&] {
    auto& run = self(user);
    if (!reuse) run.newton_.linearise(run.evaluation_, data(y), run.input(t));
    *current = !reuse;
    return run.newton_.factorise(gamma) ? 0 : 1;
  });
}

/// Positive while the relay may keep its state, zero where it must switch.
double Run::relay_distance(std::size_t r, double const* temperatures) const {
  auto const& relay = network_.relays()[r];
  auto const& values = point_.values();
  double const state = values[std::size_t(relay.state_channel)];
  bool const enabled = relay.enable_channel < 0 || values[std::size_t(relay.enable_channel)] > 0.5;
  double const difference = temperatures[relay.measured] - temperatures[relay.reference];
  if (!enabled || (state < 0.5 && t_ < next_switch_[r])) return 1.0;
  return state > 0.5 ? difference - relay.low : relay.high - difference;
}

int Run::roots(double t, N_Vector y, double* g, void* user) {
  return self(user).guarded([&] {
    auto& run = self(user);
    auto const temperatures = run.evaluation_.temperatures(data(y), run.input(t));
    for (std::size_t r = 0; r < run.network_.relays().size(); ++r) g[r] = run.relay_distance(r, temperatures.data());
    return 0;
  });
}

void Run::collect_message(int code, char const*, char const* function, char* message, void* user) {
  if (code < 0) self(user).message_ = fmt::format("{}: {}", function, message);
}

/// CVODES takes every code for a success that is not one of a SUNLinearSolver's own.
int Run::solve(SUNLinearSolver solver, SUNMatrix, N_Vector x, N_Vector b, realtype tolerance) {
  auto& run = self(solver->content);
  int const flag = run.guarded([&] {
    if (run.solver_kind_ == LinearSolver::multigrid) {
      double gamma = 0.0;
      CVodeGetCurrentGamma(run.cvode_.get(), &gamma);
      if (!run.newton_.factorise(gamma)) return SUNLS_PACKAGE_FAIL_REC;
    }
    auto const n = std::size_t(N_VGetLength(b));
    return run.newton_.solve({data(b), n}, tolerance, {data(x), n}) ? SUNLS_SUCCESS : SUNLS_PACKAGE_FAIL_REC;
  });
  return flag < 0 ? SUNLS_PACKAGE_FAIL_UNREC : flag;
}

/// Where factors cost little, they are always those of the present γ, and only the Jacobian grows old.
void Run::attach_linear_solver() {
  bool const cheap_factors = solver_kind_ == LinearSolver::multigrid;
  bool const iterative = cheap_factors || solver_kind_ == LinearSolver::preconditioned_krylov;
  void* cvode = cvode_.get();
  matrix_ = matrix_shell(context_.get());
  solver_ = solver_shell(context_.get(), iterative);
  solver_->content = this;
  solver_->ops->solve = solve;
  CVodeSetLinearSolver(cvode, solver_.get(), matrix_.get());
  CVodeSetLinSysFn(cvode, newton_matrix);
  if (!iterative) CVodeSetNonlinConvCoef(cvode, 0.3);  // as exact as with CVODES' 0.1, for a ninth fewer evaluations
  if (!cheap_factors) return;
  CVodeSetLinearSolutionScaling(cvode, SUNFALSE);
  CVodeSetDeltaGammaMaxLSetup(cvode, infinity);
  CVodeSetLSetupFrequency(cvode, 50);
}

/// The energies are sums over the temperatures and need no control of their own; CVODES' mean over all entries is one
/// over the nodes. CVODES asks at every step, with one vector.
int Run::error_weights(N_Vector, N_Vector weights, void* user) {
  auto& run = self(user);
  if (std::exchange(run.weighted_, weights) == weights) return 0;
  double const nodes = run.network_.nodes();
  N_VConst(std::sqrt((nodes + NewtonSystem::energies) / nodes) / run.options_.tolerance(), weights);
  std::fill_n(data(weights) + run.network_.nodes(), NewtonSystem::energies, 1e-6 / run.options_.tolerance());
  return 0;
}

void Run::set_up(IntegrationState const& from) {
  t_ = from.time;
  point_.enter_piece(t_);
  y_.reset(make_vector(sunindextype(from.state.size()), context_.get()));
  std::copy(from.state.begin(), from.state.end(), data(y_.get()));
  initial_ = from.start;
  for (std::size_t r = 0; r < from.relays.size(); ++r) point_.state_of(network_.relays()[r]) = from.relays[r];
  next_switch_ = from.next_switch;
  summary_ = from.summary;
  cvode_.reset(CVodeCreate(CV_BDF, context_.get()));
  weighted_ = nullptr;
  void* cvode = cvode_.get();
  CVodeSetErrHandlerFn(cvode, collect_message, this);
  CVodeInit(cvode, rate, t_, y_.get());
  CVodeSetUserData(cvode, this);
  CVodeWFtolerances(cvode, error_weights);
  CVodeSetMaxNumSteps(cvode, 10'000'000);
  CVodeSetMinStep(cvode, 1e-9);  // less than that and a temperature runs away
  if (double const longest = point_.longest_step(); std::isfinite(longest)) CVodeSetMaxStep(cvode, longest);
  attach_linear_solver();
  if (!network_.relays().empty()) CVodeRootInit(cvode, int(network_.relays().size()), roots);
  step_end_ = t_;
  if (options_.parameters.empty()) return;
  if (!network_.relays().empty())
    throw InputError("a machine with a relay has no forward sensitivities: a parameter also moves when it switches");
  sensitivities_.emplace(network_, options_.parameters, solver_kind_, options_.tolerance());
  sensitivities_->start(t_, data(y_.get()));
}

Energy Run::energy() const {
  double const* e = data(y_.get()) + network_.nodes();
  double const unit = newton_.energy_unit();
  return {e[0] * unit, e[1] * unit, e[2] * unit, e[3] * unit};
}

double Run::stored() const {
  double sum = 0.0;
  for (int i = 0; i < network_.nodes(); ++i) {
    auto const k = std::size_t(i);
    if (!network_.signals()[k]) sum += network_.capacity()[k] * (data(y_.get())[i] - initial_[k]);
  }
  return sum;
}

void Run::emit(double t, Observer const& observe) {
  Sample sample;
  sample.time = t;
  double const* input = point_.at(t).data();
  sample.state = {data(y_.get()), std::size_t(network_.nodes())};
  sample.energy = energy();
  if (sensitivities_) sample.sensitivities = &sensitivities_->temperatures(t, data(y_.get()));
  sample.temperatures = evaluation_.temperatures(data(y_.get()), input);
  sample.input = point_.values();
  observe(sample);
}

/// Puts every relay into the state that its temperature demands at time t.
void Run::settle_relays(double t) {
  auto const& relays = network_.relays();
  if (relays.empty()) return;
  auto const temperatures = evaluation_.temperatures(data(y_.get()), input(t));
  t_ = t;
  for (std::size_t r = 0; r < relays.size(); ++r) {
    bool const enabled = relays[r].enable_channel < 0 || point_.values()[std::size_t(relays[r].enable_channel)] > 0.5;
    double& state = point_.state_of(relays[r]);
    bool const on = state > 0.5;
    if ((on && !enabled) || (enabled && relay_distance(r, temperatures.data()) <= 1e-10)) {
      state = on ? 0.0 : 1.0;
      if (on) next_switch_[r] = t + relays[r].minimum_off_time;
      ++summary_.relay_switches;
    }
  }
}

double Run::next_relay_wake(double t) const {
  double wake = infinity;
  for (double s : next_switch_)
    if (s > t) wake = std::min(wake, s);
  return wake;
}

void Run::collect_counters() {
  long value = 0;
  void* cvode = cvode_.get();
  CVodeGetNumSteps(cvode, &value);
  summary_.steps += value;
  CVodeGetNumRhsEvals(cvode, &value);
  summary_.rate_evaluations += value;
  CVodeGetNumNonlinSolvIters(cvode, &value);
  summary_.nonlinear_iterations += value;
  CVodeGetNumErrTestFails(cvode, &value);
  summary_.error_test_failures += value;
  CVodeGetNumJacEvals(cvode, &value);
  summary_.jacobian_evaluations += value;
}

void Run::restart(double t) {
  collect_counters();
  void* cvode = cvode_.get();
  CVodeReInit(cvode, t, y_.get());
  set_initial_step(t);
  step_end_ = t;
  next_root_ = infinity;
  if (sensitivities_) sensitivities_->restart(t);
  ++summary_.restarts;
}

/// The first step after a start changes no temperature by more than its tolerance; it must not depend on when the next
/// output is due, or watching a run would change it.
void Run::set_initial_step(double t) {
  constexpr double shortest = 1e-6, longest = 10.0;
  std::vector<double> rates(std::size_t(network_.nodes()));
  evaluation_.rate(data(y_.get()), input(t), rates.data());
  double fastest = 0.0;
  for (double rate : rates) fastest = std::max(fastest, std::abs(rate));
  CVodeSetInitStep(cvode_.get(), std::clamp(options_.tolerance() / std::max(fastest, 1e-300), shortest, longest));
}

/// Integrates to `target`, through jumps, bends and relay switches on the way.
void Run::advance(double target) {
  void* cvode = cvode_.get();
  while (t_ < target) {
    double const piece_end = point_.enter_piece(t_);
    double const stop = std::min({piece_end, next_relay_wake(t_)});
    double const end_of_step = std::min(stop, point_.next_bend(t_));
    double const goal = std::min(target, end_of_step);
    CVodeSetStopTime(cvode, std::isfinite(end_of_step) ? end_of_step : std::max(target, t_ + 1.0) * 1e3 + 1e9);
    bool const switches = follow(goal);
    if (switches || t_ >= stop) {
      point_.enter_piece(t_);
      settle_relays(t_);
      restart(t_);
    }
  }
}

/// Takes steps until one ends at `goal` or beyond, and returns to it, or to a root before it; whether that is one.
bool Run::follow(double goal) {
  void* cvode = cvode_.get();
  while (step_end_ < goal && next_root_ == infinity) {
    double returned = t_;
    int const flag = CVode(cvode, goal, y_.get(), &returned, CV_ONE_STEP);
    if (flag < 0) fail(flag);
    CVodeGetCurrentTime(cvode, &step_end_);
    if (flag == CV_TSTOP_RETURN) step_end_ = returned;  // not a rounding error before
    if (flag == CV_ROOT_RETURN) next_root_ = returned;
    if (!sensitivities_) continue;
    int order = 0;
    CVodeGetLastOrder(cvode, &order);
    auto const at = [&](double t) -> ForwardSensitivities::Instant {
      CVodeGetDky(cvode, t, 0, y_.get());
      return {data(y_.get()), input(t)};
    };
    if (!sensitivities_->step(step_end_, order, at)) fail(CV_LSOLVE_FAIL);
  }
  t_ = std::min(goal, next_root_);
  CVodeGetDky(cvode, t_, 0, y_.get());
  return next_root_ <= goal;
}

void Run::fail(int flag) {
  if (failure_) std::rethrow_exception(failure_);
  int const n = network_.nodes();
  VectorHandle error(N_VClone(y_.get())), weight(N_VClone(y_.get()));
  CVodeGetEstLocalErrors(cvode_.get(), error.get());
  CVodeGetErrWeights(cvode_.get(), weight.get());
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  auto const badness = [&](int i) { return std::abs(data(error.get())[i] * data(weight.get())[i]); };
  auto const worst = order.begin() + std::min(n, 3);
  std::partial_sort(order.begin(), worst, order.end(), [&](int a, int b) { return badness(a) > badness(b); });
  double t = t_;
  CVodeGetCurrentTime(cvode_.get(), &t);
  std::string text =
      fmt::format("the integration stopped at t = {:.6g} s ({}; CVODES flag {}). Worst nodes:", t, message_, flag);
  for (auto it = order.begin(); it != worst; ++it)
    text += fmt::format(" {} at {:.6g} °C;", network_.node_name(*it), data(y_.get())[*it] - zero_celsius);
  text += " inputs:";
  auto const& values = point_.at(t);
  for (int i = 0; i < network_.given_channels(); ++i)
    text += fmt::format(" {} = {:.6g};", network_.channel_names()[std::size_t(i)], values[std::size_t(i)]);
  throw IntegrationError(text);
}

/// Where the run stands, with what it did so far.
void Run::leave(IntegrationState& state) {
  collect_counters();
  summary_.solver = solver_kind_;
  summary_.energy = energy();
  summary_.stored = stored();
  state.time = t_;
  state.state.assign(data(y_.get()), data(y_.get()) + state.state.size());
  for (std::size_t r = 0; r < state.relays.size(); ++r) state.relays[r] = point_.state_of(network_.relays()[r]);
  state.next_switch = next_switch_;
  state.summary = summary_;
}

void Run::operator()(IntegrationState& state, std::span<double const> times, Observer const& observe) {
  auto const begin = std::chrono::steady_clock::now();
  set_up(state);
  settle_relays(t_);
  set_initial_step(t_);
  for (double time : times) {
    advance(time);
    emit(time, observe);
  }
  summary_.wall_time += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  leave(state);
}

}  // namespace

std::string_view name_of(LinearSolver solver) {
  switch (solver) {
    case LinearSolver::dense:
      return "dense LU";
    case LinearSolver::sparse_direct:
      return "sparse LU (KLU)";
    case LinearSolver::preconditioned_krylov:
      return "BiCGSTAB with incomplete LU";
    case LinearSolver::multigrid:
      return "GMRES with multigrid";
    case LinearSolver::automatic:
      break;
  }
  return "automatic";
}

double IntegrationSummary::moved() const {
  double const came = energy.supplied + 0.5 * (energy.exchanged - energy.lost);
  double const went = energy.withdrawn + 0.5 * (energy.exchanged + energy.lost);
  return std::max(came, went);
}

double IntegrationSummary::energy_imbalance() const {
  double const gap = std::abs(stored + energy.lost + energy.withdrawn - energy.supplied);
  return moved() > 0.0 ? gap / moved() : gap;
}

IntegrationState start_of_run(Network const& network, std::span<double const> temperatures, double time) {
  if (int(temperatures.size()) != network.nodes())
    throw InputError(fmt::format("{} initial temperatures for {} nodes", temperatures.size(), network.nodes()));
  IntegrationState state;
  state.time = time;
  for (int i = 0; i < network.nodes(); ++i)
    state.start.push_back(network.state_of_temperature(i, temperatures[std::size_t(i)]));
  state.state = state.start;
  state.state.resize(state.start.size() + NewtonSystem::energies, 0.0);
  state.relays.assign(network.relays().size(), 0.0);
  state.next_switch.assign(network.relays().size(), -infinity);
  return state;
}

void integrate(Network const& network, Course const& course, IntegrationState& state,
               std::span<double const> output_times, IntegrationOptions const& options, Observer const& observe) {
  if (output_times.empty()) throw InputError("there is no output time");
  Run(network, course, options)(state, output_times, observe);
}

IntegrationSummary integrate(Network const& network, Course const& course, std::span<double const> initial_temperatures,
                             std::span<double const> output_times, IntegrationOptions const& options,
                             Observer const& observe) {
  if (output_times.empty()) throw InputError("there is no output time");
  auto state = start_of_run(network, initial_temperatures, output_times.front());
  integrate(network, course, state, output_times, options, observe);
  return state.summary;
}

}  // namespace thermotwin::thermal
