#include "twin/diagnosis/linearised_run.h"

#include <Eigen/LU>
#include <cmath>

#include "thermal/error.h"
#include "thermal/integrate.h"
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

int channel_index(thermal::Course const& course, std::string const& name) {
  auto const& channels = course.channels();
  for (std::size_t i = 0; i < channels.size(); ++i)
    if (channels[i].name == name) return int(i);
  return -1;
}

}  // namespace

/// What of a machine's sensor or displacement a channel of the data is.
struct ChannelView {
  Sensor const* sensor = nullptr;
  Displacement const* displacement = nullptr;
  double lag = 0.0, share = 0.0, drift = 0.0, per_air = 0.0, offset = 0.0;
};

static std::vector<ChannelView> views_of(Machine const& machine, MeasuredRun const& run) {
  std::vector<ChannelView> views;
  for (auto const& channel : run.channels) {
    ChannelView view;
    for (auto const& sensor : machine.sensors)
      if (!channel.displacement && sensor.description.name == channel.name) {
        view.sensor = &sensor;
        view.lag = sensor.description.lag.value_or(0.0);
        view.share = sensor.description.stem_loss.value_or(0.0);
        view.drift = sensor.description.drift.value_or(0.0);
        view.offset = sensor.description.offset.value_or(0.0);
      }
    for (auto const& displacement : machine.displacements)
      if (channel.displacement && displacement.name == channel.name) view.displacement = &displacement;
    for (auto const& term : machine.reading_terms)
      if (term.channel == channel.name) {
        view.lag += term.lag;
        view.share += term.air_share;
        view.drift += term.drift;
        view.per_air += term.per_air;
      }
    views.push_back(view);
  }
  return views;
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
  std::vector<std::vector<double>> states, inputs;
  thermal::integrate(machine_->network(), course, initial_temperatures(*machine_, start, course), times, {},
                     [&](thermal::Sample const& sample) {
                       states.emplace_back(sample.state.begin(), sample.state.end());
                       inputs.emplace_back(sample.input.begin(), sample.input.end());
                     });
  auto const& names = machine_->network().channel_names();
  std::vector<int> from(std::size_t(machine_->network().external_channels()));
  for (std::size_t i = 0; i < from.size(); ++i) from[i] = channel_index(course, names[i]);
  std::vector<double> values(course.channels().size());
  auto const at = [&](double time, std::vector<double> input) {
    course.evaluate(time, values);
    for (std::size_t i = 0; i < from.size(); ++i) input[i] = values[std::size_t(from[i])];
    return input;
  };
  for (std::size_t s = 0; s < steps.size(); ++s) {
    double const inside = 1e-6 * (steps[s].end - steps[s].begin);
    begins_.push_back({states[s], at(steps[s].begin, inputs[s])});
    ends_.push_back({states[s + 1], at(steps[s].end - inside, inputs[s])});
  }
}

Eigen::VectorXd LinearisedRun::outputs(Machine const& machine, End const& end, double time) const {
  auto const& network = machine_->network();
  auto const& names = network.channel_names();
  auto const input_named = [&](std::string const& name, std::vector<double> const& input) {
    for (std::size_t i = 0; i < input.size(); ++i)
      if (names[i] == name) return input[i];
    auto const& course = *data_->run->course;
    int const c = channel_index(course, name);
    if (c < 0) return 0.0;
    std::vector<double> values(course.channels().size());
    course.evaluate(time, values);
    return values[std::size_t(c)];
  };
  auto const temperature = [&](int node, std::vector<double> const& state) {
    return network.temperature_of_state(node, state[std::size_t(node)]);
  };
  auto const air_at = [&](std::vector<double> const& input, double height) {
    return input_named("ambient.floor_temperature", input) + height * input_named("ambient.gradient", input);
  };
  auto const& start = begins_.front();
  auto const views = views_of(machine, *data_->run);
  Eigen::VectorXd result(Eigen::Index(views.size()));
  for (std::size_t c = 0; c < views.size(); ++c) {
    double value = views[c].offset + views[c].drift * time;
    if (auto const* sensor = views[c].sensor) {
      double const air = air_at(end.input, sensor->position.dot(machine.up));
      double body = sensor->weights.empty() ? air : 0.0;
      for (auto const& [node, weight] : sensor->weights) body += weight * temperature(node, end.state);
      value += body - views[c].share * (body - air);
    } else if (auto const* displacement = views[c].displacement) {
      for (auto const& [node, weight] : displacement->weights)
        value += weight * (temperature(node, end.state) - temperature(node, start.state));
      for (auto const& term : displacement->input_terms)
        value += term.coefficient * (std::pow(input_named(term.channel, end.input), term.power) -
                                     std::pow(input_named(term.channel, start.input), term.power));
      if (views[c].per_air != 0.0) value += views[c].per_air * (air_at(end.input, 0.0) - air_at(start.input, 0.0));
    }
    result[Eigen::Index(c)] = value;
  }
  return result;
}

