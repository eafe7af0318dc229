#include "twin/compensation/observed_run.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <utility>

#include "thermal/error.h"
#include "thermal/integrate.h"
#include "thermal/nearest_name.h"
#include "thermal/units.h"
#include "twin/diagnosis/warm_start.h"
#include "twin/study/study_runs.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;

constexpr double reading_noise = 0.1;  ///< [K]
constexpr double longest_step = 30.0;  ///< [s]
constexpr double same_time = 1e-6;     ///< [s]

[[noreturn]] void refuse_without(std::string const& input, thermal::Course const& course) {
  std::vector<std::string> known;
  for (auto const& channel : course.channels()) known.push_back(channel.name);
  throw thermal::InputError(fmt::format("it needs the input '{}', which a run does not give; {}", input,
                                        thermal::did_you_mean(input, known)));
}

/// A run as an observer is told of it.
class ToldRun {
 public:
  ToldRun(std::vector<ModelInput> const& inputs, output::Dataset const& shown, thermal::Course const& course,
          double start);
  /// In the order of the inputs, at a time of the rows [s].
  [[nodiscard]] std::vector<double> between_rows(double time) const;
  [[nodiscard]] std::vector<double> at_row(Index row) const;

 private:
  std::vector<ModelInput> const& inputs_;
  output::Dataset const& shown_;
  thermal::Course const& course_;
  double start_;
  std::vector<std::size_t> channels_;               ///< of the course, per input of the machine
  std::vector<output::Channel const*> readings_{};  ///< per sensor; null: the run lacks it
};

ToldRun::ToldRun(std::vector<ModelInput> const& inputs, output::Dataset const& shown, thermal::Course const& course,
                 double start)
    : inputs_(inputs), shown_(shown), course_(course), start_(start) {
  for (auto const& input : inputs)
    if (input.sensor)
      readings_.push_back(find_channel(shown.readings, input.name));
    else if (int const channel = course.index_of(input.name); channel >= 0)
      channels_.push_back(std::size_t(channel));
    else
      refuse_without(input.name, course);
}

std::vector<double> ToldRun::between_rows(double time) const {
  std::vector<double> given(course_.channels().size());
  course_.evaluate(start_ + time, given);
  std::vector<double> told(inputs_.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    double const value = given[channels_[i]];
    if (std::isnan(value)) refuse_without(inputs_[i].name, course_);
    told[i] = inputs_[i].unit == "1" ? value : thermal::to_unit(value, inputs_[i].unit);
  }
  return told;
}

std::vector<double> ToldRun::at_row(Index row) const {
  auto told = between_rows(shown_.time_s[row]);
  for (std::size_t j = 0; j < readings_.size(); ++j)
    if (readings_[j]) told[channels_.size() + j] = readings_[j]->values[row];
  return told;
}

/// How warm each node is after a run's past [K].
std::vector<double> lived_through(Machine const& machine, MeasuredRun const& run, double until) {
  auto temperatures = start_of(machine, run);
  if (until > 0.0)
    thermal::integrate(machine.network(), *run.course, temperatures, std::vector<double>{0.0, until}, {},
                       [&](thermal::Sample const& sample) {
                         temperatures.assign(sample.temperatures.begin(),
                                             sample.temperatures.begin() + machine.network().nodes());
                       });
  return temperatures;
}

}  // namespace

std::vector<ObserverOptions> observer_choices(double interval) {
  std::vector<ObserverOptions> choices;
  for (double const heat_noise : {1e-4, 5e-4, 2.5e-3})
    choices.push_back({.heat_noise = heat_noise,
                       .sensor_noise = reading_noise * std::sqrt(std::min(longest_step, interval)),
                       .longest_step = longest_step});
  return choices;
}

std::string text_of(ObserverOptions const& options) {
  return fmt::format("extended Kalman filter, nodes err by {:g} K in a second", options.heat_noise);
}

Eigen::VectorXd observed_error(TwinObserver observer, output::Dataset const& shown, thermal::Course const& course,
                               double start) {
  ToldRun const run(observer.inputs(), shown, course, start);
  double const step = observer.options().longest_step;
  Eigen::VectorXd error(shown.time_s.size());
  for (Index row = 0; row < error.size(); ++row) {
    if (row > 0)
      for (double time = shown.time_s[row - 1] + step; time < shown.time_s[row] - same_time; time += step)
        static_cast<void>(observer.error(time, run.between_rows(time)));
    error[row] = observer.error(shown.time_s[row], run.at_row(row));
  }
  return error;
}

Eigen::VectorXd observed_error(TwinObserver observer, MeasuredRun const& run, std::optional<double> sampling) {
  auto const shown = dataset_of(run, std::nullopt);
  double const start = run.time[first_reading(run)];
  if (start > 0.0 || run.initial_temperature) observer.begin_at(lived_through(observer.machine(), run, start));
  auto const error = observed_error(std::move(observer), shown, *run.course, start);
  if (!sampling) return error;
  output::Dataset said;
  said.time_s = shown.time_s;
  said.displacements = {{"said", "um", "", error}};
  return averaged(said, *sampling).displacements.front().values;
}

std::string observer_remark(MeasuredRun const& run) {
  return run.warm_start
             ? "it begins warm: an observer of fewer than four sensors is not told how warm, and begins with the "
               "room"
             : std::string();
}

}  // namespace thermotwin::twin
