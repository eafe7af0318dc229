#include "twin/experiment_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "thermal/nearest_name.h"

namespace thermotwin::twin {

scenarios::Experiment read_experiment(Value const& document, std::filesystem::path const& file) {
  scenarios::Experiment experiment;
  read_fields(document, experiment);
  experiment.directory = file.has_parent_path() ? file.parent_path() : ".";
  try {
    scenarios::check(experiment);
  } catch (FileError const&) {
    throw;
  } catch (thermal::InputError const& error) {
    throw FileError({file.string(), 0, 0}, error.what());
  }
  return experiment;
}

std::filesystem::path experiment_file(std::string const& name_or_path) {
  std::filesystem::path const given = name_or_path;
  if (given.extension() == ".toml" || std::filesystem::exists(given)) return given;
  std::filesystem::path const folder = std::filesystem::path(THERMOTWIN_SOURCE_DIR) / "scenarios" / "catalogue";
  auto const shipped = folder / (name_or_path + ".toml");
  if (std::filesystem::exists(shipped)) return shipped;
  std::vector<std::string> names;
  for (auto const& entry : std::filesystem::directory_iterator(folder)) names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  throw thermal::InputError(
      fmt::format("there is no experiment '{}'; {}", name_or_path, thermal::did_you_mean(name_or_path, names)));
}

}  // namespace thermotwin::twin
