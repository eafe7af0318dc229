#pragma once

#include <deque>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "twin/compensation/axis_shift.h"
#include "twin/compensation/mean_model.h"
#include "twin/compensation/reading.h"
#include "twin/compensation/saved_model.h"
#include "twin/compensation/sensor_watch.h"
#include "twin/compensation/twin_observer.h"

namespace thermotwin::twin {

/// What tells the error from the readings.
using LiveModel = std::variant<SavedModel, TwinObserver, MeanModel>;

struct CompensationSettings {
  ShiftLimits shift;
  WatchSettings watch;  ///< of every sensor
  FadingHold fallback;
};

/// What an offset rests on.
enum class Support {
  waiting,  ///< not every input has been read yet: no offset
  good,     ///< the model and all inputs that it needs
  held,     ///< the last good one: an input has failed
  fading,   ///< on its way to nothing, for the same reason
  off,      ///< there
};

[[nodiscard]] std::string_view name_of(Support support);

struct Decision {
  double time = 0.0;    ///< [s]
  double offset = 0.0;  ///< origin shift that the controller shall have [µm]
  double error = 0.0;   ///< that the model last told [µm]
  Support support = Support::waiting;
  std::map<std::string, SensorFault> faults;  ///< inputs that are not believed, whether the model needs them or not
  std::vector<std::string> refused;           ///< sentences: readings that were not taken, and why
  std::map<std::string, std::string> extrapolated;    ///< inputs beyond what a model was fitted on, and by how much
  bool anew = false;                                  ///< a twin was too long without inputs: errors count from now
  std::optional<TwinObserver::WarmBegin> warm_begin;  ///< of an observer that begins now, on a warm machine
};

/// Decides the origin shift of one axis: offset = −Ê(t), within the limits of AxisShift. It knows no clock and no
/// network.
///
/// While an input that the model needs is not believed, the last good target is held, then faded (FadingHold). A sensor
/// turns out to be stuck only after a while: then the target from before it stood still is the good one.
///
/// A twin goes on with its last inputs for as long as an offset outlives them. When they come back later than that,
/// nobody knows what the machine did meanwhile, and model and twin begin anew as at the first decision.
class Compensator {
 public:
  Compensator(LiveModel model, CompensationSettings const& settings);

  /// `time` [s] never goes back; readings may be as old as they are, but not from later than `time`. A reading of an
  /// unknown name or of another unit, or one not newer than the last, is refused and has no effect. `elapsed` [s] is
  /// what the offset may move in.
  Decision step(double time, std::span<Reading const> readings, double elapsed);

  [[nodiscard]] std::vector<ModelInput> const& inputs() const;
  /// Inputs that have not been read yet.
  [[nodiscard]] std::vector<std::string> unread() const;
  [[nodiscard]] SensorFault fault(std::size_t input, double now) const { return watches_[input].fault(now); }
  [[nodiscard]] double value(std::size_t input) const { return watches_[input].value(); }  ///< the last one believed
  [[nodiscard]] double last_time(std::size_t input) const { return watches_[input].last_time(); }

 private:
  struct Target {
    double time, value;
  };
  void take(Reading const& reading, double time, Decision& decision);
  void find_faults(double time, Decision& decision);
  [[nodiscard]] std::optional<double> failing_since(double time) const;
  [[nodiscard]] double supported_target(double time, Decision& decision);
  [[nodiscard]] double fallen_back(double time, Decision& decision) const;
  [[nodiscard]] bool outlived(double time) const;
  [[nodiscard]] double estimate(double time);
  [[nodiscard]] std::map<std::string, std::string> extrapolated() const;
  [[nodiscard]] std::optional<TwinObserver::WarmBegin> warm_begin() const;
  void fail_since(double since);

  LiveModel model_;
  std::optional<LiveModel> fresh_;  ///< as before the first decision, of one that runs a twin
  std::optional<double> asked_;     ///< when the model was last [s]
  CompensationSettings settings_;
  std::vector<SensorWatch> watches_;
  AxisShift shift_;
  std::deque<Target> good_targets_;  ///< as far back as a sensor can be stuck unseen
  Target held_{0.0, 0.0};
  bool started_ = false, failed_ = false;
  double error_ = 0.0;
};

}  // namespace thermotwin::twin
