#include "twin/compensation/mean_model.h"

#include <algorithm>

namespace thermotwin::twin {
namespace {

/// Where a part stands beside it, on the machine's inputs alone; it has the sensors that a part reads beside it.
std::optional<TwinObserver> twin_beside_parts(SavedErrorModel const& saved, std::optional<Machine> const& machine) {
  bool beside = false, read = false;
  for (auto const& part : saved.parts) {
    beside = beside || (part.beside_twin && !part.observer);
    read = read || (part.beside_twin && !part.observer && part.reads());
  }
  if (!beside) return std::nullopt;
  return TwinObserver(machine.value(), saved.error, {}, read ? saved.inputs() : std::vector<std::string>());
}

std::vector<MeanModel::Part> live_parts(SavedErrorModel const& saved, std::optional<Machine> const& machine) {
  std::vector<MeanModel::Part> parts;
  for (auto const& part : saved.parts)
    if (part.observer)
      parts.push_back({std::nullopt, false, observer_of(saved, machine.value())});
    else
      parts.push_back(
          {part.reads() ? std::optional(SavedModel(part.model, part.ranges)) : std::nullopt, part.beside_twin});
  return parts;
}

}  // namespace

MeanModel::MeanModel(SavedErrorModel const& saved)
    : MeanModel(saved, saved.twin ? std::optional(twin_of(*saved.twin)) : std::nullopt) {}

MeanModel::MeanModel(SavedErrorModel const& saved, std::optional<Machine> const& machine)
    : MeanModel(twin_beside_parts(saved, machine), live_parts(saved, machine)) {}

MeanModel::MeanModel(std::optional<TwinObserver> twin, std::vector<Part> parts)
    : twin_(std::move(twin)), parts_(std::move(parts)) {
  auto const observer =
      std::find_if(parts_.begin(), parts_.end(), [](auto const& part) { return part.observer.has_value(); });
  if (observer != parts_.end())
    inputs_ = observer->observer->inputs();
  else if (twin_)
    std::copy_if(twin_->inputs().begin(), twin_->inputs().end(), std::back_inserter(inputs_),
                 [](auto const& input) { return !input.sensor; });
  auto const model =
      std::find_if(parts_.begin(), parts_.end(), [](auto const& part) { return part.model.has_value(); });
  if (model != parts_.end()) {
    std::erase_if(inputs_, [](auto const& input) { return input.sensor; });
    inputs_.insert(inputs_.end(), model->model->inputs().begin(), model->model->inputs().end());
  }
  sensors_ = std::size_t(std::count_if(inputs_.begin(), inputs_.end(), [](auto const& input) { return input.sensor; }));
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
    if (part.observer) sum += part.observer->error(time, values);
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

std::optional<TwinObserver::WarmBegin> MeanModel::warm_begin() const {
  for (auto const& part : parts_)
    if (part.observer) return part.observer->warm_begin();
  return {};
}

bool MeanModel::runs_a_twin() const {
  return twin_ || std::any_of(parts_.begin(), parts_.end(), [](auto const& part) { return part.observer.has_value(); });
}

}  // namespace thermotwin::twin
