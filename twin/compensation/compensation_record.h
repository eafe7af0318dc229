#pragma once

#include <filesystem>
#include <string>

#include "output/dataset_file.h"
#include "twin/compensation/compensator.h"

namespace thermotwin::twin {

/// What a live compensation saw and decided, as a data set that grows: `thermotwin view` shows it while it goes on.
///
/// A row per decision; time counts from the first one. Readings are those believed, missing while a sensor is at fault.
/// Displacements: `error` that the model tells and `offset` that the controller shall have [µm]; inputs: those of the
/// machine and `support` (0 waiting, 1 good, 2 held, 3 fading, 4 off).
class CompensationRecord {
 public:
  CompensationRecord(std::filesystem::path const& path, std::vector<ModelInput> const& inputs, std::string const& axis);

  void add(Decision const& decision, Compensator const& compensator);

  /// The partial file becomes the data set, if anything was decided.
  void finish();

 private:
  output::DatasetWriter writer_;
  double first_ = 0.0, last_ = 0.0;
  long rows_ = 0;
};

}  // namespace thermotwin::twin
