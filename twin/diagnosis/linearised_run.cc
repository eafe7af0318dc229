#include "twin/diagnosis/linearised_run.h"

#include <algorithm>
#include <cmath>

#include "thermal/error.h"
#include "thermal/integrate.h"
#include "thermal/newton_system.h"
#include "twin/diagnosis/channel_reading.h"
#include "twin/run.h"

namespace thermotwin::twin {
namespace {

constexpr double gamma = 1.0 - 0.70710678118654752440;

/// A first-order lag, exactly for an input that is linear within a step.
double lagged(double before, double from, double to, double lag, double step) {
  if (lag <= 0.0) return to;
  double const slope = (to - from) / step, decay = std::exp(-step / lag);
  return to - slope * lag + (before - from + slope * lag) * decay;
}

double value_of(std::vector<double> const& course, int channel) {
  return channel < 0 ? 0.0 : course[std::size_t(channel)];
}

int channel_index(thermal::Course const& course, std::string const& name) {
  auto const& channels = course.channels();
  for (std::size_t i = 0; i < channels.size(); ++i)
    if (channels[i].name == name) return int(i);
  return -1;
}

}  // namespace

/// A channel of the data in a machine, as it is read along a course.
class LinearisedRun::View : public ChannelReading {
 public:
  View(Machine const& machine, MeasuredRun const& run, MeasuredChannel const& channel);
  static std::vector<View> of(Machine const& machine, MeasuredRun const& run) {
    std::vector<View> views;
    for (auto const& channel : run.channels) views.emplace_back(machine, run, channel);
    return views;
  }
  /// Before its lag.
  [[nodiscard]] double shown(LinearisedRun const& run, End const& end) const;

 private:
  [[nodiscard]] double air(End const& end, double height) const;

