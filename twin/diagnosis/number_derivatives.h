#pragma once

#include <vector>

#include "twin/diagnosis/uncertain_number.h"
#include "twin/sensitivity.h"

namespace thermotwin::twin {

/// Whether any of it is not zero.
[[nodiscard]] bool changes_heat(thermal::NetworkDerivative const& derivative);

/// How a machine answers its uncertain numbers, found at the file's values once and for all fits. Most coefficients
/// follow a number in proportion, so that the derivative by its value is the same everywhere; those of joints in series
/// do not, and are differentiated where a fit is.
class NumberDerivatives {
 public:
  NumberDerivatives(Value document, std::vector<UncertainNumber> numbers);

  /// ∂network/∂x of a number at x; `at`: the document with all estimates. Nothing for one that changes what the network
  /// consists of, or when a relay switches.
  [[nodiscard]] thermal::NetworkDerivative network(std::size_t number, Value const& at, double x) const;
  /// ∂(weights)/∂value per displacement; empty where the number moves none.
  [[nodiscard]] std::vector<NodeWeights> const& displacements(std::size_t number) const {
    return derivatives_[number].displacements;
  }
  /// It acts on instruments, or on what a channel shows besides: neither on heat nor on what castings grow.
  [[nodiscard]] bool is_read_directly(std::size_t number) const;

 private:
  [[nodiscard]] bool bends(Value document, std::size_t number) const;

  std::vector<UncertainNumber> numbers_;
  std::vector<MachineDerivative> derivatives_;  ///< by values
  std::vector<char> is_bent_;                   ///< the network does not follow the number in proportion
};

}  // namespace thermotwin::twin
