#pragma once

#include <span>
#include <vector>

#include "twin/compensation/saved_model.h"
#include "twin/compensation/twin_observer.h"

namespace thermotwin::twin {

/// A saved model beside its twin, fed with live readings: the twin runs on the machine's inputs alone, and the model
/// adds what it makes of the difference between the changes of the sensors and the twin's.
class ModelBesideTwin {
 public:
  /// InputError for a machine that the twin cannot run live (TwinObserver), or without a sensor of the model on a body.
  ModelBesideTwin(Machine machine, std::string const& displacement, SavedModel model);

  /// The machine's inputs, then the model's sensors; all are required.
  [[nodiscard]] std::vector<ModelInput> const& inputs() const { return inputs_; }
  /// Thermal error [µm] at `time` [s], which never goes back; `values` in the order of the inputs, all finite.
  [[nodiscard]] double error(double time, std::span<double const> values);
  [[nodiscard]] std::map<std::string, std::string> extrapolated() const { return model_.extrapolated(); }

 private:
  TwinObserver twin_;
  SavedModel model_;
  std::vector<ModelInput> inputs_;
};

}  // namespace thermotwin::twin
