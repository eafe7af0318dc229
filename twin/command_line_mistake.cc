#include "twin/command_line_mistake.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <vector>

#include "thermal/nearest_name.h"

namespace thermotwin::twin {
namespace {

bool is_option(std::string const& word) { return word.size() > 1 && word[0] == '-'; }

std::string unknown_command(CLI::App& app, std::string const& word) {
  std::vector<std::string> names;
  for (auto const* command : app.get_subcommands({})) names.push_back(command->get_name());
  return fmt::format("unknown command '{}'; {}", word, thermal::did_you_mean(word, names));
}

/// "--tolerance" of "--tolerance=abc".
std::string option_in(std::string const& word) { return word.substr(0, word.find('=')); }

std::string unknown_option(CLI::App const& command, std::string const& word) {
  std::vector<std::string> names;
  for (auto const* option : command.get_options())
    for (auto const& name : option->get_lnames()) names.push_back("--" + name);
  auto const option = option_in(word);
  return fmt::format("unknown option '{}'; {}", option, thermal::did_you_mean(option, names));
}

/// About the first word that is an option of a command, and stands before it or without one; empty without such a word.
std::string too_early(CLI::App& app) {
  auto commands = app.get_subcommands();
  auto const all = app.get_subcommands({});
  commands.insert(commands.end(), all.begin(), all.end());
  for (auto const& word : app.remaining()) {
    auto const option = option_in(word);
    if (is_option(word))
      for (auto const* command : commands)
        if (command->get_option_no_throw(option))
          return fmt::format("'{0}' is an option of a command: {1} {2} {0} ...", option, app.get_name(),
                             command->get_name());
  }
  return {};
}

/// Words that no command or option takes.
std::string unexpected(CLI::App& app, std::vector<std::string> const& words) {
  if (auto const early = too_early(app); !early.empty()) return early;
  auto const option = std::find_if(words.begin(), words.end(), is_option);
  auto const commands = app.get_subcommands();
  if (commands.empty()) return is_option(words[0]) ? unknown_option(app, words[0]) : unknown_command(app, words[0]);
  auto const& command = *commands[0];
  return fmt::format(
      "{}: {}", command.get_name(),
      option != words.end() ? unknown_option(command, *option) : fmt::format("'{}' is an argument too many", words[0]));
}

}  // namespace

std::string command_line_mistake(CLI::App& app, CLI::ParseError const& error) {
  if (auto const words = app.remaining(true); !words.empty()) return unexpected(app, words);
  auto const commands = app.get_subcommands();
  if (commands.empty()) return "a command is due; thermotwin --help lists them";
  auto const& command = *commands[0];
  std::string const name = fmt::format("{} {}", app.get_name(), command.get_name());
  std::string usage = CLI::Formatter().make_usage(&command, name);
  usage.erase(std::unique(usage.begin(), usage.end(), [](char a, char b) { return a == '\n' && b == '\n'; }),
              usage.end());
  return fmt::format("{}: {}\n{}{} --help tells more", command.get_name(), error.what(), usage, name);
}

}  // namespace thermotwin::twin
