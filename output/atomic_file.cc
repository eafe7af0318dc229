#include "output/atomic_file.h"

#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fcntl.h>
#include <fmt/core.h>
#include <optional>
#include <string>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

#include "output/descriptor.h"
#include "output/error.h"

namespace thermotwin::output {
namespace {

namespace fs = std::filesystem;

constexpr int most_links = 40;  ///< one behind the other, as the system has it

[[noreturn]] void fail(fs::path const& path, std::string const& reason) {
  throw OutputError(fmt::format("cannot write '{}': {}", path.string(), reason));
}

/// Which open file of this process a path means: /dev/stdout is 1. Whatever it was opened as is not to be replaced.
std::optional<int> open_number(fs::path const& path) {
  std::error_code error;
  auto const folder = fs::canonical(path.parent_path(), error);
  if (error || folder != fs::canonical("/proc/self/fd", error)) return std::nullopt;
  std::string const name = path.filename();
  int number = 0;
  bool const numeric = std::from_chars(name.data(), name.data() + name.size(), number).ec == std::errc();
  return numeric ? std::optional(number) : std::nullopt;
}

/// Where symbolic links lead, also to what is not there yet.
fs::path target_of(fs::path const& path) {
  fs::path target = path;
  std::error_code ignored;
  for (int links = 0; fs::is_symlink(target, ignored) && !open_number(target); ++links) {
    if (links == most_links) fail(path, std::strerror(ELOOP));
    target = target.parent_path() / fs::read_symlink(target);
  }
  return target;
}

/// A name that no other writer of this process has, nor one of another process at this time.
fs::path temporary_beside(fs::path const& path) {
  static std::atomic<unsigned> number = 0;
  fs::path temporary = path;
  return temporary += fmt::format(".{}-{}.tmp", ::getpid(), number++);
}

/// Whether it is what temporary_beside makes of a name.
bool is_leftover(std::string_view file, std::string_view of) {
  if (!file.starts_with(of)) return false;
  file.remove_prefix(of.size());
  if (!file.starts_with('.') || !file.ends_with(".tmp")) return false;
  file = file.substr(1, file.size() - 5);
  auto const dash = file.find('-');
  auto const is_number = [](std::string_view text) {
    return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
  };
  return dash != std::string_view::npos && is_number(file.substr(0, dash)) && is_number(file.substr(dash + 1));
}

/// With the permissions of the old file.
void replace(fs::path const& path, std::string_view contents) {
  struct stat old {};
  bool const there = ::stat(path.c_str(), &old) == 0;
  fs::path const temporary = temporary_beside(path);
  Descriptor const file(temporary, O_WRONLY | O_CREAT | O_EXCL);
  if (!file.is_open() && errno == EEXIST) return replace(path, contents);  // somebody's, to be left alone
  if (file.is_open() && there) ::fchmod(file.number(), old.st_mode & 07777);
  if (file.write(contents) && file.synchronise() && ::rename(temporary.c_str(), path.c_str()) == 0) return;
  std::string const reason = std::strerror(errno);
  if (file.is_open()) ::unlink(temporary.c_str());
  fail(path, there ? reason + " (the old file is as it was)" : reason);
}

}  // namespace

void write_atomically(fs::path const& path, std::string_view contents) {
  fs::path const target = target_of(path);
  std::error_code ignored;
  if (fs::is_directory(target, ignored)) fail(path, "it is a directory");
  if (auto const number = open_number(target)) {
    if (!Descriptor::of(*number).write(contents)) fail(path, std::strerror(errno));
    return;
  }
  if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored)) {
    if (!Descriptor(target, O_WRONLY).write(contents)) fail(path, std::strerror(errno));
    return;
  }
  replace(target, contents);
  Descriptor const directory(target.has_parent_path() ? target.parent_path() : fs::path("."), O_RDONLY);
  static_cast<void>(directory.synchronise());  // some file systems cannot: the rename is durable a little later there
}

void remove_leftovers(fs::path const& path) {
  std::error_code ignored;
  std::vector<fs::path> leftovers;
  for (auto const& entry : fs::directory_iterator(path.has_parent_path() ? path.parent_path() : fs::path("."), ignored))
    if (is_leftover(entry.path().filename().string(), path.filename().string())) leftovers.push_back(entry.path());
  for (auto const& leftover : leftovers) fs::remove(leftover, ignored);
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
