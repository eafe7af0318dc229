#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "twin/compensation/compensator.h"
#include "twin/compensation/model_clock.h"

namespace thermotwin::twin {

/// Where messages go: PREFIX/sensor/T2, PREFIX/input/spindle.speed, PREFIX/offset/X, PREFIX/report/X,
/// PREFIX/status/WHO.
struct Topics {
  std::string prefix = "thermotwin";

  [[nodiscard]] std::string of(ModelInput const& input) const {
    return prefix + (input.sensor ? "/sensor/" : "/input/") + input.name;
  }
  [[nodiscard]] std::string offset(std::string const& axis) const { return prefix + "/offset/" + axis; }
  [[nodiscard]] std::string report(std::string const& axis) const { return prefix + "/report/" + axis; }
  [[nodiscard]] std::string status(std::string const& who) const { return prefix + "/status/" + who; }
};

struct LoopSettings {
  double cycle = 10.0;       ///< between two decisions, on the senders' clock [s]
  double speed = 1.0;        ///< of the senders' clock
  double tolerance = 30.0;   ///< by which senders' clocks may differ and one of them be late [s]
  double start_time = 30.0;  ///< within which every input must have been read, on our clock [s]
};

/// From messages to decisions: everything but the broker. Whatever topic and payload, it throws nothing, and the offset
/// obeys the limits of AxisShift with the time that passes on our own clock.
///
/// A decision is made as soon as every input that is not at fault has been read for this cycle, at the time of the
/// newest reading, however late that comes; when an input is missing, `tolerance` after the end of the next cycle; when
/// none comes, half a second of ours after the end of the next one: a process may be late, and that is no silence.
class CompensationLoop {
 public:
  CompensationLoop(Compensator compensator, LoopSettings const& settings, Topics const& topics = {});

  /// What to subscribe to.
  [[nodiscard]] std::vector<std::string> topics() const;

  /// A message came at `wall` [s, steady].
  std::optional<Decision> take(std::string const& topic, std::string_view payload, double wall);
  /// Nothing waits to be read.
  std::optional<Decision> idle(double wall);

  /// Messages that were not taken, by the reason; at most a hundred reasons, the others count as "others".
  [[nodiscard]] std::map<std::string, long> const& refusals() const { return refusals_; }
  [[nodiscard]] long messages() const { return messages_; }
  [[nodiscard]] Compensator const& compensator() const { return compensator_; }

  /// InputError that names the inputs which did not come in time.
  void require_inputs(double waited) const;

 private:
  /// A reading that leads the senders' time, as far as that is known.
  struct Early {
    std::size_t input;
    double lead;
    Reading reading;
  };
  void refuse(std::string const& reason);
  void keep(std::string const& topic, std::string_view payload, double wall);
  void admit(Early& message, double wall);
  [[nodiscard]] std::optional<double> complete_until(double now) const;
  [[nodiscard]] std::vector<std::string> unread() const;
  Decision decide(double now, double done, double wall);

  Compensator compensator_;
  LoopSettings settings_;
  ModelClock clock_;
  std::map<std::string, std::size_t> input_of_;  ///< by topic
  std::vector<Early> early_;
  std::vector<Reading> pending_;  ///< for the next decision
  std::vector<double> read_;      ///< per input: time of its newest reading
  double newest_, decided_;       ///< time of the newest reading of all; of the last decision
  double decided_wall_, due_;
  std::map<std::string, long> refusals_;
  long messages_ = 0;
};

}  // namespace thermotwin::twin
