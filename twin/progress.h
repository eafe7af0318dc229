#pragma once

#include <chrono>
#include <string>

namespace thermotwin::twin {

/// Says something to people on standard error. Where it cannot be written, the work goes on.
void tell(std::string const& text);

/// Tells how far a long job is: a bar with the time left on a terminal, else a line now and then.
class Progress {
 public:
  explicit Progress(std::string title);
  ~Progress();
  Progress(Progress const&) = delete;
  Progress& operator=(Progress const&) = delete;

  void show(double share);

 private:
  using Clock = std::chrono::steady_clock;

  std::string title_;
  bool terminal_;
  bool drawn_ = false;
  Clock::time_point start_ = Clock::now(), next_ = start_;
};

}  // namespace thermotwin::twin