  double height_ = 0.0;
  int floor_ = -1, gradient_ = -1;
  std::vector<int> term_channels_;
};

LinearisedRun::View::View(Machine const& machine, MeasuredRun const& run, MeasuredChannel const& channel)
    : ChannelReading(reading_of(machine, channel)),
      floor_(channel_index(*run.course, "ambient.floor_temperature")),
      gradient_(channel_index(*run.course, "ambient.gradient")) {
  if (sensor) height_ = sensor->position.dot(machine.up);
  if (displacement)
    for (auto const& term : displacement->input_terms)
      term_channels_.push_back(channel_index(*run.course, term.channel));
}

double LinearisedRun::View::air(End const& end, double height) const {
  return value_of(end.course, floor_) + height * value_of(end.course, gradient_);
}

double LinearisedRun::View::shown(LinearisedRun const& run, End const& end) const {
  auto const& network = run.machine_->network();
  auto const temperature = [&](int node, End const& at) {
    return network.temperature_of_state(node, at.state[std::size_t(node)]);
  };
  auto const& start = run.begins_.front();
  double value = offset + drift * end.time;
  if (sensor) {
    double body = sensor->weights.empty() ? air(end, height_) : 0.0;
    for (auto const& [node, weight] : sensor->weights) body += weight * temperature(node, end);
    return value + body - (air_share == 0.0 ? 0.0 : air_share * (body - air(end, height_)));
  }
  if (!displacement) return value;
  for (auto const& [node, weight] : displacement->weights)
    value += weight * (temperature(node, end) - temperature(node, start));
  for (std::size_t t = 0; t < term_channels_.size(); ++t) {
    auto const& term = displacement->input_terms[t];
    value += term.coefficient * (std::pow(value_of(end.course, term_channels_[t]), term.power) -
                                 std::pow(value_of(start.course, term_channels_[t]), term.power));
  }
  return per_air == 0.0 ? value : value + per_air * (air(end, 0.0) - air(start, 0.0));
}

LinearisedRun::LinearisedRun(Machine const& machine, BinnedRun const& data) : machine_(&machine), data_(&data) {
  trace();
}

void LinearisedRun::trace() {
  auto const& course = *data_->run->course;
  auto const& steps = data_->steps;
  std::vector<double> times = {steps.front().begin};
  for (auto const& step : steps) times.push_back(step.end);
  scenarios::Experiment start;
  start.initial_temperature = data_->run->initial_temperature;
  thermal::IntegrationOptions options;
  options.relative_tolerance = 1e-5;  // 3 mK
  options.absolute_tolerance = 1e-4;
  std::vector<std::vector<double>> states, inputs;
  thermal::integrate(machine_->network(), course, initial_temperatures(*machine_, start, course), times, options,
                     [&](thermal::Sample const& sample) {
                       states.emplace_back(sample.state.begin(), sample.state.end());
                       inputs.emplace_back(sample.input.begin(), sample.input.end());
                     });
  auto const& names = machine_->network().channel_names();
  std::vector<int> from(std::size_t(machine_->network().external_channels()));
  for (std::size_t i = 0; i < from.size(); ++i) from[i] = channel_index(course, names[i]);
  auto const end_of = [&](double time, std::vector<double> const& state, std::vector<double> input) {
    std::vector<double> values(course.channels().size());
    course.evaluate(time, values);
    for (std::size_t i = 0; i < from.size(); ++i) input[i] = values[std::size_t(from[i])];
    return End{time, state, std::move(input), std::move(values)};
  };
  for (std::size_t s = 0; s < steps.size(); ++s) {
    auto const& [begin, end] = std::pair(steps[s].begin, steps[s].end);
    bool const jumps = course.next_jump(begin) <= end;
    begins_.push_back(end_of(begin, states[s], inputs[s]));
    ends_.push_back(end_of(jumps ? end - 1e-6 * (end - begin) : end, states[s + 1], inputs[s]));
  }
}

/// The rows of the data from the values at both ends of every step, channel by channel, each behind its lag.
void LinearisedRun::average(std::vector<double> const& lags, Eigen::MatrixXd const& begins, Eigen::MatrixXd const& ends,
                            Eigen::MatrixXd& rows) const {
  auto const& steps = data_->steps;
  rows.setZero(data_->time.size(), begins.cols());
  for (Eigen::Index c = 0; c < begins.cols(); ++c) {
    double const lag = lags[std::size_t(c)];
    double shown = begins(0, c);
    for (std::size_t s = 0; s < steps.size(); ++s) {
      auto const step = Eigen::Index(s);
      double const begin = lag > 0.0 ? shown : begins(step, c);
      shown = lagged(shown, begins(step, c), ends(step, c), lag, steps[s].end - steps[s].begin);
      rows(steps[s].row, c) += steps[s].at_begin * begin + steps[s].at_end * shown;
    }
  }
}

Eigen::MatrixXd LinearisedRun::prediction_of(Machine const& other) const {
  auto const& steps = data_->steps;
  auto const views = View::of(other, *data_->run);
  auto const count = Eigen::Index(views.size());
  Eigen::MatrixXd begins(Eigen::Index(steps.size()), count), ends = begins, rows;
  std::vector<double> lags;
  for (Eigen::Index c = 0; c < count; ++c) {
    auto const& view = views[std::size_t(c)];
    lags.push_back(view.lag);
    for (std::size_t s = 0; s < steps.size(); ++s) {
      begins(Eigen::Index(s), c) = view.shown(*this, begins_[s]);
      ends(Eigen::Index(s), c) = view.shown(*this, ends_[s]);
    }
  }
  average(lags, begins, ends, rows);
  return rows;
}

Eigen::MatrixXd LinearisedRun::growth(std::vector<NodeWeights> const& displacements) const {
  auto const& steps = data_->steps;
  auto const& network = machine_->network();
  auto const views = View::of(*machine_, *data_->run);
  Eigen::MatrixXd begins = Eigen::MatrixXd::Zero(Eigen::Index(steps.size()), Eigen::Index(views.size())), ends = begins;
  for (std::size_t c = 0; c < views.size(); ++c) {
    if (!views[c].displacement) continue;
    for (auto const& [node, weight] :
         displacements[std::size_t(views[c].displacement - machine_->displacements.data())])
      for (std::size_t s = 0; s < steps.size(); ++s) {
        auto const rise = [&, i = node](End const& end) {
          return network.temperature_of_state(i, end.state[std::size_t(i)]) -
                 network.temperature_of_state(i, begins_[0].state[std::size_t(i)]);
        };
        begins(Eigen::Index(s), Eigen::Index(c)) += weight * rise(begins_[s]);
        ends(Eigen::Index(s), Eigen::Index(c)) += weight * rise(ends_[s]);
      }
  }
  Eigen::MatrixXd rows;
  average(std::vector<double>(views.size(), 0.0), begins, ends, rows);
  return rows;
}

Eigen::MatrixXd LinearisedRun::weights() const {
  auto const views = View::of(*machine_, *data_->run);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(Eigen::Index(views.size()), machine_->network().nodes());
  for (std::size_t c = 0; c < views.size(); ++c) {
    if (views[c].sensor)
      for (auto const& [node, weight] : views[c].sensor->weights)
        result(Eigen::Index(c), node) += (1.0 - views[c].air_share) * weight;
    if (views[c].displacement)
      for (auto const& [node, weight] : views[c].displacement->weights) result(Eigen::Index(c), node) += weight;
  }
  return result;
}

Eigen::MatrixXd LinearisedRun::response(thermal::ParameterColumns const& parameters, Eigen::MatrixXd const& initial,
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

Eigen::MatrixXd LinearisedRun::response(Forcing const& forcing, Eigen::MatrixXd const& initial) const {
  auto const& network = machine_->network();
  auto const n = Eigen::Index(network.nodes());
  auto const m = initial.cols();
  auto const& steps = data_->steps;
  auto const rows = data_->time.size();
  auto const views = View::of(*machine_, *data_->run);
  Eigen::MatrixXd const H = weights();
  thermal::Evaluation evaluation(network);
  thermal::NewtonSystem system(network, thermal::LinearSolver::sparse_direct);
  thermal::NodeByParameter S = initial, from_forcing(n, m), to_forcing(n, m), stage(n, m);
  thermal::NodeByParameter from = H * S, to(H.rows(), m), shown = from;
  thermal::NodeByParameter const at_start = from;
  thermal::NodeByParameter result = thermal::NodeByParameter::Zero(rows * H.rows(), m);
  std::vector<double> middle(static_cast<std::size_t>(n)), input;
  for (std::size_t s = 0; s < steps.size(); ++s) {
    double const h = steps[s].end - steps[s].begin;
    for (Eigen::Index i = 0; i < n; ++i)
      middle[std::size_t(i)] = 0.5 * (begins_[s].state[std::size_t(i)] + ends_[s].state[std::size_t(i)]);
    input = begins_[s].input;
    for (std::size_t i = 0; i < input.size(); ++i) input[i] = 0.5 * (input[i] + ends_[s].input[i]);
    system.linearise(evaluation, middle.data(), input.data());
    if (s > 0 && begins_[s].time == ends_[s - 1].time && begins_[s].input == ends_[s - 1].input)
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
    to.noalias() = H * S;
    for (Eigen::Index c = 0; c < H.rows(); ++c) {
      double const lag = views[std::size_t(c)].lag;
      bool const relative = views[std::size_t(c)].displacement != nullptr;
      auto target = result.row(c * rows + steps[s].row);
      target += steps[s].at_begin * (lag > 0.0 ? shown.row(c) : from.row(c));
      if (lag > 0.0) {
        double const decay = std::exp(-h / lag);
        shown.row(c) = (to.row(c) - (to.row(c) - from.row(c)) * lag / h +
                        (shown.row(c) - from.row(c) + (to.row(c) - from.row(c)) * lag / h) * decay)
                           .eval();
      }
      target += steps[s].at_end * (lag > 0.0 ? shown.row(c) : to.row(c));
      if (relative) target -= (steps[s].at_begin + steps[s].at_end) * at_start.row(c);
    }
    from.swap(to);
  }
  return result;
}

std::map<std::string, LinearisedRun::MeanHeat> LinearisedRun::more_heat_than(Machine const& other) const {
  auto const& network = machine_->network();
  thermal::Evaluation with(network), without(other.network());
  std::vector<double> rate(std::size_t(network.nodes())), rate_without(rate.size());
  std::map<std::string, MeanHeat> heat;
  double moving = 0.0, standing = 0.0;
  for (std::size_t s = 0; s < begins_.size(); ++s) {
    double const length = data_->steps[s].end - data_->steps[s].begin;
    bool const moves = is_moving(*data_->run->course, begins_[s].time);
    (moves ? moving : standing) += length;
    with.rate(begins_[s].state.data(), begins_[s].input.data(), rate.data());
    without.rate(begins_[s].state.data(), begins_[s].input.data(), rate_without.data());
    for (auto const& range : network.ranges())
      for (auto i = std::size_t(range.first); i < std::size_t(range.first + range.count); ++i)
        (moves ? heat[range.name].moving : heat[range.name].standing) +=
            length * network.capacity()[i] * (rate[i] - rate_without[i]);
  }
  for (auto& [body, mean] : heat) {
    mean.moving /= std::max(moving, 1.0);
    mean.standing /= std::max(standing, 1.0);
  }
  return heat;
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
