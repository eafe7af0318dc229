#include "output/descriptor.h"

#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <unistd.h>

namespace thermotwin::output {
namespace {

/// For good: another thread may be writing when this one is done.
void take_size_limit_as_error() { [[maybe_unused]] static auto const before = std::signal(SIGXFSZ, SIG_IGN); }

}  // namespace

Descriptor::Descriptor(std::filesystem::path const& path, int flags)
    : number_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}

Descriptor Descriptor::of(int number) { return Descriptor(::fcntl(number, F_DUPFD_CLOEXEC, 0)); }

Descriptor::~Descriptor() {
  if (is_open()) ::close(number_);
}

bool Descriptor::write(std::string_view bytes) const {
  if (!is_open()) return false;
  take_size_limit_as_error();
  while (!bytes.empty()) {
    ssize_t const written = ::write(number_, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

bool Descriptor::synchronise() const { return ::fsync(number_) == 0; }

}  // namespace thermotwin::output
