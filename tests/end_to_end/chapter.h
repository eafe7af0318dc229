#pragma once

#include <filesystem>
#include <optional>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/output/temporary_directory.h"

namespace thermotwin::tests {

/// A block of a page that its readers type, fenced or indented.
struct CommandBlock {
  std::string text;
  int line = 0;                        ///< of the page
  std::string given;                   ///< commands for what the reader has by then
  std::string with;                    ///< sed script: names for placeholders, less of what takes minutes
  std::optional<std::string> not_run;  ///< why
};

/// Notes for the test stand before a block as comments that no reader sees:
///
///   <!-- given: cp … -->   <!-- with: s/HOST/localhost/ -->   <!-- not run: asks for a password -->
inline bool take_note(std::string const& text, CommandBlock& next) {
  std::smatch found;
  static std::regex const note(R"(<!-- (given|with|not run):\s+([\s\S]*\S)\s+-->\s*)");
  if (!std::regex_match(text, found, note)) return false;
  if (found[1] == "given") next.given += found[2].str() + "\n";
  if (found[1] == "with") next.with += found[2].str() + "\n";
  if (found[1] == "not run") next.not_run = found[2];
  return true;
}

inline bool is_typed(std::string const& block) {
  static std::regex const typed(
      R"(^(build/)?(thermotwin|thermotwin_bench|script/\S+|mosquitto|mpirun|sbatch|xvfb-run|node|mkdir|cp)\b[\s\S]*)");
  return std::regex_match(block, typed);
}

/// The blocks of a page whose first word is a command, and those marked `sh`, in their order.
inline std::vector<CommandBlock> command_blocks(std::filesystem::path const& page) {
  std::istringstream lines(contents(page));
  std::vector<CommandBlock> blocks;
  CommandBlock next;
  std::string comment, text, fence;
  enum { prose, fenced, indented, note } inside = prose;
  int number = 0, first = 0;
  auto const end = [&](bool always) {
    if (always || (fence.empty() && is_typed(text))) {
      next.text = text;
      next.line = first;
      blocks.push_back(next);
    }
    next = {};
    text.clear();
    fence.clear();
    inside = prose;
  };
  bool after_empty = true;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (inside == note) comment += "\n" + line;
    if (inside == fenced) {
      if (line.starts_with("```"))
        end(fence == "sh");
      else
        text += line + "\n";
    } else if (inside == indented && line.starts_with("    ")) {
      text += line.substr(4) + "\n";
    } else if (inside != note) {
      if (inside == indented) end(false);
      if (line.starts_with("```")) {
        fence = line.substr(3);
        inside = fenced;
        first = number + 1;
      } else if (line.starts_with("    ") && after_empty) {
        text = line.substr(4) + "\n";
        inside = indented;
        first = number;
      } else if (line.starts_with("<!--")) {
        comment = line;
        inside = note;
      } else if (!line.empty()) {
        next = {};
      }
    }
    if (inside == note && comment.ends_with("-->")) {
      if (!take_note(comment, next)) next = {};
      inside = prose;
    }
    after_empty = line.empty() || line.ends_with("-->");
  }
  if (inside == indented) end(false);
  return blocks;
}

}  // namespace thermotwin::tests
