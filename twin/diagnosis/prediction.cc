#include "twin/diagnosis/prediction.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "thermal/error.h"
#include "thermal/integrate.h"
#include "twin/diagnosis/channel_reading.h"
#include "twin/instruments/first_order_lag.h"
#include "twin/run.h"

namespace thermotwin::twin {
namespace {

constexpr double tool_height = 1.0;  // m, where the air near the tool is taken

double weighted(NodeWeights const& weights, std::span<double const> temperatures) {
  double sum = 0.0;
  for (auto const& [node, weight] : weights) sum += weight * temperatures[std::size_t(node)];
  return sum;
}

/// Runs the machine and looks at it through the channels of a run.
class Predictor {
 public:
  Predictor(Machine const& machine, MeasuredRun const& run);
  Eigen::MatrixXd operator()();

 private:
  void look(thermal::Sample const& sample, Eigen::Index row);
  [[nodiscard]] double input(std::string const& name, double otherwise) const;
  [[nodiscard]] double air_at(double height) const;
  [[nodiscard]] double seen(ChannelReading const& view, thermal::Sample const& sample) const;

  Machine const& machine_;
  MeasuredRun const& run_;
  std::vector<ChannelReading> views_;
  std::vector<double> times_;  ///< 0, and those of the run
  std::vector<double> inputs_;
  Eigen::MatrixXd seen_;
};

Predictor::Predictor(Machine const& machine, MeasuredRun const& run)
    : machine_(machine), run_(run), inputs_(run.course->channels().size()) {
  for (auto const& channel : run.channels) {
    auto const view = reading_of(machine, channel);
    if (!view.sensor && !view.displacement)
      throw thermal::InputError(fmt::format("the machine '{}' has no channel '{}'", machine.name, channel.name));
    views_.push_back(view);
  }
  if (run.time[0] > 0.0) times_.push_back(0.0);
  times_.insert(times_.end(), run.time.begin(), run.time.end());
}

double Predictor::input(std::string const& name, double otherwise) const {
  auto const& channels = run_.course->channels();
  auto const found = std::find_if(channels.begin(), channels.end(), [&](auto const& c) { return c.name == name; });
  return found == channels.end() ? otherwise : inputs_[std::size_t(found - channels.begin())];
}

double Predictor::air_at(double height) const {
  return input("ambient.floor_temperature", 293.15) + height * input("ambient.gradient", 0.0);
}

/// Without offset and drift, which no lag touches.
double Predictor::seen(ChannelReading const& view, thermal::Sample const& sample) const {
  if (view.sensor) {
    double const air = air_at(view.sensor->position.dot(machine_.up));
    if (view.sensor->weights.empty()) return air;
    double const body = weighted(view.sensor->weights, sample.temperatures);
    return body - view.air_share * (body - air);
  }
  double value = weighted(view.displacement->weights, sample.temperatures);
  for (auto const& term : view.displacement->input_terms)
    value += term.coefficient * std::pow(input(term.channel, 0.0), term.power);
  return value + view.per_air * air_at(tool_height);
}

void Predictor::look(thermal::Sample const& sample, Eigen::Index row) {
  run_.course->evaluate(sample.time, inputs_);
  for (std::size_t c = 0; c < views_.size(); ++c) seen_(row, Eigen::Index(c)) = seen(views_[c], sample);
}

Eigen::MatrixXd Predictor::operator()() {
  auto const rows = Eigen::Index(times_.size());
  seen_.resize(rows, Eigen::Index(views_.size()));
  scenarios::Experiment start;
  start.initial_temperature = run_.initial_temperature;
  Eigen::Index row = 0;
  thermal::integrate(machine_.network(), *run_.course, initial_temperatures(machine_, start, *run_.course), times_, {},
                     [&](thermal::Sample const& sample) { look(sample, row++); });
  Eigen::VectorXd const time = Eigen::Map<Eigen::VectorXd const>(times_.data(), rows);
  for (std::size_t c = 0; c < views_.size(); ++c) {
    auto column = seen_.col(Eigen::Index(c));
    auto const& reading = views_[c];
    if (reading.displacement) column.array() -= column[0];
    if (reading.lag > 0.0) {
      FirstOrderLag const lag(time, column, reading.lag);
      column = time.unaryExpr([&](double t) { return lag.at(t); });
    }
    column += reading.drift * time + Eigen::VectorXd::Constant(rows, reading.offset);
  }
  return seen_.bottomRows(run_.time.size());
}

}  // namespace

Eigen::MatrixXd predict(Machine const& machine, MeasuredRun const& run) { return Predictor(machine, run)(); }

}  // namespace thermotwin::twin
