#pragma once

#include <vector>

#include "twin/diagnosis/amended_file.h"
#include "twin/diagnosis/estimation.h"

namespace thermotwin::twin {

/// What a fit saw of where sensors sit and of what displacements do beyond their loops, as a machine file says it.
class SeenForm {
 public:
  /// `unknowns`: those that count, of these estimates.
  SeenForm(Estimation const& estimation, std::vector<std::size_t> const& unknowns, Eigen::VectorXd const& x);

  void put_into(Value& document) const;
  [[nodiscard]] std::vector<ChangedValue> changes() const;

 private:
  std::vector<PlacedSensor> sensors_;
  std::vector<LoopBeyond> loops_;
};

/// The unknown places and steps that a fit saw: they differ from the file's by more than their standard error. Where
/// loops are open, all steps.
[[nodiscard]] std::vector<std::size_t> seen_of_form(Estimation const& estimation, Fit const& fit);

}  // namespace thermotwin::twin
