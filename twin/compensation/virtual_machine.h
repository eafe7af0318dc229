#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "output/dataset.h"
#include "twin/compensation/axis_shift.h"
#include "twin/compensation/compensation_loop.h"

namespace thermotwin::twin {

struct VirtualMachineSettings {
  std::string channel = "E_X";            ///< displacement that the offset works against
  std::string axis = "X";                 ///< topic of the offset
  ShiftLimits limits{1e-3, 0, 5.0, 100};  ///< that the controller lets no offset exceed
  FadingHold fallback;                    ///< when offsets stop coming
};

/// What a compensated run was like, one row per sample of the recorded one [µm]. Rows without an error count in none of
/// the figures.
struct PlayedRun {
  std::vector<double> time, error, offset;
  long accepted = 0, refused = 0;  ///< offsets

  [[nodiscard]] std::size_t unmeasured() const;  ///< rows whose error is missing
  [[nodiscard]] double largest_error() const;
  [[nodiscard]] double largest_residual() const;  ///< of error + offset
  [[nodiscard]] double rms_error() const;
  [[nodiscard]] double rms_residual() const;
  /// By how much the compensated error exceeded the other one at the worst instant; 0: never.
  [[nodiscard]] double worst_excess() const;
};

/// A recorded run that answers: it tells its readings and inputs row by row, and applies the offsets that it is told,
/// as a controller should: only numbers in µm, not larger than its limit, no faster than its slew, and none for ever.
class VirtualMachine {
 public:
  /// InputError for a displacement that the data set does not have, or has in another unit.
  VirtualMachine(output::Dataset data, VirtualMachineSettings settings, Topics topics = {});

  [[nodiscard]] std::size_t rows() const { return std::size_t(data_.time_s.size()); }
  [[nodiscard]] double time(std::size_t row) const { return data_.time_s[Eigen::Index(row)]; }

  using Messages = std::vector<std::pair<std::string, std::string>>;  ///< topic, payload
  /// The row begins: its error is recorded with the offset in force; then its readings are told.
  [[nodiscard]] Messages begin(std::size_t row);
  /// An offset came.
  void take(std::string_view payload);

  [[nodiscard]] PlayedRun const& played() const { return played_; }
  [[nodiscard]] VirtualMachineSettings const& settings() const { return settings_; }

 private:
  void move_on(double time);

  output::Dataset data_;
  VirtualMachineSettings settings_;
  Topics topics_;
  Eigen::VectorXd error_;  ///< [µm]
  AxisShift shift_;
  double wanted_ = 0.0, told_at_ = 0.0, now_ = 0.0, last_stamp_;
  PlayedRun played_;
};

constexpr std::string_view played_header = "time_s,error_um,offset_um,compensated_um";

/// A table of these columns.
[[nodiscard]] std::string played_csv(PlayedRun const& run);

}  // namespace thermotwin::twin
