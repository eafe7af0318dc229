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
/// alone, add what they make of the difference between the changes of the sensors and the twin's to what it says. One
/// may be a twin that the sensors correct.
class MeanModel {
 public:
  struct Part {
    std::optional<SavedModel> model;  ///< none: the twin alone
    bool beside_twin = false;
    std::optional<TwinObserver> observer{};  ///< neither of the above
  };
  /// Models and observer have the same sensors in the same order; the twin has those of models beside it.
  MeanModel(std::optional<TwinObserver> twin, std::vector<Part> parts);
  /// InputError for a twin's file that has changed, whose machine cannot run live, or that lacks a sensor on a body
  /// (TwinObserver).
  explicit MeanModel(SavedErrorModel const& saved);

  /// The twin's inputs of the machine, required, then the sensors, required unless only an observer reads them.
  [[nodiscard]] std::vector<ModelInput> const& inputs() const { return inputs_; }
  /// Thermal error [µm] at `time` [s], which never goes back; `values` in the order of the inputs, NaN for a sensor
  /// that is not required and not believed.
  [[nodiscard]] double error(double time, std::span<double const> values);
  [[nodiscard]] std::map<std::string, std::string> extrapolated() const;
  [[nodiscard]] bool runs_a_twin() const;
  /// Of an observer among its parts.
  [[nodiscard]] std::optional<TwinObserver::WarmBegin> warm_begin() const;

 private:
  MeanModel(SavedErrorModel const& saved, std::optional<Machine> const& machine);
  [[nodiscard]] double said(double time, std::span<double const> values);

  std::optional<TwinObserver> twin_;
  std::vector<Part> parts_;
  std::vector<ModelInput> inputs_;
  std::size_t sensors_ = 0;  ///< the last of the inputs
};

}  // namespace thermotwin::twin
