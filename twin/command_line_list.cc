#include "twin/command_line_list.h"

#include <CLI/CLI.hpp>

namespace thermotwin::twin {

void take_list(CLI::Option& option) {
  option.delimiter(',');
  option.allow_extra_args(false);
  option.transform([](std::string const& name) { return CLI::detail::trim_copy(name); });
}

}  // namespace thermotwin::twin
