#include "twin/file/output_path.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "output/display.h"
#include "thermal/error.h"

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
  for (auto const& input : inputs)
    if (fs::exists(input) && fs::equivalent(input, output))
      throw thermal::InputError(
          fmt::format("{}: that is one of the files to be read, which are never overwritten; "
                      "name another one",
                      output.string()));
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
