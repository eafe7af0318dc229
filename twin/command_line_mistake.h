#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace thermotwin::twin {

/// What is wrong with a command line: the unknown command or option and the nearest one that there is; otherwise what
/// CLI11 says, under the command's name, with the option that may have taken what is missing.
[[nodiscard]] std::string command_line_mistake(CLI::App& app, CLI::ParseError const& error);

}  // namespace thermotwin::twin
