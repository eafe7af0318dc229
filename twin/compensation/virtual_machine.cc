#include "twin/compensation/virtual_machine.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "thermal/error.h"
#include "thermal/nearest_name.h"

namespace thermotwin::twin {
namespace {

Eigen::VectorXd course_of(output::Dataset const& data, std::string const& name) {
  std::vector<std::string> known;
  for (auto const* group : {&data.truth_displacements, &data.displacements})
    for (auto const& channel : *group) {
      if (channel.name == name && channel.unit != "um")
        throw thermal::InputError(
            fmt::format("the run shows '{}' in {}; an offset needs a displacement in um", name, channel.unit));
      if (channel.name == name) return channel.values;
      known.push_back(channel.name);
    }
  throw thermal::InputError(
      fmt::format("the run has no displacement '{}'; {}", name, thermal::did_you_mean(name, known)));
}

std::vector<double> measured(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  return values;
}

double largest(std::vector<double> const& values) {
  double most = 0.0;
  for (double const value : measured(values)) most = std::max(most, std::abs(value));
  return most;
}

double rms(std::vector<double> const& values) {
  auto const known = measured(values);
  double sum = 0.0;
  for (double const value : known) sum += value * value;
  return std::sqrt(sum / double(std::max<std::size_t>(1, known.size())));
}

std::vector<double> residuals(PlayedRun const& run) {
  std::vector<double> sums;
  for (std::size_t i = 0; i < run.time.size(); ++i) sums.push_back(run.error[i] + run.offset[i]);
  return sums;
}

}  // namespace

double PlayedRun::largest_error() const { return largest(error); }
double PlayedRun::largest_residual() const { return largest(residuals(*this)); }
double PlayedRun::rms_error() const { return rms(error); }
double PlayedRun::rms_residual() const { return rms(residuals(*this)); }

std::size_t PlayedRun::unmeasured() const { return error.size() - measured(error).size(); }

double PlayedRun::worst_excess() const {
  double worst = 0.0;
  for (std::size_t i = 0; i < time.size(); ++i)
    worst = std::max(worst, std::abs(error[i] + offset[i]) - std::abs(error[i]));
  return worst;
}

VirtualMachine::VirtualMachine(output::Dataset data, VirtualMachineSettings settings, Topics topics)
    : data_(std::move(data)),
      settings_(std::move(settings)),
      topics_(std::move(topics)),
      error_(course_of(data_, settings_.channel)),
      shift_(settings_.limits),
      last_stamp_(-std::numeric_limits<double>::infinity()) {
  if (data_.time_s.size() == 0) throw thermal::InputError("the run has no rows");
  now_ = told_at_ = time(0);
}

void VirtualMachine::move_on(double time) {
  double const target = wanted_ * settings_.fallback.share(time - told_at_);
  shift_.move_to(target, time - now_);
  now_ = time;
}

VirtualMachine::Messages VirtualMachine::begin(std::size_t row) {
  double const now = time(row);
  move_on(now);
  played_.time.push_back(now);
  played_.error.push_back(error_[Eigen::Index(row)]);
  played_.offset.push_back(shift_.offset());
  Messages messages;
  auto const tell = [&](output::Channel const& channel, bool sensor) {
    double const value = channel.values[Eigen::Index(row)];
    messages.emplace_back(topics_.of({channel.name, channel.unit, sensor, true}),
                          payload_of({channel.name, value, channel.unit, now, std::isfinite(value) ? "good" : "bad"}));
  };
  for (auto const& channel : data_.inputs) tell(channel, false);
  for (auto const& channel : data_.readings) tell(channel, true);
  return messages;
}

void VirtualMachine::take(std::string_view payload) {
  auto const message = read_payload(payload);
  auto const* offset = std::get_if<Reading>(&message);
  bool const usable = offset && offset->name == settings_.axis && offset->unit == "um" &&
                      std::abs(offset->value) <= settings_.limits.largest && offset->time > last_stamp_;
  ++(usable ? played_.accepted : played_.refused);
  if (!usable) return;
  wanted_ = offset->value;
  last_stamp_ = offset->time;
  told_at_ = now_;
}

std::string played_csv(PlayedRun const& run) {
  std::string text = fmt::format("{}\n", played_header);
  for (std::size_t i = 0; i < run.time.size(); ++i)
    text += fmt::format("{},{},{},{}\n", run.time[i], run.error[i], run.offset[i], run.error[i] + run.offset[i]);
  return text;
}

}  // namespace thermotwin::twin
