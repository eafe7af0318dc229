#include "output/atomic_file.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fmt/core.h>
#include <string>
#include <unistd.h>
#include <vector>

#include "output/error.h"

namespace thermotwin::output {
namespace {

namespace fs = std::filesystem;

/// A file beyond RLIMIT_FSIZE raises SIGXFSZ, which kills; while this lives, write() reports EFBIG instead.
class SizeLimitAsError {
 public:
  SizeLimitAsError() {
    struct sigaction ignore {};
    ignore.sa_handler = SIG_IGN;
    sigaction(SIGXFSZ, &ignore, &before_);
  }
  ~SizeLimitAsError() { sigaction(SIGXFSZ, &before_, nullptr); }
  SizeLimitAsError(SizeLimitAsError const&) = delete;
  SizeLimitAsError& operator=(SizeLimitAsError const&) = delete;

 private:
  struct sigaction before_ {};
};

class Descriptor {
 public:
  Descriptor(fs::path const& path, int flags) : fd_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(Descriptor const&) = delete;
  Descriptor& operator=(Descriptor const&) = delete;

  [[nodiscard]] bool is_open() const { return fd_ >= 0; }
  [[nodiscard]] bool write(std::string_view bytes) const {
    if (fd_ < 0) return false;
    SizeLimitAsError const guard;
    while (!bytes.empty()) {
      ssize_t const written = ::write(fd_, bytes.data(), bytes.size());
      if (written < 0 && errno != EINTR) return false;
      if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
  }
  [[nodiscard]] bool synchronise() const { return ::fsync(fd_) == 0; }

 private:
  int fd_;
};

[[noreturn]] void fail(fs::path const& path, std::string const& reason) {
  std::error_code ignored;
  bool const old = fs::is_regular_file(path, ignored);
  throw OutputError(
      fmt::format("cannot write '{}': {}{}", path.string(), reason, old ? " (the old file is as it was)" : ""));
}

/// A name that no other writer of this process has, nor one of another process at this time.
fs::path temporary_beside(fs::path const& path) {
  static std::atomic<unsigned> number = 0;
  fs::path temporary = path;
  return temporary += fmt::format(".{}-{}.tmp", ::getpid(), number++);
}

void replace(fs::path const& path, std::string_view contents) {
  fs::path const temporary = temporary_beside(path);
  Descriptor const file(temporary, O_WRONLY | O_CREAT | O_EXCL);
  if (!file.is_open() && errno == EEXIST) return replace(path, contents);  // somebody's, to be left alone
  if (file.write(contents) && file.synchronise() && ::rename(temporary.c_str(), path.c_str()) == 0) return;
  std::string const reason = std::strerror(errno);
  if (file.is_open()) ::unlink(temporary.c_str());
  fail(path, reason);
}

}  // namespace

void write_atomically(fs::path const& path, std::string_view contents) {
  std::error_code ignored;
  fs::path const target = fs::exists(path, ignored) ? fs::canonical(path) : path;
  if (fs::is_directory(target, ignored)) fail(path, "it is a directory");
  if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored)) {
    if (!Descriptor(target, O_WRONLY).write(contents)) fail(path, std::strerror(errno));
    return;
  }
  replace(target, contents);
  Descriptor const directory(target.has_parent_path() ? target.parent_path() : fs::path("."), O_RDONLY);
  static_cast<void>(directory.synchronise());  // some file systems cannot: the rename is durable a little later there
}

void remove_leftovers(fs::path const& path) {
  std::string const begin = path.filename().string() + '.';
  std::vector<fs::path> leftovers;
  for (auto const& entry : fs::directory_iterator(path.has_parent_path() ? path.parent_path() : fs::path(".")))
    if (auto const name = entry.path().filename().string(); name.starts_with(begin) && name.ends_with(".tmp"))
      leftovers.push_back(entry.path());
  for (auto const& leftover : leftovers) fs::remove(leftover);
}

void make_directory(fs::path const& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) throw OutputError(fmt::format("cannot make directory '{}': {}", directory.string(), error.message()));
}

void require_empty(fs::path const& directory) {
  if (fs::exists(directory) && (!fs::is_directory(directory) || !fs::is_empty(directory)))
    throw OutputError(
        fmt::format("'{}' is not empty; what is there is not overwritten, name another folder", directory.string()));
}

}  // namespace thermotwin::output
