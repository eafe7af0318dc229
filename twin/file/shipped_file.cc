#include "twin/file/shipped_file.h"

#include <algorithm>
#include <fmt/format.h>

#include "thermal/error.h"
#include "thermal/nearest_name.h"

namespace thermotwin::twin {

std::filesystem::path shipped_file(std::string const& kind, std::filesystem::path const& folder,
                                   std::string const& name_or_path) {
  std::filesystem::path const given = name_or_path;
  auto const shipped = std::filesystem::path(THERMOTWIN_SOURCE_DIR) / folder / (name_or_path + ".toml");
  bool const may_be_name = given.extension() != ".toml" && !given.has_parent_path();
  if (may_be_name && std::filesystem::exists(shipped)) return shipped;
  if (given.extension() == ".toml" || std::filesystem::exists(given)) return given;
  throw thermal::InputError(fmt::format("there is no {} '{}'; {}", kind, name_or_path,
                                        thermal::did_you_mean(name_or_path, shipped_names(folder))));
}

std::vector<std::string> shipped_names(std::filesystem::path const& folder) {
  std::vector<std::string> names;
  for (auto const& entry : std::filesystem::directory_iterator(std::filesystem::path(THERMOTWIN_SOURCE_DIR) / folder))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace thermotwin::twin