Eigen::MatrixXd LinearisedRun::prediction_of(Machine const& other) const {
  auto const& steps = data_->steps;
  auto const views = views_of(other, *data_->run);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(data_->time.size(), Eigen::Index(views.size()));
  Eigen::VectorXd shown = outputs(other, begins_[0], steps[0].begin);
  for (std::size_t s = 0; s < steps.size(); ++s) {
    Eigen::VectorXd const from = outputs(other, begins_[s], steps[s].begin);
    Eigen::VectorXd const to = outputs(other, ends_[s], steps[s].end);
    for (Eigen::Index c = 0; c < result.cols(); ++c) {
      double const lag = views[std::size_t(c)].lag;
      double const begin = lag > 0.0 ? shown[c] : from[c];
      shown[c] = lagged(shown[c], from[c], to[c], lag, steps[s].end - steps[s].begin);
      result(steps[s].row, c) += steps[s].at_begin * begin + steps[s].at_end * shown[c];
    }
  }
  return result;
}

Eigen::MatrixXd LinearisedRun::slope() const {
  auto const& steps = data_->steps;
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(data_->time.size(), Eigen::Index(data_->run->channels.size()));
  for (std::size_t s = 0; s < steps.size(); ++s)
    result.row(steps[s].row) +=
        (steps[s].at_begin + steps[s].at_end) / (steps[s].end - steps[s].begin) *
        (outputs(*machine_, begins_[s], steps[s].begin) - outputs(*machine_, ends_[s], steps[s].end)).transpose();
  return result;
}

Eigen::MatrixXd LinearisedRun::weights() const {
  auto const views = views_of(*machine_, *data_->run);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(Eigen::Index(views.size()), machine_->network().nodes());
  for (std::size_t c = 0; c < views.size(); ++c) {
    if (views[c].sensor)
      for (auto const& [node, weight] : views[c].sensor->weights)
        result(Eigen::Index(c), node) += (1.0 - views[c].share) * weight;
    if (views[c].displacement)
      for (auto const& [node, weight] : views[c].displacement->weights) result(Eigen::Index(c), node) += weight;
  }
  return result;
}

Eigen::MatrixXd LinearisedRun::response(thermal::ParameterColumns const& parameters,
                                        Eigen::MatrixXd const& initial) const {
  auto const& network = machine_->network();
  auto const n = Eigen::Index(network.nodes());
  auto const m = Eigen::Index(parameters.count());
  auto const& steps = data_->steps;
  auto const rows = data_->time.size();
  auto const views = views_of(*machine_, *data_->run);
  Eigen::MatrixXd const H = weights();
  thermal::Evaluation evaluation(network);
  Eigen::MatrixXd S = initial.size() ? initial : Eigen::MatrixXd::Zero(n, m);
  Eigen::MatrixXd from_forcing(n, m), to_forcing(n, m), first(n, m), second(n, m);
  Eigen::MatrixXd from = H * S, to(H.rows(), m), shown = from;
  Eigen::MatrixXd const at_start = from;
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(rows * H.rows(), m);
  std::vector<double> middle(static_cast<std::size_t>(n)), input;
  Eigen::MatrixXd const identity = Eigen::MatrixXd::Identity(n, n);
  for (std::size_t s = 0; s < steps.size(); ++s) {
    double const h = steps[s].end - steps[s].begin;
    for (Eigen::Index i = 0; i < n; ++i)
      middle[std::size_t(i)] = 0.5 * (begins_[s].state[std::size_t(i)] + ends_[s].state[std::size_t(i)]);
    input = begins_[s].input;
    for (std::size_t i = 0; i < input.size(); ++i) input[i] = 0.5 * (input[i] + ends_[s].input[i]);
    Eigen::MatrixXd const A = evaluation.jacobian(middle.data(), input.data());
    Eigen::MatrixXd const M = (identity - gamma * h * A).partialPivLu().inverse();
    parameters.evaluate(evaluation, begins_[s].state.data(), begins_[s].input.data(), from_forcing);
    parameters.evaluate(evaluation, ends_[s].state.data(), ends_[s].input.data(), to_forcing);
    from_forcing = (1.0 - gamma) * from_forcing + gamma * to_forcing;
    first.noalias() = A * S + from_forcing;
    first = M * first;
    second.noalias() = A * (S + (1.0 - gamma) * h * first) + to_forcing;
    second = M * second;
    S += h * ((1.0 - gamma) * first + gamma * second);
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

Eigen::VectorXd LinearisedRun::heat_of(int part) const {
  thermal::Evaluation evaluation(machine_->network());
  std::vector<double> watts(machine_->network().parts().size());
  Eigen::VectorXd result(Eigen::Index(begins_.size()));
  for (std::size_t s = 0; s < begins_.size(); ++s) {
    evaluation.heat_of_parts(begins_[s].state.data(), begins_[s].input.data(), watts);
    result[Eigen::Index(s)] = watts[std::size_t(part)];
  }
  return result;
}

}  // namespace thermotwin::twin
