#include "twin/progress.h"

#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>

namespace thermotwin::twin {
namespace {

constexpr auto between_frames = std::chrono::milliseconds(100);
constexpr auto between_lines = std::chrono::seconds(10);

std::string time_left(double elapsed, double share) {
  if (share < 0.02) return "";
  auto const seconds = long(elapsed * (1.0 - share) / share + 0.5);
  return seconds >= 60 ? fmt::format("{} min {:02} s left", seconds / 60, seconds % 60)
                       : fmt::format("{} s left", seconds);
}

}  // namespace

void tell(std::string const& text) { std::fputs(text.c_str(), stderr); }

Progress::Progress(std::string title) : title_(std::move(title)), terminal_(isatty(STDERR_FILENO) == 1) {
  if (!terminal_) next_ = start_ + between_lines;
}

Progress::~Progress() {
  if (terminal_ && drawn_) tell("\r\033[K");
}

void Progress::show(double share) {
  auto const now = Clock::now();
  if (now < next_) return;
  double const elapsed = std::chrono::duration<double>(now - start_).count();
  if (terminal_) {
    constexpr int width = 40;
    auto const filled = int(share * width);
    tell(fmt::format("\r\033[K{} [{}{}] {:3.0f} %  {}", title_, std::string(std::size_t(filled), '#'),
                     std::string(std::size_t(width - filled), '.'), 100.0 * share, time_left(elapsed, share)));
    drawn_ = true;
    next_ = now + between_frames;
  } else {
    tell(fmt::format("{}: {:.0f} %, {}\n", title_, 100.0 * share, time_left(elapsed, share)));
    next_ = now + between_lines;
  }
}

void Narration::begin(std::string const& what) {
  std::lock_guard const lock(mutex_);
  tell(what + " …\n");
  told_ = Clock::now();
}

void Narration::go_on(std::string const& how) {
  std::lock_guard const lock(mutex_);
  if (Clock::now() - told_ < between_lines) return;
  tell("  … " + how + "\n");
  told_ = Clock::now();
}

}  // namespace thermotwin::twin
