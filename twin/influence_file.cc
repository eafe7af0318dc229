#include "twin/influence_file.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <fstream>

#include "output/atomic_file.h"
#include "thermal/error.h"

namespace thermotwin::twin {
namespace {

namespace fs = std::filesystem;
using thermal::InputError;

std::vector<double> numbers_of(std::string_view text, fs::path const& path, std::string const& key) {
  std::vector<double> numbers;
  char const* next = text.data();
  char const* const end = next + text.size();
  while (next < end) {
    double number = 0.0;
    auto const [stop, error] = std::from_chars(next + 1, end, number);
    if (*next != ',' || error != std::errc() || (stop < end && *stop != ','))
      throw InputError(
          fmt::format("{}: the solution {} is damaged after {} numbers; delete the file and run: "
                      "thermotwin weights",
                      path.string(), key, numbers.size()));
    numbers.push_back(number);
    next = stop;
  }
  return numbers;
}

/// The solution of this key, and nothing else is looked at.
std::optional<std::vector<double>> find_in(fs::path const& path, std::string const& key) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(key + ",")) return numbers_of(std::string_view(line).substr(key.size()), path, key);
  return {};
}

std::vector<fs::path> neighbours(fs::path const& own) {
  std::vector<fs::path> files;
  std::error_code none;
  for (auto const& entry : fs::directory_iterator(own.has_parent_path() ? own.parent_path() : ".", none))
    if (entry.path().extension() == ".weights" && entry.path().filename() != own.filename())
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

fs::path weights_file(fs::path const& machine_file) { return fs::path(machine_file).replace_extension(".weights"); }

std::string text_of(std::map<std::string, Solution> const& solutions) {
  std::string text;
  for (auto const& [key, solution] : solutions) {
    text += fmt::format("# {}\n{}", solution.remark, key);
    for (double const sum : solution.sums) text += fmt::format(",{:.9g}", sum);
    text += '\n';
  }
  return text;
}

void write_solutions(fs::path const& path, std::map<std::string, Solution> const& solutions) {
  output::write_atomically(path, text_of(solutions));
}

std::optional<std::vector<double>> find_solution(fs::path const& machine_file, std::string const& key) {
  auto const own = weights_file(machine_file);
  if (auto found = find_in(own, key)) return found;
  for (auto const& path : neighbours(own))
    if (auto found = find_in(path, key)) return found;
  return {};
}

}  // namespace thermotwin::twin
