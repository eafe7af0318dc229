#include "twin/diagnosis/prediction.h"

#include <fmt/format.h>

#include "thermal/error.h"
#include "thermal/integrate.h"
#include "twin/diagnosis/channel_reading.h"
#include "twin/instruments/first_order_lag.h"
#include "twin/instruments/sampling.h"

namespace thermotwin::twin {
namespace {

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

  Machine const& machine_;
  MeasuredRun const& run_;
  std::vector<ChannelReading> readings_;
  std::vector<double> times_;  ///< at which it looks: 0, the run's, and between them
  std::vector<double> inputs_, first_inputs_, first_temperatures_;
  Eigen::MatrixXd seen_;  ///< before any lag
};

Predictor::Predictor(Machine const& machine, MeasuredRun const& run)
    : machine_(machine), run_(run), readings_(readings_of(machine, run)), inputs_(run.course->channels().size()) {
  for (std::size_t c = 0; c < readings_.size(); ++c)
    if (!readings_[c].sensor && !readings_[c].displacement)
      throw thermal::InputError(
          fmt::format("the machine '{}' has no channel '{}'", machine.name, run.channels[c].name));
  std::vector<double> samples(run.time.begin(), run.time.end());
  if (samples.front() > 0.0) samples.insert(samples.begin(), 0.0);
  times_ = looks(samples, *run.course);
}

void Predictor::look(thermal::Sample const& sample, Eigen::Index row) {
  run_.course->evaluate(sample.time, inputs_);
  if (row == 0) {
    first_inputs_ = inputs_;
    first_temperatures_.assign(sample.temperatures.begin(), sample.temperatures.end());
  }
  for (std::size_t c = 0; c < readings_.size(); ++c) {
    auto const& reading = readings_[c];
    auto const& weights = reading.sensor ? reading.sensor->weights : reading.displacement->weights;
    double const start = reading.sensor ? 0.0 : weighted(weights, first_temperatures_);
    seen_(row, Eigen::Index(c)) =
        reading.before_lag(weighted(weights, sample.temperatures) - start, inputs_, first_inputs_);
  }
}

Eigen::MatrixXd Predictor::operator()() {
  auto const rows = Eigen::Index(times_.size());
  seen_.resize(rows, Eigen::Index(readings_.size()));
  Eigen::Index row = 0;
  thermal::integrate(machine_.network(), *run_.course, start_of(machine_, run_), times_, {},
                     [&](thermal::Sample const& sample) { look(sample, row++); });
  Eigen::MatrixXd shown(run_.time.size(), seen_.cols());
  Eigen::VectorXd const time = Eigen::Map<Eigen::VectorXd const>(times_.data(), rows);
  for (std::size_t c = 0; c < readings_.size(); ++c) {
    auto const& reading = readings_[c];
    FirstOrderLag const course(time, seen_.col(Eigen::Index(c)), reading.lag);
    shown.col(Eigen::Index(c)) = reading.shown(run_.time.unaryExpr([&](double t) { return course.at(t); }), run_.time);
  }
  return shown;
}

}  // namespace

Eigen::MatrixXd predict(Machine const& machine, MeasuredRun const& run) { return Predictor(machine, run)(); }

}  // namespace thermotwin::twin
