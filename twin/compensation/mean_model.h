#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "twin/compensation/saved_model.h"
#include "twin/compensation/twin_observer.h"
#include "twin/saved_error_model.h"

namespace thermotwin::twin {

/// The mean of several saved models, fed with live readings. Those beside a twin, which runs on the machine's inputs
/// alone, add what they make of the difference between the changes of the sensors and the twin's to what it says.
class MeanModel {
 public:
  struct Part {
    std::optional<SavedModel> model;  ///< none: the twin alone
    bool beside_twin = false;
  };
  /// InputError for a twin without a sensor on a body that a model beside it reads. The models have the same inputs.
  MeanModel(std::optional<TwinObserver> twin, std::vector<Part> parts);
  /// Also InputError for a twin's file that has changed, or whose machine cannot run live (TwinObserver).
  explicit MeanModel(SavedErrorModel const& saved);

  /// The twin's inputs of the machine, then the models' sensors; all are required.
  [[nodiscard]] std::vector<ModelInput> const& inputs() const { return inputs_; }
  /// Thermal error [µm] at `time` [s], which never goes back; `values` in the order of the inputs, all finite.
  [[nodiscard]] double error(double time, std::span<double const> values);
  [[nodiscard]] std::map<std::string, std::string> extrapolated() const;
  [[nodiscard]] bool runs_a_twin() const { return twin_.has_value(); }

 private:
  [[nodiscard]] double said(double time, std::span<double const> values);

  std::optional<TwinObserver> twin_;
  std::vector<Part> parts_;
  std::vector<ModelInput> inputs_;
  std::size_t sensors_ = 0;  ///< the last of the inputs
};

}  // namespace thermotwin::twin
