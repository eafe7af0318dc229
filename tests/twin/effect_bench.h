#pragma once

#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "tests/thermal/function_course.h"
#include "twin/machine.h"

namespace thermotwin::twin {

/// One table of tests/twin/effect_snippets.toml: an effect to be tried alone on the machine of effect_bench.toml.
struct Snippet {
  std::string effect;
  std::string name;  ///< says the variant
  Value table;

  [[nodiscard]] std::string path(std::string const& key) const { return effect + "." + name + "." + key; }
  /// What the network calls the part.
  [[nodiscard]] std::string part() const { return effect + "." + name; }
};

inline void PrintTo(Snippet const& snippet, std::ostream* out) { *out << snippet.part(); }

[[nodiscard]] std::vector<Snippet> const& snippets();

/// The first one of an effect, or the one of that name.
[[nodiscard]] Snippet const& snippet(std::string const& effect, std::string const& name = "");

using Changes = std::vector<std::pair<std::string, std::string>>;  ///< {"conductance", "2 W/K"}

/// The document of the machine with the effect on it.
[[nodiscard]] Value bench(Snippet const& snippet, Changes const& changes = {});

using Inputs = std::vector<std::pair<std::string, double>>;  ///< {"spindle.speed", 100.0}

/// What a channel has on the bench while all runs; 0 for an unknown one.
[[nodiscard]] double bench_input(std::string const& channel);

/// The inputs of the bench, with some replaced: constant over time but for the clocks.
[[nodiscard]] thermal::FunctionCourse bench_course(Machine const& machine, Inputs const& replaced = {});

/// Different temperatures for all nodes [K], 0 for controllers.
[[nodiscard]] std::vector<double> bench_temperatures(Machine const& machine);

/// The same temperature for all nodes, 0 for controllers.
[[nodiscard]] std::vector<double> uniform_temperatures(Machine const& machine, double temperature);

/// Heat that the effect gives to each node [W].
[[nodiscard]] std::vector<double> heat_of(Snippet const& effect, Machine const& machine,
                                          std::vector<double> const& temperatures, Inputs const& replaced = {});

/// The sum over all nodes of the effect on the bench [W].
[[nodiscard]] double total_heat(Snippet const& effect, Inputs const& replaced = {}, Changes const& changes = {});

}  // namespace thermotwin::twin
