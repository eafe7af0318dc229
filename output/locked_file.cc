#include "output/locked_file.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <unistd.h>
#include <utility>

#include "output/error.h"

namespace thermotwin::output {

LockedFile::LockedFile(std::filesystem::path path, Busy busy)
    : path_(std::move(path)), descriptor_(::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) fail();
  if (::flock(descriptor_, LOCK_EX | (busy == Busy::refuse ? LOCK_NB : 0)) == 0) return;
  bool const used = errno == EWOULDBLOCK;
  ::close(std::exchange(descriptor_, -1));
  if (used) throw OutputError(fmt::format("'{}' is in use by another process", path_.string()));
  fail();
}

LockedFile::~LockedFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void LockedFile::fail() const {
  throw OutputError(fmt::format("cannot write '{}': {}", path_.string(), std::strerror(errno)));
}

std::string LockedFile::contents() const {
  std::string bytes(static_cast<std::size_t>(::lseek(descriptor_, 0, SEEK_END)), '\0');
  std::size_t read = 0;
  while (read < bytes.size()) {
    ssize_t const got = ::pread(descriptor_, bytes.data() + read, bytes.size() - read, static_cast<off_t>(read));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) fail();
    read += static_cast<std::size_t>(got);
  }
  return bytes;
}

void LockedFile::shorten(std::size_t size) {
  if (::ftruncate(descriptor_, static_cast<off_t>(size)) != 0) fail();
}

void LockedFile::append(std::string_view bytes) {
  while (!bytes.empty()) {
    ssize_t const written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) fail();
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void LockedFile::remove() const { ::unlink(path_.c_str()); }

}  // namespace thermotwin::output
