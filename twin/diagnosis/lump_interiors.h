#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "thermal/evaluation.h"
#include "twin/diagnosis/binned_run.h"
#include "twin/machine.h"

namespace thermotwin::twin {

/// A lump has one temperature; a casting of its size and material has not. What meets it sees a part near by, which
/// answers early, and the rest follows: like a slab of thickness L that is heated through one face, whose surface
/// leaves its mean by q L/(3kA) with the time L²/(π² α) (Carslaw & Jaeger, Conduction of Heat in Solids, 2nd ed. 1959,
/// 3.8). Two nodes do the same, the lump and an interior of C_i, taken from its own C, behind G_i:
///
///   C_i = s C,   G_i = C_i (1 − s)/τ,   s/(1 − s) = π²/3,   τ = L²/(π² α),   L = V^(1/3).
///
/// How much of that a lump has, no file says; nor whether the tool, and each sensor on it, follow the lump or the mean
/// of lump and interior. These are unknowns of an estimation, linear about the machine of the file: 0 is the lump, 1
/// the slab, or the mean. For lumps that are drawn and have a material.
class LumpInteriors {
 public:
  explicit LumpInteriors(Value const& document);

  struct Unknown {
    enum class Kind { heat, growth, reading };
    Kind kind;
    std::string name;  ///< "inside of head", "growth of head", "T7 within head"
    std::size_t interior;
    std::string sensor;  ///< of a reading
  };
  [[nodiscard]] std::vector<Unknown> const& unknowns() const { return unknowns_; }
  /// What the channels of a run show more of each unknown, (channel · rows + row) × unknown.
  [[nodiscard]] Eigen::MatrixXd responses(BinnedRun const& run) const;

 private:
  struct Interior {
    std::string lump;
    double heat_capacity = 0.0;       ///< C_i [J/K]
    double conductance = 0.0;         ///< G_i [W/K]
    int node = 0, interior_node = 0;  ///< of the machine with interiors
  };
  static std::vector<Interior> interiors_of(Value const& document);
  [[nodiscard]] Machine machine_with(Value document, std::vector<double> const& amounts) const;
  void add_unknowns(std::size_t interior);
  [[nodiscard]] Machine seeing_means(Unknown const& unknown) const;

  std::vector<Interior> interiors_;
  Machine machine_;                                      ///< with next to nothing of each interior
  std::vector<thermal::NetworkDerivative> derivatives_;  ///< per interior, for the whole of it
  std::vector<Unknown> unknowns_;
};

}  // namespace thermotwin::twin
