#include "twin/compensation/mean_model.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "thermal/error.h"
#include "thermal/nearest_name.h"

namespace thermotwin::twin {
namespace {

void require_sensors(TwinObserver const& twin, std::vector<ModelInput> const& wanted) {
  std::vector<std::string> known;
  for (auto const& input : twin.inputs())
    if (input.sensor) known.push_back(input.name);
  for (auto const& sensor : wanted)
    if (std::find(known.begin(), known.end(), sensor.name) == known.end())
      throw thermal::InputError(fmt::format("the twin has no sensor '{}' on a body; {}", sensor.name,
                                            thermal::did_you_mean(sensor.name, known)));
}

std::optional<TwinObserver> observer_of(SavedErrorModel const& saved) {
  if (!saved.twin) return std::nullopt;
  return TwinObserver(twin_of(*saved.twin), saved.error);
}

std::vector<MeanModel::Part> live_parts(std::vector<ModelPart> const& saved) {
  std::vector<MeanModel::Part> parts;
  for (auto const& part : saved)
    parts.push_back(
        {part.reads() ? std::optional(SavedModel(part.model, part.ranges)) : std::nullopt, part.beside_twin});
  return parts;
}

}  // namespace

MeanModel::MeanModel(SavedErrorModel const& saved) : MeanModel(observer_of(saved), live_parts(saved.parts)) {}

MeanModel::MeanModel(std::optional<TwinObserver> twin, std::vector<Part> parts)
    : twin_(std::move(twin)), parts_(std::move(parts)) {
  if (twin_)
    std::copy_if(twin_->inputs().begin(), twin_->inputs().end(), std::back_inserter(inputs_),
                 [](auto const& input) { return !input.sensor; });
  auto const machine = inputs_.size();
  for (auto const& part : parts_) {
    if (!part.model) continue;
    if (part.beside_twin) require_sensors(*twin_, part.model->inputs());
    if (inputs_.size() == machine)
      inputs_.insert(inputs_.end(), part.model->inputs().begin(), part.model->inputs().end());
  }
  sensors_ = inputs_.size() - machine;
}

/// By the twin, which is shown no sensor.
double MeanModel::said(double time, std::span<double const> values) {
  std::vector<double> given(values.begin(), values.end() - std::ptrdiff_t(sensors_));
  given.resize(twin_->inputs().size(), std::nan(""));
  return twin_->error(time, given);
}

double MeanModel::error(double time, std::span<double const> values) {
  auto const readings = values.last(sensors_);
  double const of_twin = twin_ ? said(time, values) : 0.0;
  double sum = 0.0;
  for (auto& part : parts_) {
    if (part.beside_twin) sum += of_twin;
    if (!part.model) continue;
    std::vector<double> read(readings.begin(), readings.end());
    for (std::size_t j = 0; j < read.size() && part.beside_twin; ++j)
      read[j] -= twin_->change(part.model->inputs()[j].name);
    sum += part.model->error(time, read);
  }
  return sum / double(parts_.size());
}

std::map<std::string, std::string> MeanModel::extrapolated() const {
  std::map<std::string, std::string> all;
  for (auto const& part : parts_)
    if (part.model) all.merge(part.model->extrapolated());
  return all;
}

}  // namespace thermotwin::twin
