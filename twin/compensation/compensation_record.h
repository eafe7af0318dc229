#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>

#include "output/dataset_file.h"
#include "twin/compensation/compensator.h"

namespace thermotwin::twin {

/// What a live compensation saw and decided, as a data set that grows: `thermotwin view` shows it while it goes on.
///
/// A row per decision, from the first one on for which every input had been read; time counts from that. Where it does
/// not come to one, no file is left. Readings are those believed, missing while a sensor is at fault. Displacements:
/// `error` that the model tells and `offset` that the controller shall have [µm]; inputs: those of the machine and
/// `support` (1 good, 2 held, 3 fading, 4 off).
///
/// A record that cannot be written is no reason to stop compensating: it says so once and ends there.
class CompensationRecord {
 public:
  /// `say` gets a line for people. InputError when a record or a partial one is there already: what was measured cannot
  /// be made again. OutputError when nothing can be written there.
  CompensationRecord(std::filesystem::path const& path, std::vector<ModelInput> const& inputs, std::string const& axis,
                     std::function<void(std::string const&)> say,
                     std::chrono::duration<double> between_checkpoints = std::chrono::seconds(5));

  void add(Decision const& decision, Compensator const& compensator);

  /// The partial file becomes the data set, if anything was decided and all of it could be written. OutputError when
  /// that fails only now.
  void finish();

 private:
  [[nodiscard]] output::Row row_of(Decision const& decision, Compensator const& compensator) const;

  output::DatasetWriter writer_;
  std::function<void(std::string const&)> say_;
  double first_ = 0.0, last_ = 0.0;
  long rows_ = 0;
  bool failed_ = false;
};

}  // namespace thermotwin::twin
