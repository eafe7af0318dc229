#include "twin/fit_error_model.h"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

#include "output/dataset_file.h"
#include "thermal/error.h"
#include "thermal/nearest_name.h"

namespace thermotwin::twin {
namespace {

Eigen::VectorXd change_of(std::vector<output::Channel> const& group, std::string const& name, std::string const& file) {
  std::vector<std::string> known;
  for (auto const& channel : group) {
    if (channel.name == name) return channel.values.array() - channel.values[0];
    known.push_back(channel.name);
  }
  throw thermal::InputError(fmt::format("{} has no '{}'; {}", file, name, thermal::did_you_mean(name, known)));
}

models::Batch batch_of(std::filesystem::path const& file, ErrorModelFit const& fit) {
  auto const data = output::read(file);
  models::Batch batch{file.string(), data.time_s, fit.sensors, {}, {}, {}};
  if (batch.sensors.empty())
    for (auto const& channel : data.readings) batch.sensors.push_back(channel.name);
  batch.components = batch.sensors;
  batch.temperature_rise.resize(data.time_s.size(), Eigen::Index(batch.sensors.size()));
  for (std::size_t j = 0; j < batch.sensors.size(); ++j)
    batch.temperature_rise.col(Eigen::Index(j)) = change_of(data.readings, batch.sensors[j], file.string());
  batch.error = change_of(data.displacements, fit.error, file.string());
  return batch;
}

}  // namespace

models::ErrorModel fit_error_model(ErrorModelFit const& fit) {
  std::vector<models::Batch> batches;
  for (auto const& file : fit.runs) batches.push_back(batch_of(file, fit));
  try {
    return models::model_method(fit.method).fit(batches, {.seed = fit.seed});
  } catch (std::invalid_argument const& error) {
    throw thermal::InputError(error.what());
  }
}

}  // namespace thermotwin::twin
