#pragma once

#include <chrono>
#include <mutex>
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

/// Tells what a job is at whose length nobody knows: what it begins at once, and how that goes when nothing was told
/// for ten seconds. From any thread.
class Narration {
 public:
  void begin(std::string const& what);
  void go_on(std::string const& how);

 private:
  using Clock = std::chrono::steady_clock;

  std::mutex mutex_;
  Clock::time_point told_ = Clock::now();
};

}  // namespace thermotwin::twin
