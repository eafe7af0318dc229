#include "twin/command_line_mistake.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
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

/// Of options of which one is due, where none is given, or more; else empty.
std::string unmade_choice(CLI::App const& command) {
  for (auto const* group : command.get_subcommands({})) {
    if (group->get_require_option_min() != 1 || group->get_require_option_max() != 1) continue;
    std::vector<std::string> names;
    std::size_t given = 0;
    for (auto const* option : group->get_options())
      if (option != group->get_help_ptr()) {
        names.push_back(option->get_name());
        given += option->empty() ? 0 : 1;
      }
    if (given != 1) return fmt::format("one of {} is due, and no other", fmt::join(names, " and "));
  }
  return {};
}

/// What may have been meant for what is missing: the words of an option that takes all up to the next option.
std::string greedy_option(CLI::App const& command) {
  for (auto const* option : command.get_options())
    if (!option->get_positional() && option->get_allow_extra_args() && option->count() > 1)
      return fmt::format(", and {} took '{}', as all words up to the next option", option->get_name(),
                         fmt::join(option->results(), "', '"));
  return {};
}

}  // namespace

std::string command_line_mistake(CLI::App& app, CLI::ParseError const& error) {
  if (auto const words = app.remaining(true); !words.empty()) return unexpected(app, words);
  auto const commands = app.get_subcommands();
  if (commands.empty()) return "a command is due; thermotwin --help lists them";
  auto const& command = *commands[0];
  std::string what = error.what();
  if (dynamic_cast<CLI::RequiredError const*>(&error)) {
    auto const choice = unmade_choice(command);
    what = choice.empty() ? what + greedy_option(command) : choice;
  }
  return fmt::format("{0}: {1}; {2} {0} --help tells more", command.get_name(), what, app.get_name());
}

}  // namespace thermotwin::twin
