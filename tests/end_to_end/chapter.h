#pragma once

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <optional>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/output/temporary_directory.h"

namespace thermotwin::tests {

/// A block of a page that its readers type, fenced or indented, or the whole commands in a paragraph's sentences.
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

/// What stands between backticks in a text, each on one line.
inline std::vector<std::string> code_spans(std::string const& text) {
  std::vector<std::string> spans;
  std::istringstream pieces(text);
  bool code = false;
  for (std::string piece; std::getline(pieces, piece, '`'); code = !code) {
    if (!code) continue;
    std::replace(piece.begin(), piece.end(), '\n', ' ');
    spans.push_back(std::regex_replace(piece, std::regex(R"(\\\|)"), "|"));  // as tables want it
  }
  return spans;
}

/// The program's commands between backticks that say all, a line each: with arguments, none of them a placeholder.
inline std::string whole_commands(std::string const& paragraph) {
  static std::regex const command(R"((build/)?thermotwin [a-z]+ \S.*)"), placeholder(R"(.* [A-Z]+\b.*|.*….*)");
  std::string text;
  for (auto const& span : code_spans(paragraph))
    if (std::regex_match(span, command) && !std::regex_match(span, placeholder)) text += span + "\n";
  return text;
}

/// The blocks of a page whose first word is a command, those marked `sh`, and the whole commands of its sentences and
/// tables, in their order.
inline std::vector<CommandBlock> command_blocks(std::filesystem::path const& page) {
  std::istringstream lines(contents(page));
  std::vector<CommandBlock> blocks;
  CommandBlock next;
  std::string comment, text, fence;
  enum { prose, fenced, indented, note } inside = prose;
  int number = 0, first = 0;
  auto const end = [&](bool is_commands) {
    if (is_commands) {
      next.text = text;
      next.line = first;
      blocks.push_back(next);
    }
    next = {};
    text.clear();
    inside = prose;
  };
  auto const end_paragraph = [&] {
    if (text.empty()) return;
    text = whole_commands(text);
    end(!text.empty());
  };
  auto const begin = [&](auto kind, int line) {
    end_paragraph();
    inside = kind;
    first = line;
  };
  bool after_empty = true;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (inside == note) comment += "\n" + line;
    if (inside == fenced) {
      if (line.starts_with("```"))
        end(fence == "sh" || (fence.empty() && is_typed(text)));
      else
        text += line + "\n";
    } else if (inside == indented && line.starts_with("    ")) {
      text += line.substr(4) + "\n";
    } else if (inside != note) {
      if (inside == indented) end(is_typed(text));
      if (line.starts_with("```")) {
        begin(fenced, number + 1);
        fence = line.substr(3);
      } else if (line.starts_with("    ") && after_empty) {
        begin(indented, number);
        text = line.substr(4) + "\n";
      } else if (line.starts_with("<!--")) {
        begin(note, number);
        comment = line;
      } else if (line.empty()) {
        end_paragraph();
      } else {
        if (text.empty()) first = number;
        text += line + "\n";
      }
    }
    if (inside == note && comment.ends_with("-->")) {
      if (!take_note(comment, next)) next = {};
      inside = prose;
    }
    after_empty = line.empty() || line.ends_with("-->");
  }
  if (inside == indented) end(is_typed(text));
  end_paragraph();
  return blocks;
}

/// What a page quotes of the program's answers: its lines that begin with "> ".
inline std::vector<std::string> quotes(std::filesystem::path const& page) {
  std::istringstream lines(contents(page));
  std::vector<std::string> quoted;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("> ")) quoted.push_back(line.substr(2));
  return quoted;
}

/// The quote stands in the text, blanks aside and each number to a fifth.
inline bool is_said(std::string const& quote, std::string const& text) {
  static std::regex const token(R"([0-9]+(\.[0-9]+)?|\S)");
  auto const tokens = [](std::string const& of) {
    return std::vector<std::string>(std::sregex_token_iterator(of.begin(), of.end(), token), {});
  };
  auto const alike = [](std::string const& a, std::string const& b) {
    auto const is_number = [](std::string const& word) { return std::isdigit(static_cast<unsigned char>(word[0])); };
    if (!is_number(a) || !is_number(b)) return a == b;
    double const x = std::stod(a), y = std::stod(b);
    return std::abs(x - y) <= 0.2 * std::max(x, y);
  };
  auto const said = tokens(text), sought = tokens(quote);
  return std::search(said.begin(), said.end(), sought.begin(), sought.end(), alike) != said.end();
}

/// A page without its fenced blocks and comments.
inline std::string sentences(std::filesystem::path const& page) {
  std::istringstream lines(contents(page));
  std::string text;
  bool fenced = false, comment = false;
  for (std::string line; std::getline(lines, line);) {
    bool const fence = line.starts_with("```");
    comment = comment || line.starts_with("<!--");
    if (!fenced && !fence && !comment) text += line + "\n";
    fenced = fenced != fence;
    comment = comment && !line.ends_with("-->");
  }
  return text;
}

}  // namespace thermotwin::tests
