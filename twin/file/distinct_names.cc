#include "twin/file/distinct_names.h"

#include <algorithm>

namespace thermotwin::twin {
namespace {

namespace fs = std::filesystem;

/// The last parts of a path, or all that it has.
fs::path last_parts(fs::path const& file, std::ptrdiff_t count) {
  auto const parts = std::distance(file.begin(), file.end());
  fs::path last;
  for (auto part = std::next(file.begin(), std::max<std::ptrdiff_t>(parts - count, 0)); part != file.end(); ++part)
    last /= *part;
  return last;
}

}  // namespace

std::vector<fs::path> distinct_names(std::vector<fs::path> const& files) {
  std::vector<fs::path> names;
  for (auto const& file : files) {
    std::ptrdiff_t count = 1;
    auto const is_taken = [&](fs::path const& other) {
      return other != file && last_parts(other, count) == last_parts(file, count);
    };
    while (last_parts(file, count) != file && std::any_of(files.begin(), files.end(), is_taken)) ++count;
    names.push_back(last_parts(file, count));
  }
  return names;
}

std::string name_of_run(fs::path const& file) { return fs::path(file).replace_extension().string(); }

}  // namespace thermotwin::twin
