#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "twin/effect.h"
#include "twin/machine.h"

namespace thermotwin::twin {

/// Beyond this share of the largest plausible amplitude it is not that effect.
inline constexpr double most_of_largest = 1.25;

/// An amplitude in units of the largest plausible one that changes nothing, and keeps the effect's table in the
/// machine.
inline constexpr double as_good_as_none = 1e-8;

/// Prior of an amplitude in units of the largest plausible one: N(0, this²).
inline constexpr double amplitude_deviation = 0.5;

/// One effect that a machine file may lack, at one site: a table that could be appended to it.
struct Hypothesis {
  Effect const* effect = nullptr;
  Trial const* trial = nullptr;
  std::string site;  ///< where, as people read it: "cartridge[0 mm .. 160 mm]", "T4", "motor to column_front"
  std::string body;  ///< body, sensor or displacement channel that it acts on first
  std::vector<std::pair<std::string, std::string>> keys;  ///< of the table, but for its name and amplitude
  /// 2 ln of the number of sites and shapes that the effect has in this machine, and what is against it beforehand:
  /// effects are equally likely otherwise, and so are the sites of one. Among a hundred sites, one fits by chance. A
  /// lag where the file states the sensor's has odds of e^-15 against it.
  double choice = 0.0;
  /// Largest plausible amplitude here [SI]: the trial's; of an area, no more than the body has, and the other one.
  double largest = 0.0;
  /// Where a response per unit is not the slope at nothing, of which amplitude it is [of the largest].
  double about = 0.0;
  /// Whether a table of the file does the same at the same place: this is more of it than its numbers may be.
  bool stands = false;

  /// What is compared: entries that differ in their shape only are one effect at one place.
  [[nodiscard]] std::string label() const { return effect->name + " at " + site; }
  /// Whether the effect changes this: "source", "link", "film", "boundary", "sensor", "deformation" or "input".
  [[nodiscard]] bool is_about(std::string_view what) const { return effect->changes.find(what) != std::string::npos; }
  /// People see it through sensors or displacements, not through heat alone.
  [[nodiscard]] bool is_read_directly() const { return is_about("sensor") || is_about("deformation"); }
  /// Of the amplitude.
  [[nodiscard]] thermal::Dimension dimension() const;
  /// Whether the 95 % interval of an amplitude (in units of `largest`, as its standard error) reaches down to what the
  /// best of machines has.
  [[nodiscard]] bool is_ordinary(double amplitude, double standard_error) const;
};

/// Every trial of the catalogue at every site that the machine has for it, but for effects named in `without`. A bar of
/// more than 150 mm has three stretches, other bodies are one site.
[[nodiscard]] std::vector<Hypothesis> hypotheses(Value const& document, Machine const& machine,
                                                 std::vector<std::string> const& without = {});

/// Sets `choice`: the hypotheses of an effect share its probability; anew where some were left out.
void share_probability(std::vector<Hypothesis>& hypotheses, Machine const& machine);

/// These, and after them once more those that are also looked for at an amplitude of some size.
[[nodiscard]] std::vector<Hypothesis> with_those_of_some_size(std::vector<Hypothesis> hypotheses);

/// The document with the table of a hypothesis appended; amplitude in SI.
[[nodiscard]] Value with_hypothesis(Value document, Hypothesis const& hypothesis, std::string const& name,
                                    double amplitude);

/// The keys of that table and their texts, as they stand in a file: what an amended file gets.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> table_of(Hypothesis const& hypothesis,
                                                                        std::string const& name, double amplitude);

}  // namespace thermotwin::twin
