#pragma once

#include <Eigen/Core>
#include <deque>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "models/error_model.h"
#include "twin/compensation/model_input.h"
#include "twin/input_range.h"

namespace thermotwin::twin {

/// A saved error model fed with live readings: ΔT is counted from the first ones, at which the machine must be cold.
/// Lags look back into the readings that it was given, each held until the next.
class SavedModel {
 public:
  /// `ranges` of its inputs; empty: nobody knows.
  explicit SavedModel(models::ErrorModel model, std::vector<InputRange> ranges = {});

  [[nodiscard]] std::vector<ModelInput> const& inputs() const { return inputs_; }
  /// Thermal error [µm] at `time` [s], which never goes back; `values` [°C] in the order of the inputs, all finite.
  [[nodiscard]] double error(double time, std::span<double const> values);
  /// Inputs that are beyond their range since error() was last asked, each with a sentence.
  [[nodiscard]] std::map<std::string, std::string> extrapolated() const;

 private:
  struct Past {
    double time;
    Eigen::VectorXd rise;
  };
  void remember(double time, Eigen::VectorXd const& rise);
  [[nodiscard]] Eigen::VectorXd rise_at(double time) const;

  models::ErrorModel model_;
  std::vector<ModelInput> inputs_;
  std::vector<InputRange> ranges_;
  int longest_lag_ = 0;            ///< [samples]
  Eigen::VectorXd zero_, change_;  ///< first readings, and what the last ones differ from them by
  std::deque<Past> past_;          ///< as far back as the longest lag
};

}  // namespace thermotwin::twin
