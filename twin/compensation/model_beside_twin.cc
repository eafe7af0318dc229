#include "twin/compensation/model_beside_twin.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "thermal/error.h"
#include "thermal/nearest_name.h"

namespace thermotwin::twin {

ModelBesideTwin::ModelBesideTwin(Machine machine, std::string const& displacement, SavedModel model)
    : twin_(std::move(machine), displacement), model_(std::move(model)) {
  std::vector<std::string> known;
  for (auto const& input : twin_.inputs())
    if (input.sensor)
      known.push_back(input.name);
    else
      inputs_.push_back(input);
  for (auto const& sensor : model_.inputs()) {
    if (std::find(known.begin(), known.end(), sensor.name) == known.end())
      throw thermal::InputError(fmt::format("the twin has no sensor '{}' on a body; {}", sensor.name,
                                            thermal::did_you_mean(sensor.name, known)));
    inputs_.push_back(sensor);
  }
}

double ModelBesideTwin::error(double time, std::span<double const> values) {
  auto const sensors = model_.inputs().size();
  std::vector<double> given(values.begin(), values.end() - std::ptrdiff_t(sensors));
  given.resize(twin_.inputs().size(), std::nan(""));
  double const said = twin_.error(time, given);
  std::vector<double> missed;
  for (std::size_t j = 0; j < sensors; ++j)
    missed.push_back(values[values.size() - sensors + j] - twin_.change(model_.inputs()[j].name));
  return said + model_.error(time, missed);
}

}  // namespace thermotwin::twin
