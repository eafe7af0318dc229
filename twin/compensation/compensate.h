#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "twin/compensation/broker.h"
#include "twin/compensation/compensation_loop.h"

namespace thermotwin::twin {

/// How long decisions take, in classes a twentieth apart from 1 µs to 100 s.
class LatencyCount {
 public:
  void add(double seconds);
  /// The latency that a share of all did not exceed, to 5 % [s]; 0 without any.
  [[nodiscard]] double quantile(double share) const;
  [[nodiscard]] long count() const { return count_; }

 private:
  static constexpr int classes = 380;
  std::vector<long> counts_ = std::vector<long>(classes);
  long count_ = 0;
};

struct CompensateOptions {
  BrokerOptions broker;
  Topics topics;
  std::string axis = "X";
  std::string channel = "E_X";  ///< displacement that the offset works against
  LoopSettings loop;
  std::function<void(std::string const&)> say;                      ///< what happens, one line each
  std::function<void(Decision const&, Compensator const&)> record;  ///< every decision, after it was published
};

struct CompensationSummary {
  long messages = 0, decisions = 0, unsent = 0;
  int reconnections = 0;
  std::map<std::string, long> refusals;
  LatencyCount latency;  ///< from the arrival of the last message of a cycle to the offset handed to the client
};

/// Compensates one axis over a broker until `stop`: subscribes, decides, publishes every decision as an offset and
/// every change of support or faults as a report. InputError when the broker cannot be reached at the start, or when
/// not all inputs come within the start time from the first one.
[[nodiscard]] CompensationSummary compensate(Compensator compensator, CompensateOptions options,
                                             std::atomic<bool> const& stop);

[[nodiscard]] std::string summary_text(CompensationSummary const& summary);

}  // namespace thermotwin::twin
