#include "twin/file/output_path.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>

#include "output/display.h"
#include "scenarios/recorded.h"
#include "thermal/error.h"
#include "twin/file/document.h"
#include "twin/file/value.h"

namespace thermotwin::twin {

namespace fs = std::filesystem;

namespace {

void require_folder(fs::path const& output, fs::path const& made) {
  fs::path const folder = output.parent_path();
  if (folder.empty() || fs::is_directory(folder)) return;
  auto const rest = made.lexically_normal().lexically_relative(folder.lexically_normal());
  if (!rest.empty() && *rest.begin() != "..") return;
  throw thermal::InputError(fmt::format("cannot write '{}': there is no folder '{}'; make it, or name another one",
                                        output.string(), folder.string()));
}

/// With the tables that a measurement or an experiment names.
std::vector<fs::path> read_with(fs::path const& file) {
  std::vector<fs::path> files = {file};
  if (file.extension() != ".toml" || !fs::is_regular_file(file)) return files;
  try {
    Value document = read_toml(file);
    for (auto const* kind : {"table", "recorded"})
      for (auto const* table : tables_of(document, kind))
        for (auto const& name : texts_of(*table, "file"))
          files.push_back(scenarios::resolved_path(name, file.parent_path()));
  } catch (thermal::InputError const&) {  // told where it is read
  }
  return files;
}

[[noreturn]] void wrong_suffix(fs::path const& output, std::string_view what,
                               std::vector<std::string> const& suffixes) {
  throw thermal::InputError(fmt::format("{}: {} is written as {}", output.string(), what, fmt::join(suffixes, " or ")));
}

}  // namespace

void refuse_to_overwrite(fs::path const& output, fs::path const& machine, std::vector<fs::path> const& others,
                         fs::path const& made) {
  if (output.empty()) return;
  require_folder(output, made);
  if (!fs::exists(output)) return;
  if (fs::is_directory(output))
    throw thermal::InputError(fmt::format("cannot write '{}': it is a folder; a file is due", output.string()));
  auto inputs = others;
  inputs.push_back(machine);
  for (auto const& named : inputs)
    for (auto const& input : read_with(named))
      if (fs::exists(input) && fs::equivalent(input, output))
        throw thermal::InputError(
            fmt::format("{}: that is one of the files to be read, which are never overwritten; "
                        "name another one",
                        output.string()));
}

void refuse_to_replace_other(fs::path const& output, std::string_view what,
                             std::function<bool(fs::path const&)> const& is_one) {
  if (!fs::is_regular_file(output) || fs::is_empty(output) || is_one(output)) return;
  throw thermal::InputError(
      fmt::format("{}: is no {}, whose place one does not take; name another output", output.string(), what));
}

void refuse_to_replace_other_table(fs::path const& output, std::string_view what,
                                   std::function<bool(std::string const&)> const& is_header) {
  refuse_to_replace_other(output, what, [&](fs::path const& there) {
    std::string header;
    std::ifstream file(there);
    std::getline(file, header);
    return is_header(header);
  });
}

void check_suffix(fs::path const& output, std::string_view what, std::vector<std::string> const& suffixes) {
  auto const suffix = output.extension().string();
  if (suffix.empty() || std::find(suffixes.begin(), suffixes.end(), suffix) != suffixes.end()) return;
  wrong_suffix(output, what, suffixes);
}

void check_picture(fs::path const& picture) {
  if (picture.empty()) return;
  check_suffix(picture, "a picture", {".png"});
  output::DisplayConnection const there;
}

void check_machine_suffix(fs::path const& output) {
  if (!output.empty() && output.extension() != ".toml") wrong_suffix(output, "a machine", {".toml"});
}

}  // namespace thermotwin::twin
