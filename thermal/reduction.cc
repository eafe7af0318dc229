#include "thermal/reduction.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <numeric>
#include <set>

#include "thermal/course_inputs.h"
#include "thermal/error.h"
#include "thermal/reduced_integration.h"
#include "thermal/reduced_sums.h"
#include "thermal/sparse_cubature.h"
#include "thermal/threaded_product.h"

namespace thermotwin::thermal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::array<double, 9> rates = {0.0, 1e-5, 4e-5, 1.6e-4, 6.4e-4, 2.5e-3, 1e-2, 4e-2, 0.16};  // [1/s]
constexpr double film_rise = 4.0;         // [K] by which surfaces are taken to be warmer than the air, on average
constexpr double shape_tolerance = 0.02;  // [K] rms over all nodes: what counts as much as a watched sum's tolerance
constexpr double training_interval = 60.0, training_tolerance = 5e-4, first_tolerance = 1e-2;
constexpr int rest_shapes = 24, cubature_states = 120, cubature_modes = 14, most_per_shape = 2;

/// Runs `work(i)` for i < count on all threads; an exception comes out when all are done.
template <class Work>
void for_all(int count, Work const& work) {
  std::vector<std::exception_ptr> failures(static_cast<std::size_t>(count));
#pragma omp parallel for schedule(dynamic)
  for (int i = 0; i < count; ++i) {
    try {
      work(i);
    } catch (...) {
      failures[std::size_t(i)] = std::current_exception();
    }
  }
  for (auto const& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

/// The runs' numbers, longest first: so the threads end together.
std::vector<int> by_length(std::vector<TrainingRun> const& runs) {
  std::vector<int> order(runs.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return runs[std::size_t(a)].duration > runs[std::size_t(b)].duration; });
  return order;
}

std::vector<double> output_times(TrainingRun const& run) {
  std::vector<double> times;
  for (double t = 0.0; t <= run.duration; t += training_interval) times.push_back(t);
  return times;
}

/// What the training runs have seen.
struct Snapshots {
  MatrixXd states;  ///< r × every output time
  MatrixXd rests;   ///< candidates × some of them: rest of the flow into the first port [W]
};

class Reducer {
 public:
  Reducer(Network const& network, ReductionTask const& task)
      : network_(network),
        task_(task),
        reference_(mean_point()),
        linear_(network, reference_),
        nonlinear_(nonlinear_elements(network, linear_)),
        capacity_(Eigen::Map<VectorXd const>(network.capacity().data(), network.nodes())) {}

  Reduction operator()();

 private:
  [[nodiscard]] ReferencePoint mean_point() const;
  [[nodiscard]] std::vector<int> heated_ports() const;
  [[nodiscard]] MatrixXd entrances() const;
  void factorise();
  [[nodiscard]] MatrixXd responses(MatrixXd const& heat) const;
  [[nodiscard]] MatrixXd independent(MatrixXd columns) const;
  [[nodiscard]] Snapshots train(MatrixXd const& shapes, double tolerance) const;
  [[nodiscard]] bool may_be_sampled(SampledElement const& element) const;
  [[nodiscard]] MatrixXd heat_of_rests(MatrixXd const& rests) const;
  [[nodiscard]] MatrixXd principal(ReducedNetwork const& reduced, MatrixXd const& states) const;
  [[nodiscard]] Subspace subspace(MatrixXd const& shapes, MatrixXd const& rests) const;
  [[nodiscard]] std::vector<double> error_of(Subspace const& subspace, ReducedNetwork const& larger,
                                             MatrixXd const& states) const;

  Network const& network_;
  ReductionTask const& task_;
  ReferencePoint reference_;
  LinearPart linear_;
  std::vector<SampledElement> nonlinear_;
  VectorXd capacity_;
  std::array<Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>, rates.size()> factors_;  ///< of K + σC
};

ReferencePoint Reducer::mean_point() const {
  ReferencePoint at;
  at.input.assign(std::size_t(network_.channels()), 0.0);
  double count = 0.0;
  for (auto const& run : task_.training) {
    CourseInputs inputs(network_, *run.course);
    for (double t = 0.0; t < run.duration; t += 600.0, ++count) {
      inputs.enter_piece(t);
      auto const& values = inputs.at(t);
      for (std::size_t i = 0; i < values.size(); ++i) at.input[i] += values[i];
    }
  }
  for (double& value : at.input) value /= std::max(count, 1.0);
  std::vector<double> outside;
  for (auto const& boundary : network_.boundaries()) {
    double value = boundary.offset;
    for (auto const& term : boundary.terms) value += term.weight * at.input[std::size_t(term.channel)];
    outside.push_back(value);
  }
  double mean = 0.0;
  for (double value : outside) mean += value / double(outside.size());
  for (char const is_signal : network_.signals()) at.temperatures.push_back(is_signal ? 0.0 : mean + film_rise);
  at.temperatures.insert(at.temperatures.end(), outside.begin(), outside.end());
  at.temperatures.resize(std::size_t(network_.temperatures()), mean + film_rise);
  return at;
}

/// Ports of all laws that the linear part does not know.
std::vector<int> Reducer::heated_ports() const {
  std::set<int> ports;
  for (auto const& sample : nonlinear_) {
    auto const& group = network_.groups()[std::size_t(sample.group)];
    if (linear_.secant[std::size_t(sample.group)][std::size_t(sample.element)] > 0.0) continue;
    for (int p = 0; p < group.law->ports(); ++p)
      ports.insert(group.ports[std::size_t(sample.element * group.law->ports() + p)]);
  }
  std::erase_if(ports, [&](int port) { return node_shares(network_, port).empty(); });
  return {ports.begin(), ports.end()};
}

/// Columns of heat [W]: into every heated port, through the boundaries by every input, and what the initial states are.
MatrixXd Reducer::entrances() const {
  auto const ports = heated_ports();
  int const channels = network_.external_channels();
  MatrixXd heat = MatrixXd::Zero(network_.nodes(), Index(ports.size()) + channels + task_.initial_rises.cols());
  for (std::size_t k = 0; k < ports.size(); ++k)
    for (auto const& [node, share] : node_shares(network_, ports[k])) heat(node, Index(k)) = share;
  for (std::size_t b = 0; b < network_.boundaries().size(); ++b)
    for (auto const& term : network_.boundaries()[b].terms)
      heat.col(Index(ports.size()) + term.channel) += term.weight * linear_.boundary.col(Index(b));
  heat.rightCols(task_.initial_rises.cols()) = capacity_.asDiagonal() * task_.initial_rises;
  return heat;
}

void Reducer::factorise() {
  for_all(int(rates.size()), [&](int r) {
    Eigen::SparseMatrix<double> matrix = linear_.conductance;
    Eigen::SparseMatrix<double> diagonal(network_.nodes(), network_.nodes());
    diagonal.reserve(Eigen::VectorXi::Constant(network_.nodes(), 1));
    for (int i = 0; i < network_.nodes(); ++i)
      diagonal.insert(i, i) = network_.signals()[std::size_t(i)] ? 1.0 : rates[std::size_t(r)] * capacity_[i];
    matrix += diagonal;
    factors_[std::size_t(r)].compute(matrix);
    if (factors_[std::size_t(r)].info() != Eigen::Success)
      throw IntegrationError("the conductances of the network are singular");
  });
}

/// (K + σC)⁻¹ of all columns, for all rates side by side.
MatrixXd Reducer::responses(MatrixXd const& heat) const {
  MatrixXd result(network_.nodes(), heat.cols() * Index(rates.size()));
  for_all(int(rates.size()), [&](int r) {
    for (Index c = 0; c < heat.cols(); ++c)
      result.col(r * heat.cols() + c) = factors_[std::size_t(r)].solve(heat.col(c));
  });
  return result;
}

/// Columns that span the same, without those that add less than 3e-5 of their length.
MatrixXd Reducer::independent(MatrixXd columns) const {
  std::vector<Index> kept;
  for (Index k = 0; k < columns.cols(); ++k) {
    double const length = std::sqrt(columns.col(k).cwiseAbs2().dot(capacity_));
    if (!(length > 0.0)) continue;
    columns.col(k) /= length;
    kept.push_back(k);
  }
  MatrixXd const some = columns(Eigen::all, kept);
  MatrixXd const stored = capacity_.asDiagonal() * some;
  Eigen::SelfAdjointEigenSolver<MatrixXd> const solver(threaded_product(some.transpose(), stored));
  Index const first = std::count_if(solver.eigenvalues().begin(), solver.eigenvalues().end(),
                                    [](double value) { return value < 1e-9; });
  Index const count = some.cols() - first;
  MatrixXd const turn =
      solver.eigenvectors().rightCols(count) * solver.eigenvalues().tail(count).cwiseSqrt().cwiseInverse().asDiagonal();
  return threaded_product(some, turn);
}

/// Beside each other.
MatrixXd joined(std::vector<MatrixXd> const& parts) {
  Index columns = 0;
  for (auto const& part : parts) columns += part.cols();
  MatrixXd all(parts.front().rows(), columns);
  columns = 0;
  for (auto const& part : parts) {
    all.middleCols(columns, part.cols()) = part;
    columns += part.cols();
  }
  return all;
}

/// The first `count` principal columns, each with its size.
MatrixXd principal_columns(MatrixXd const& columns, int count) {
  Eigen::SelfAdjointEigenSolver<MatrixXd> const solver(columns.transpose() * columns);
  return columns * solver.eigenvectors().rightCols(std::min<Index>(count, columns.cols())).rowwise().reverse();
}

Snapshots Reducer::train(MatrixXd const& shapes, double tolerance) const {
  ReducedNetwork const reduced(network_, linear_, shapes, nonlinear_);
  auto const runs = task_.training.size();
  std::vector<MatrixXd> states(runs), rests(runs);
  auto const order = by_length(task_.training);
  for_all(int(runs), [&](int k) {
    int const i = order[std::size_t(k)];
    auto const& run = task_.training[std::size_t(i)];
    auto const times = output_times(run);
    auto& own = states[std::size_t(i)];
    auto& flows = rests[std::size_t(i)];
    Index const count = Index(times.size()), every = std::max<Index>(1, count * Index(runs) / cubature_states);
    own.resize(reduced.size(), count);
    flows.resize(Index(nonlinear_.size()), (count + every - 1) / every);
    ReducedEvaluation evaluation(reduced);
    VectorXd ignored;
    Index column = 0;
    integrate(reduced, *run.course, reduced.state_of(run.initial_temperatures), times, tolerance,
              [&](ReducedSample const& sample) {
                own.col(column) = sample.state;
                if (column % every == 0) {
                  evaluation.rest(sample.state, sample.input.data(), ignored);
                  Index element = 0;
                  for (std::size_t g = 0; g < reduced.groups().size(); ++g)
                    for (std::size_t e = 0; e < reduced.groups()[g].weight.size(); ++e, ++element)
                      flows(element, column / every) =
                          may_be_sampled(nonlinear_[std::size_t(element)]) ? evaluation.rest_flows()[g][2 * e] : 0.0;
                }
                ++column;
              });
  });
  return {joined(states), joined(rests)};
}

bool Reducer::may_be_sampled(SampledElement const& element) const {
  auto const& law = *network_.groups()[std::size_t(element.group)].law;
  return law.conservative() && law.ports() == 2;
}

/// Rests as heat into the nodes: nodes × columns.
MatrixXd Reducer::heat_of_rests(MatrixXd const& rests) const {
  MatrixXd heat = MatrixXd::Zero(network_.nodes(), rests.cols());
  for (std::size_t e = 0; e < nonlinear_.size(); ++e) {
    if (!may_be_sampled(nonlinear_[e])) continue;
    auto const& ports = network_.groups()[std::size_t(nonlinear_[e].group)].ports;
    for (int p = 0; p < 2; ++p)
      for (auto const& [node, share] : node_shares(network_, ports[std::size_t(2 * nonlinear_[e].element + p)]))
        heat.row(node) += (p == 0 ? share : -share) * rests.row(Index(e));
  }
  return heat;
}

/// Principal shapes of the states, as nodes × count, in a norm in which a rise of `shape_tolerance` everywhere, and the
/// tolerance of every watched sum, are one; as many as leave away less than the share asked for.
MatrixXd Reducer::principal(ReducedNetwork const& reduced, MatrixXd const& states) const {
  MatrixXd norm =
      MatrixXd::Identity(reduced.size(), reduced.size()) / (capacity_.sum() * shape_tolerance * shape_tolerance);
  auto const add = [&](std::vector<std::pair<int, double>> const& weights, double tolerance) {
    auto const row = reduced.functional(weights).row;
    norm += row.transpose() * row / (tolerance * tolerance);
  };
  for (auto const& sum : task_.watched) add(sum.weights, sum.tolerance);
  for (int port : heated_ports()) add(node_shares(network_, port), shape_tolerance);
  Eigen::LLT<MatrixXd> const root(norm);
  MatrixXd const scaled = MatrixXd(root.matrixU()) * states / std::sqrt(double(states.cols()));
  Eigen::SelfAdjointEigenSolver<MatrixXd> const solver(scaled * scaled.transpose());
  double left = 0.0;
  Index away = 0;
  while (away < states.rows() && (left += std::max(0.0, solver.eigenvalues()[away])) < task_.share * task_.share)
    ++away;
  MatrixXd const modes = solver.eigenvectors().rightCols(states.rows() - away).rowwise().reverse();
  return reduced.shapes() * root.matrixU().solve(modes);
}

/// The elements that stand for all, in these shapes.
Subspace Reducer::subspace(MatrixXd const& shapes, MatrixXd const& rests) const {
  MatrixXd all(network_.nodes(), shapes.cols() + task_.initial_rises.cols());
  all << shapes, task_.initial_rises;
  ReducedNetwork const reduced(network_, linear_, independent(all), nonlinear_);
  MatrixXd const modes = principal_columns(rests, cubature_modes);
  VectorXd const scale = (reduced.decay().array() + 1.0 / 3600.0).inverse();
  std::vector<int> candidates;
  Subspace result{reduced.shapes(), {}};
  for (std::size_t e = 0; e < nonlinear_.size(); ++e)
    if (may_be_sampled(nonlinear_[e]))
      candidates.push_back(int(e));
    else
      result.elements.push_back(nonlinear_[e]);
  MatrixXd columns(reduced.size() * modes.cols(), Index(candidates.size()));
  std::size_t element = 0, column = 0;
  for (auto const& group : reduced.groups())
    for (int e = 0; e < group.count(); ++e, ++element) {
      if (column >= candidates.size() || candidates[column] != int(element)) continue;
      auto const* port = group.ports.data() + std::size_t(2 * e);
      VectorXd const shape = scale.cwiseProduct(reduced.shape_of_port(port[0]) - reduced.shape_of_port(port[1]));
      for (Index m = 0; m < modes.cols(); ++m)
        columns.col(Index(column)).segment(m * reduced.size(), reduced.size()) = modes(Index(element), m) * shape;
      ++column;
    }
  for (auto const& [c, weight] : sparse_cubature(columns, task_.cubature, most_per_shape * reduced.size())) {
    SampledElement chosen = nonlinear_[std::size_t(candidates[std::size_t(c)])];
    chosen.weight = weight;
    result.elements.push_back(chosen);
  }
  std::sort(result.elements.begin(), result.elements.end(),
            [](auto const& a, auto const& b) { return std::pair(a.group, a.element) < std::pair(b.group, b.element); });
  return result;
}

/// Largest difference of every watched sum, since the start of each training run, from what the larger network showed.
std::vector<double> Reducer::error_of(Subspace const& subspace, ReducedNetwork const& larger,
                                      MatrixXd const& states) const {
  ReducedNetwork const reduced(network_, linear_, subspace.shapes, subspace.elements);
  std::vector<ReducedSums::Weights> weights;
  for (auto const& sum : task_.watched) weights.push_back(sum.weights);
  ReducedSums const own(reduced, weights), expected(larger, weights);
  std::vector<Index> first_column;
  Index columns = 0;
  for (auto const& run : task_.training) {
    first_column.push_back(columns);
    columns += Index(output_times(run).size());
  }
  MatrixXd gaps = MatrixXd::Zero(Index(weights.size()), Index(task_.training.size()));
  auto const order = by_length(task_.training);
  for_all(int(order.size()), [&](int k) {
    auto const i = std::size_t(order[std::size_t(k)]);
    auto const& run = task_.training[i];
    auto gap = gaps.col(Index(i));
    Index column = first_column[i];
    VectorXd a, b;
    integrate(reduced, *run.course, reduced.state_of(run.initial_temperatures), output_times(run), training_tolerance,
              [&](ReducedSample const& sample) {
                own.evaluate(sample.state, a);
                expected.evaluate(states.col(column++), b);
                gap = gap.cwiseMax((a - b).cwiseAbs());
              });
  });
  VectorXd const worst = gaps.rowwise().maxCoeff();
  return {worst.begin(), worst.end()};
}

Reduction Reducer::operator()() {
  factorise();
  MatrixXd heat = entrances(), first(network_.nodes(), 0);
  for (int pass = 0; pass < 2; ++pass) {
    MatrixXd const response = responses(heat);
    MatrixXd all(network_.nodes(), first.cols() + response.cols() + task_.initial_rises.cols());
    all << first, response, task_.initial_rises;
    first = independent(all);
    if (pass == 0) heat = heat_of_rests(principal_columns(train(first, first_tolerance).rests, rest_shapes));
  }
  Snapshots const seen = train(first, training_tolerance);
  ReducedNetwork const larger(network_, linear_, first, {});
  MatrixXd const shapes = principal(larger, seen.states);
  Reduction result;
  result.reference = reference_;
  for_all(2, [&](int k) {
    Index const count = k == 0 ? shapes.cols() : (4 * shapes.cols() + 4) / 5;
    (k == 0 ? result.fine : result.coarse) = subspace(shapes.leftCols(count), seen.rests);
  });
  result.training_error = error_of(result.fine, larger, seen.states);
  return result;
}

}  // namespace

Reduction reduce(Network const& network, ReductionTask const& task) {
  if (task.training.empty()) throw InputError("a reduction needs training runs");
  return Reducer(network, task)();
}

}  // namespace thermotwin::thermal
