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
    : path_(std::move(path)), descriptor_(path_, O_RDWR | O_CREAT | O_APPEND) {
  if (!descriptor_.is_open()) fail();
  if (::flock(descriptor_.number(), LOCK_EX | (busy == Busy::refuse ? LOCK_NB : 0)) == 0) return;
  if (errno == EWOULDBLOCK) throw OutputError(fmt::format("'{}' is in use by another process", path_.string()));
  fail();
}

void LockedFile::fail() const {
  throw OutputError(fmt::format("cannot write '{}': {}", path_.string(), std::strerror(errno)));
}

std::string LockedFile::contents() const {
  std::string bytes(static_cast<std::size_t>(::lseek(descriptor_.number(), 0, SEEK_END)), '\0');
  std::size_t read = 0;
  while (read < bytes.size()) {
    ssize_t const got =
        ::pread(descriptor_.number(), bytes.data() + read, bytes.size() - read, static_cast<off_t>(read));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) fail();
    read += static_cast<std::size_t>(got);
  }
  return bytes;
}

void LockedFile::shorten(std::size_t size) {
  if (::ftruncate(descriptor_.number(), static_cast<off_t>(size)) != 0) fail();
}

void LockedFile::append(std::string_view bytes) {
  auto const before = ::lseek(descriptor_.number(), 0, SEEK_END);
  if (descriptor_.write(bytes)) return;
  int const reason = errno;
  bool const cut = ::ftruncate(descriptor_.number(), before) == 0;
  throw OutputError(fmt::format("cannot write '{}': {}{}", path_.string(), std::strerror(reason),
                                cut ? "" : ", and its end is damaged"));
}

void LockedFile::remove() const { ::unlink(path_.c_str()); }

}  // namespace thermotwin::output
