#include "output/display.h"

#include <cstdlib>
#include <dlfcn.h>
#include <fmt/core.h>

#include "output/error.h"

namespace thermotwin::output {

void expect_display() {
  constexpr char const* advice = "run under xvfb-run, for example: xvfb-run -a thermotwin run … --picture machine.png";
  char const* const name = std::getenv("DISPLAY");
  if (!name || !*name) throw OutputError(fmt::format("a picture needs a display and DISPLAY is not set; {}", advice));
  void* const library = dlopen("libX11.so.6", RTLD_LAZY);
  if (!library) return;
  auto const open = reinterpret_cast<void* (*)(char const*)>(dlsym(library, "XOpenDisplay"));
  auto const close = reinterpret_cast<int (*)(void*)>(dlsym(library, "XCloseDisplay"));
  void* const display = open(nullptr);
  if (display) close(display);
  dlclose(library);
  if (!display) throw OutputError(fmt::format("a picture needs a display and '{}' does not answer; {}", name, advice));
}

}  // namespace thermotwin::output
