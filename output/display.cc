#include "output/display.h"

#include <chrono>
#include <cstdlib>
#include <dlfcn.h>
#include <fmt/core.h>
#include <thread>

#include "output/error.h"

namespace thermotwin::output {
namespace {

constexpr int attempts = 11;
constexpr std::chrono::milliseconds between_attempts(50);

constexpr char const* advice = "run under xvfb-run: put xvfb-run -a before the command";

}  // namespace

DisplayConnection::DisplayConnection() {
  char const* const name = std::getenv("DISPLAY");
  if (!name || !*name) throw OutputError(fmt::format("a picture needs a display and DISPLAY is not set; {}", advice));
  library_ = dlopen("libX11.so.6", RTLD_LAZY);
  if (!library_) return;
  auto const open = reinterpret_cast<void* (*)(char const*)>(dlsym(library_, "XOpenDisplay"));
  for (int i = 0; i < attempts && !connection_; ++i) {
    if (i > 0) std::this_thread::sleep_for(between_attempts);
    connection_ = open(nullptr);
  }
  if (connection_) return;
  dlclose(library_);
  throw OutputError(fmt::format("a picture needs a display and '{}' does not answer; {}", name, advice));
}

DisplayConnection::~DisplayConnection() {
  if (!library_) return;
  reinterpret_cast<int (*)(void*)>(dlsym(library_, "XCloseDisplay"))(connection_);
  dlclose(library_);
}

}  // namespace thermotwin::output
