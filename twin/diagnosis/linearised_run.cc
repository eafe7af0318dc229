#include "twin/diagnosis/linearised_run.h"

#include <algorithm>
#include <cmath>

#include "thermal/error.h"
#include "thermal/integrate.h"
#include "thermal/modal_integration.h"
#include "thermal/newton_system.h"
#include "thermal/reduced_network.h"
#include "twin/diagnosis/channel_reading.h"

namespace thermotwin::twin {
namespace {

constexpr double gamma = 1.0 - 0.70710678118654752440;
constexpr double steepest = 3.0;  // slope at an end of a step, of the straight line's
constexpr int most_modes = 150;   // beyond, to find them takes longer than to run without
// From one sample to the next; most machines take three at most. What is stiff and not linear takes a hundred.
constexpr long most_steps_in_modes = 20;

}  // namespace

/// In blocks of rows that stay in the nearest cache.
void put_columns(ReadingByParameter const& response, double factor, std::vector<Eigen::Index> const& places,
                 Eigen::Ref<Eigen::MatrixXd> to) {
  constexpr Eigen::Index most = 32;
  for (Eigen::Index first = 0; first < response.rows(); first += most) {
    auto const rows = std::min(most, response.rows() - first);
    for (Eigen::Index k = 0; k < response.cols(); ++k)
      to.col(places[std::size_t(k)]).segment(first, rows) = factor * response.col(k).segment(first, rows);
  }
}

LinearisedRun::LinearisedRun(Machine const& machine, BinnedRun const& data) : machine_(&machine), data_(&data) {
  trace();
}

void LinearisedRun::trace() {
  auto const& course = *data_->run->course;
  auto const& steps = data_->steps;
  std::vector<double> times = {steps.front().begin};
  for (auto const& step : steps) times.push_back(step.end);
  thermal::IntegrationOptions options;
  options.relative_tolerance = 1e-5;  // 3 mK
  options.absolute_tolerance = 1e-4;
  options.most_steps = most_steps_in_modes * long(times.size());
  std::vector<std::vector<double>> states, inputs;
  auto const keep = [&](thermal::Sample const& sample) {
    states.emplace_back(sample.state.begin(), sample.state.end());
    inputs.emplace_back(sample.input.begin(), sample.input.end());
  };
  auto const& network = machine_->network();
  auto const from = start_of(*machine_, *data_->run);
  auto const in_modes = [&] {
    if (network.nodes() > most_modes || !thermal::why_irreducible(network).empty()) return false;
    try {
      thermal::integrate_in_modes(network, course, from, times, options, keep);
      return true;
    } catch (thermal::IntegrationError const&) {
      states.clear();
      inputs.clear();
      return false;
    }
  };
  if (!in_modes()) thermal::integrate(network, course, from, times, options, keep);
  auto const& names = network.channel_names();
  std::vector<int> places(std::size_t(network.external_channels()));
  for (std::size_t i = 0; i < places.size(); ++i) places[i] = course.index_of(names[i]);
  auto const end_of = [&](double time, std::vector<double> const& state, std::vector<double> input) {
    std::vector<double> values(course.channels().size());
    course.evaluate(time, values);
    for (std::size_t i = 0; i < places.size(); ++i) input[i] = values[std::size_t(places[i])];
    return End{time, state, std::move(input), std::move(values), {}};
  };
  thermal::Evaluation evaluation(network);
  std::vector<double> at_begin(states[0].size()), at_end(states[0].size());
  auto const rate = [&](End const& at, std::vector<double>& rates) {
    evaluation.rate(at.state.data(), at.input.data(), rates.data());
  };
  for (std::size_t s = 0; s < steps.size(); ++s) {
    auto const& [begin, end] = std::pair(steps[s].begin, steps[s].end);
    bool const jumps = course.next_jump(begin) <= end;
    begins_.push_back(end_of(begin, states[s], inputs[s]));
    ends_.push_back(end_of(jumps ? end - 1e-6 * (end - begin) : end, states[s + 1], inputs[s]));
    if (continues(s))
      at_begin.swap(at_end);
    else
      rate(begins_[s], at_begin);
    rate(ends_[s], at_end);
    bend(begins_[s], ends_[s], at_begin, at_end);
  }
}

/// Whether a step begins as the one before it ended: with the same inputs. The state always is the same.
bool LinearisedRun::continues(std::size_t step) const {
  return step > 0 && begins_[step].time == ends_[step - 1].time && begins_[step].input == ends_[step - 1].input;
}

/// The slopes of the nodes at the ends of a step, beyond those of straight lines. A cubic does not overshoot with them
/// (Fritsch & Carlson, SIAM J. Numer. Anal. 17 (1980) 238): what follows its input within seconds has slopes that say
/// nothing of the rest of the step.
void LinearisedRun::bend(End& begin, End& end, std::vector<double> const& rate_at_begin,
                         std::vector<double> const& rate_at_end) const {
  auto const& network = machine_->network();
  auto const temperature = [&](std::size_t node, double state) {
    return network.temperature_of_state(int(node), state);
  };
  for (auto const& [at, rate] : {std::pair(&begin, &rate_at_begin), std::pair(&end, &rate_at_end)}) {
    at->bend.resize(rate->size());
    for (std::size_t i = 0; i < rate->size(); ++i) {
      double const straight = (temperature(i, end.state[i]) - temperature(i, begin.state[i])) / (end.time - begin.time);
      double const slope = temperature(i, at->state[i] + (*rate)[i]) - temperature(i, at->state[i]);
      at->bend[i] = straight == 0.0 ? 0.0 : straight * (std::clamp(slope / straight, 0.0, steepest) - 1.0);
    }
  }
}

double LinearisedRun::temperature(int node, End const& at) const {
  return machine_->network().temperature_of_state(node, at.state[std::size_t(node)]);
}

/// Σ wᵢ Tᵢ.
LinearisedRun::Piece LinearisedRun::along(NodeWeights const& weights, std::size_t step) const {
  auto const &begin = begins_[step], &end = ends_[step];
  Piece piece;
  for (auto const& [node, weight] : weights) {
    piece.from += weight * temperature(node, begin);
    piece.to += weight * temperature(node, end);
    piece.bend_from += weight * begin.bend[std::size_t(node)];
    piece.bend_to += weight * end.bend[std::size_t(node)];
  }
  return piece;
}

/// Σ wᵢ (Tᵢ − Tᵢ(0)).
LinearisedRun::Piece LinearisedRun::since_start(NodeWeights const& weights, std::size_t step) const {
  Piece piece = along(weights, step);
  double start = 0.0;
  for (auto const& [node, weight] : weights) start += weight * temperature(node, begins_.front());
  piece.from -= start;
  piece.to -= start;
  return piece;
}

/// Of a channel in a machine of the same nodes.
LinearisedRun::Piece LinearisedRun::before_lag(ChannelReading const& channel, std::size_t step) const {
  Piece piece;
  if (channel.sensor) piece = along(channel.sensor->weights, step);
  if (channel.displacement) piece = since_start(channel.displacement->weights, step);
  piece.bend_from *= 1.0 - channel.air_share;
  piece.bend_to *= 1.0 - channel.air_share;
  auto const& at_start = begins_.front().course;
  piece.from = channel.before_lag(piece.from, begins_[step].course, at_start);
  piece.to = channel.before_lag(piece.to, ends_[step].course, at_start);
  return piece;
}

/// x − τx' + τ²x'' − τ³x''' of the cubic, from what the channel shows at the begin.
LinearisedRun::Lagged LinearisedRun::lagged(double shown, Piece const& piece, double lag, double length) {
  double const slope = (piece.to - piece.from) / length;
  double const second = -2.0 * (2.0 * piece.bend_from + piece.bend_to) / length;  // x'' at the begin
  double const third = 6.0 * (piece.bend_from + piece.bend_to) / (length * length);
  auto const later = [&](double curvature) { return -lag * (curvature - lag * third); };  // its slope beyond x'
  auto const followed = [&](double x, double first, double curvature) { return x - lag * (first + later(curvature)); };
  Lagged result;
  double const second_at_end = second + third * length;
  result.piece.from = followed(piece.from, slope + piece.bend_from, second);
  result.piece.to = followed(piece.to, slope + piece.bend_to, second_at_end);
  double const own_slope = (result.piece.to - result.piece.from) / length;
  result.piece.bend_from = slope + piece.bend_from + later(second) - own_slope;
  result.piece.bend_to = slope + piece.bend_to + later(second_at_end) - own_slope;
  result.decaying = shown - result.piece.from;
  return result;
}

/// Of a channel, by its number.
template <class Pieces>
Eigen::VectorXd LinearisedRun::rows_of(std::size_t channel, Pieces const& pieces, double lag) const {
  auto const& steps = data_->steps;
  Eigen::VectorXd rows = Eigen::VectorXd::Zero(data_->time.size());
  double shown = 0.0;
  for (std::size_t s = 0; s < steps.size(); ++s) {
    auto const& step = steps[s];
    auto const& readings = data_->readings[channel][s];
    Piece piece = pieces(s);
    if (lag > 0.0) {
      if (s == 0) shown = piece.from;
      auto const behind = lagged(shown, piece, lag, step.length());
      piece = behind.piece;
      shown = piece.to + behind.decaying * std::exp(-step.length() / lag);
      for (double const sample : readings.samples)
        rows[step.row] += readings.share * behind.decaying * std::exp(-sample / lag);
    }
    rows[step.row] += readings.at_begin * piece.from + readings.at_end * piece.to +
                      readings.bend_at_begin * piece.bend_from + readings.bend_at_end * piece.bend_to;
  }
  return rows;
}

Eigen::MatrixXd LinearisedRun::prediction_of(Machine const& other) const {
  auto const readings = readings_of(other, *data_->run);
  Eigen::MatrixXd rows(data_->time.size(), Eigen::Index(readings.size()));
  for (std::size_t c = 0; c < readings.size(); ++c) {
    auto const& reading = readings[c];
    auto const behind_lag = rows_of(
        c, [&](std::size_t step) { return before_lag(reading, step); }, reading.lag);
    rows.col(Eigen::Index(c)) = reading.shown(behind_lag, data_->time);
  }
  return rows;
}

Eigen::MatrixXd LinearisedRun::growth(std::vector<NodeWeights> const& displacements) const {
  auto const readings = readings_of(*machine_, *data_->run);
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(data_->time.size(), Eigen::Index(readings.size()));
  for (std::size_t c = 0; c < readings.size(); ++c) {
    if (!readings[c].displacement) continue;
    auto const& weights = displacements[std::size_t(readings[c].displacement - machine_->linear_channels.data())];
    rows.col(Eigen::Index(c)) = rows_of(
        c, [&](std::size_t step) { return since_start(weights, step); }, 0.0);
  }
  return rows;
}

LinearisedRun::ChannelByNode LinearisedRun::weights() const {
  auto const readings = readings_of(*machine_, *data_->run);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t c = 0; c < readings.size(); ++c) {
    if (readings[c].sensor)
      for (auto const& [node, weight] : readings[c].sensor->weights)
        entries.emplace_back(int(c), node, (1.0 - readings[c].air_share) * weight);
    if (readings[c].displacement)
      for (auto const& [node, weight] : readings[c].displacement->weights) entries.emplace_back(int(c), node, weight);
  }
  ChannelByNode result(Eigen::Index(readings.size()), machine_->network().nodes());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

ReadingByParameter LinearisedRun::response(thermal::ParameterColumns const& parameters, Eigen::MatrixXd const& initial,
                                           int forced_nodes) const {
  Eigen::Index const nodes = machine_->network().nodes();
  Eigen::MatrixXd const start = initial.size() ? initial : Eigen::MatrixXd::Zero(nodes, parameters.count());
  return response(
      [&](thermal::Evaluation& evaluation, double, auto const& state, auto const& input,
          thermal::NodeByParameter& forcing) {
        parameters.evaluate(evaluation, state.data(), input.data(), forcing);
        if (forced_nodes >= 0) forcing.bottomRows(nodes - forced_nodes).setZero();
      },
      start);
}

ReadingByParameter LinearisedRun::response(Forcing const& forcing, Eigen::MatrixXd const& initial, Leap const& leap,
                                           std::size_t first_step) const {
  auto const& network = machine_->network();
  auto const n = Eigen::Index(network.nodes());
  auto const m = initial.cols();
  auto const& steps = data_->steps;
  auto const rows = data_->time.size();
  auto const readings = readings_of(*machine_, *data_->run);
  ChannelByNode const H = weights();
  thermal::Evaluation evaluation(network);
  thermal::NewtonSystem system(network, thermal::LinearSolver::sparse_direct);
  thermal::NodeByParameter S = initial, from_forcing(n, m), to_forcing(n, m), stage(n, m);
  thermal::NodeByParameter from = H * S, to(H.rows(), m), shown = from;
  thermal::NodeByParameter const at_start = from;
  ReadingByParameter result = ReadingByParameter::Zero(rows * H.rows(), m);
  if (m == 0) return result;
  std::vector<double> middle(static_cast<std::size_t>(n)), input;
  for (std::size_t s = first_step; s < steps.size(); ++s) {
    double const h = steps[s].length();
    if (leap(evaluation, s, S)) from = H * S;
    for (Eigen::Index i = 0; i < n; ++i)
      middle[std::size_t(i)] = 0.5 * (begins_[s].state[std::size_t(i)] + ends_[s].state[std::size_t(i)]);
    input = begins_[s].input;
    for (std::size_t i = 0; i < input.size(); ++i) input[i] = 0.5 * (input[i] + ends_[s].input[i]);
    system.linearise(evaluation, middle.data(), input.data());
    if (s > first_step && continues(s))
      from_forcing.swap(to_forcing);
    else
      forcing(evaluation, begins_[s].time, begins_[s].state, begins_[s].input, from_forcing);
    forcing(evaluation, ends_[s].time, ends_[s].state, ends_[s].input, to_forcing);
    // A stage k = A x + f has x = S + γh k, so that (I − γhA) x = S + γh f; the second stage ends where the step does.
    stage = S + gamma * h * ((1.0 - gamma) * from_forcing + gamma * to_forcing);
    bool const solved = system.factorise(gamma * h) && system.solve_nodes(0.0, stage);
    S += (1.0 - gamma) / gamma * (stage - S) + gamma * h * to_forcing;
    if (!solved || !system.solve_nodes(0.0, S))
      throw thermal::IntegrationError("the equations linearised along the run have no solution");
    to = H * S;
    for (Eigen::Index c = 0; c < H.rows(); ++c) {
      double const lag = readings[std::size_t(c)].lag;
      bool const relative = readings[std::size_t(c)].displacement != nullptr;
      auto const& own = data_->readings[std::size_t(c)][s];
      auto target = result.row(c * rows + steps[s].row);
      target += own.at_begin * (lag > 0.0 ? shown.row(c) : from.row(c));
      if (lag > 0.0) {
        double const decay = std::exp(-h / lag);
        shown.row(c) = (to.row(c) - (to.row(c) - from.row(c)) * lag / h +
                        (shown.row(c) - from.row(c) + (to.row(c) - from.row(c)) * lag / h) * decay)
                           .eval();
      }
      target += own.at_end * (lag > 0.0 ? shown.row(c) : to.row(c));
      if (relative) target -= (own.at_begin + own.at_end) * at_start.row(c);
    }
    from.swap(to);
  }
  return result;
}

ReadingByParameter LinearisedRun::response_to_earlier(std::vector<double> const& jumps) const {
  auto const count = Eigen::Index(jumps.size());
  return response_to_earlier(count, [&](std::size_t step) {
    auto const jump = std::find(jumps.begin(), jumps.end(), begins_[step].time) - jumps.begin();
    return jump == count ? -1 : Eigen::Index(jump);
  });
}

ReadingByParameter LinearisedRun::response_to_all_earlier() const {
  return response_to_earlier(1, [&](std::size_t step) { return ends_[step - 1].time < begins_[step].time ? 0 : -1; });
}

ReadingByParameter LinearisedRun::response_to_earlier(
    Eigen::Index count, std::function<Eigen::Index(std::size_t step)> const& column_of) const {
  Eigen::Index const nodes = machine_->network().nodes();
  Eigen::VectorXd after(nodes), before(nodes);
  auto const leap = [&](thermal::Evaluation& evaluation, std::size_t step, thermal::NodeByParameter& s) {
    Eigen::Index const column = step == 0 ? -1 : column_of(step);
    if (column < 0) return false;
    double const* const state = begins_[step].state.data();
    evaluation.rate(state, begins_[step].input.data(), after.data());
    evaluation.rate(state, ends_[step - 1].input.data(), before.data());
    s.col(column) += after - before;
    return true;
  };
  auto const unforced = [](thermal::Evaluation&, double, auto const&, auto const&, thermal::NodeByParameter& forcing) {
    forcing.setZero();
  };
  return response(unforced, Eigen::MatrixXd::Zero(nodes, count), leap, 0);
}

/// Of rates where each step begins [K/s].
std::map<std::string, Eigen::VectorXd> LinearisedRun::heat_of_bodies(
    std::function<void(End const&, Eigen::VectorXd& rates)> const& rates_at) const {
  auto const& network = machine_->network();
  Eigen::VectorXd rates(network.nodes());
  std::map<std::string, Eigen::VectorXd> heat;
  for (auto const& range : network.ranges()) heat[range.name].setZero(Eigen::Index(begins_.size()));
  for (std::size_t s = 0; s < begins_.size(); ++s) {
    rates_at(begins_[s], rates);
    for (auto const& range : network.ranges())
      for (int i = range.first; i < range.first + range.count; ++i)
        heat[range.name][Eigen::Index(s)] += network.capacity()[std::size_t(i)] * rates[i];
  }
  return heat;
}

std::map<std::string, Eigen::VectorXd> LinearisedRun::more_heat_than(Machine const& other) const {
  thermal::Evaluation with(machine_->network()), without(other.network());
  Eigen::VectorXd rates_without(machine_->network().nodes());
  return heat_of_bodies([&](End const& at, Eigen::VectorXd& rates) {
    with.rate(at.state.data(), at.input.data(), rates.data());
    without.rate(at.state.data(), at.input.data(), rates_without.data());
    rates -= rates_without;
  });
}

std::map<std::string, Eigen::VectorXd> LinearisedRun::more_heat_per_unit(
    thermal::NetworkDerivative const& number) const {
  thermal::Evaluation evaluation(machine_->network());
  thermal::ParameterColumns const parameter(machine_->network(), {&number});
  thermal::NodeByParameter column(machine_->network().nodes(), 1);
  return heat_of_bodies([&](End const& at, Eigen::VectorXd& rates) {
    parameter.evaluate(evaluation, at.state.data(), at.input.data(), column);
    rates = column.col(0);
  });
}

LinearisedRun::MeanHeat LinearisedRun::mean(Eigen::VectorXd const& heat) const {
  MeanHeat mean;
  double moving = 0.0, standing = 0.0;
  for (std::size_t s = 0; s < begins_.size(); ++s) {
    double const length = data_->steps[s].length();
    bool const moves = is_moving(*data_->run->course, begins_[s].time);
    (moves ? moving : standing) += length;
    (moves ? mean.moving : mean.standing) += length * heat[Eigen::Index(s)];
  }
  return {mean.moving / std::max(moving, 1.0), mean.standing / std::max(standing, 1.0)};
}

bool is_moving(thermal::Course const& course, double time) {
  auto const& channels = course.channels();
  std::vector<double> values(channels.size());
  course.evaluate(time, values);
  for (std::size_t i = 0; i < channels.size(); ++i)
    if (channels[i].name.ends_with(".running") && values[i] > 0.5) return true;
  return false;
}

}  // namespace thermotwin::twin
