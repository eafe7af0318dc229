#include "twin/progress_file.h"

#include <algorithm>
#include <cerrno>
#include <exception>
#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <thread>

#include "output/atomic_file.h"
#include "output/error.h"

namespace thermotwin::twin {
namespace {

namespace fs = std::filesystem;

bool holds_progress_alone(fs::path const& folder) {
  return std::all_of(fs::directory_iterator(folder), {},
                     [](auto const& entry) { return entry.path().filename().string().starts_with("progress.json"); });
}

fs::path made(fs::path const& folder) {
  if (!fs::is_directory(folder)) output::require_empty(folder);
  output::make_directory(folder);
  return folder;
}

/// By another process; if not, it is ours from now on.
bool is_held(output::Descriptor const& folder, int operation) {
  return ::flock(folder.number(), operation | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

}  // namespace

bool ProgressFile::is_running(fs::path const& folder) {
  output::Descriptor const held(folder, O_RDONLY | O_DIRECTORY);
  return held.is_open() && is_held(held, LOCK_SH);
}

ProgressFile::ProgressFile(fs::path const& folder, std::string title)
    : path_(folder / progress_file), folder_(made(folder), O_RDONLY | O_DIRECTORY), title_(std::move(title)) {
  for (int attempt = 0; is_held(folder_, LOCK_EX) && attempt < 5; ++attempt)  // an onlooker holds it for no longer
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  if (is_held(folder_, LOCK_EX))
    throw output::OutputError(fmt::format("another process is filling '{}'; name another folder", folder.string()));
  if (!holds_progress_alone(folder)) output::require_empty(folder);
  output::remove_leftovers(path_);
  write();
}

ProgressFile::~ProgressFile() {
  if (stopped_) return;
  std::error_code unimportant;
  std::filesystem::remove(path_, unimportant);
}

void ProgressFile::show(std::string const& what, std::optional<double> share) {
  auto const now = Clock::now();
  bool const same = !steps_.empty() && steps_.back().what == what;
  if (!same) steps_.push_back({what, std::chrono::duration<double>(now - start_).count(), share});
  steps_.back().share = share;
  if (same && now < next_) return;
  next_ = now + std::chrono::milliseconds(500);
  write();
}

void ProgressFile::stopped() {
  stopped_ = true;
  show("stopped");
}

void ProgressFile::write() const {
  nlohmann::ordered_json json = {{"title", title_}, {"steps", nlohmann::ordered_json::array()}, {"done", stopped_}};
  for (auto const& [what, at_s, share] : steps_) {
    json["steps"].push_back({{"what", what}, {"at_s", at_s}});
    if (share) json["steps"].back()["share"] = *share;
  }
  try {
    auto const text = json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    output::write_atomically(path_, text + "\n");
  } catch (std::exception const&) {  // the work goes on
  }
}

}  // namespace thermotwin::twin
