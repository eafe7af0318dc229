#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "twin/diagnosis/binned_run.h"
#include "twin/diagnosis/changed_zero.h"
#include "twin/diagnosis/loop_gaps.h"
#include "twin/diagnosis/lump_interiors.h"
#include "twin/diagnosis/sensor_places.h"
#include "twin/diagnosis/unknown.h"

namespace thermotwin::twin {

/// Unknowns that are small, so that their response about the machine of the file serves throughout: offsets of sensors
/// and zeros of displacements, how warm the machine starts, the air, when the inputs changed, how far loggers' clocks
/// are behind, what lumps hide, where exactly sensors sit, and what the structural loop leaves out. And what was given
/// in gaps, of which a share is estimated: in proportion to its heat, of which only what is stored is seen.
class LinearUnknowns {
 public:
  /// `drawn`: the machine's structural loop is known (has_drawings).
  LinearUnknowns(Value const& document, std::vector<BinnedRun> const& data, std::vector<std::string> const& channels,
                 bool drawn, std::vector<ChangedZero> const& zeros = {});

  /// The same, and more zeros that changed, after all others.
  [[nodiscard]] LinearUnknowns with(std::vector<ChangedZero> const& zeros, std::vector<BinnedRun> const& data) const;

  [[nodiscard]] std::vector<Unknown> const& all() const { return unknowns_; }
  /// What the channels show more of each: (run; channel · rows + row) × unknown.
  [[nodiscard]] Eigen::MatrixXd const& columns() const { return columns_; }
  [[nodiscard]] std::vector<SensorPlace> const& places() const { return places_; }
  [[nodiscard]] std::vector<LoopGap> const& gaps() const { return gaps_; }
  [[nodiscard]] std::vector<ChangedZero> const& zeros() const { return zeros_; }

 private:
  void add_of_channels(std::vector<BinnedRun> const& data, std::vector<std::string> const& channels);
  void add_of_run(BinnedRun const& data, int run, bool drawn);
  void add_of_machine();
  void add(std::vector<ChangedZero> const& zeros, std::vector<BinnedRun> const& data);
  [[nodiscard]] Eigen::MatrixXd columns_of(BinnedRun const& data, int run,
                                           std::vector<std::string> const& channels) const;

  Machine machine_;
  LumpInteriors interiors_;
  std::vector<SensorPlace> places_;
  std::vector<LoopGap> gaps_;
  std::vector<ChangedZero> zeros_;
  std::vector<Unknown> unknowns_;
  Eigen::MatrixXd columns_;
};

}  // namespace thermotwin::twin
