#include "twin/progress_file.h"

#include <nlohmann/json.hpp>

#include "output/atomic_file.h"
#include "output/error.h"

namespace thermotwin::twin {

ProgressFile::ProgressFile(std::filesystem::path const& folder, std::string title)
    : path_(folder / "progress.json"), title_(std::move(title)) {
  output::make_directory(folder);
  write();
}

ProgressFile::~ProgressFile() {
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

void ProgressFile::write() const {
  nlohmann::ordered_json json = {{"title", title_}, {"steps", nlohmann::ordered_json::array()}, {"done", false}};
  for (auto const& [what, at_s, share] : steps_) {
    json["steps"].push_back({{"what", what}, {"at_s", at_s}});
    if (share) json["steps"].back()["share"] = *share;
  }
  try {
    output::write_atomically(path_, json.dump() + "\n");
  } catch (output::OutputError const&) {  // the work goes on
  }
}

}  // namespace thermotwin::twin
