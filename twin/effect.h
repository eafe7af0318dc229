#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "twin/file/schema.h"

namespace thermotwin::twin {

class Assembly;

/// One table of a machine file that carries, makes or changes heat, a displacement or a reading.
class Part {
 public:
  Part() = default;
  Part(Part const&) = delete;
  Part& operator=(Part const&) = delete;
  virtual ~Part() = default;

  [[nodiscard]] virtual std::string const& name() const = 0;
  virtual void add_to(Assembly& assembly) const = 0;
};

/// How diagnosis tries an effect that a machine file does not have: as one table more, whose amplitude is small enough
/// to change nothing, at every site of the kind that its keys ask for.
struct Trial {
  /// A key of the table and what may stand there, by kind:
  ///
  ///   solid, shaft, ring, motor   a stretch of a body; of one that turns; a bearing's outer ring or seat; with a loss
  ///   solid but no motor          a stretch of a body without a motor's loss
  ///   resting solid, casting      a stretch of a body that does not turn; of one with a material: no ring, no fluid
  ///   room surface, bare surface, base     with a film to the room; with one that does not radiate; carried by none
  ///   sensor, displacement, channel        an instrument; a channel of displacement; a line of fluid
  ///   screw, displacement or screw         a ball screw of which errors of position are read; either
  ///   bearing, support            shaft and outer ring of a spindle bearing; of a screw's support (and its `speed`)
  ///   nut                         nut and screw (and `axis`) of a drive
  ///   pair, wetted wall           two solids that no joint connects; what encloses a line of fluid
  struct Site {
    std::string key;
    std::string kind;
    std::string other = {};  ///< key of the second place, of bearing, support, nut and pair; empty: it has none
  };
  std::string amplitude = {};  ///< key of the number that grows from nothing; the flows are linear in it
  double largest = 0.0;        ///< plausible upper end of the amplitude [SI]
  double hidden_up_to = 0.0;   ///< upper end in hidden worlds, where HIDE-1000 has a smaller one; 0: `largest` [SI]
  bool either_sign = false;    ///< it may be negative
  bool needs_spindle = false;  ///< it has no place in a machine without one, nor in a feed drive
  /// Sought only where this input channel changes, and never hidden: HIDE-1000 was drawn without it. Empty: always.
  std::string if_changes = {};
  double ordinary = 0.0;  ///< what the best of machines has: no less is an effect [SI]
  /// Where its response is far from proportional, an amplitude about which it is looked for as well [of the largest].
  double also_about = 0.0;
  double against = 0.0;  ///< 2 ln of the odds against it beforehand: a network that is too coarse looks like it
  std::vector<Site> sites = {};
  /// Other keys and their texts, one table per variant: {{"exponent", "0.5"}}; none: the defaults.
  std::vector<std::vector<std::pair<std::string, std::string>>> shapes = {};
  /// Numbers in proportion to the amplitude: {"heat_capacity", 1800.0} for a mass with τ = C/G = 30 min.
  std::vector<std::pair<std::string, double>> proportional = {};
};

/// What the catalogue says about an effect, for people; the numbers come from the fields of its struct.
struct EffectText {
  std::string name;     ///< of its tables in a machine file: `[[joint]]`
  std::string meaning;  ///< one line
  std::string equation;
  std::string changes;    ///< source, link, film, boundary, sensor, deformation or input
  std::string sites;      ///< where it can act: places, sensors, displacement channels
  std::string signature;  ///< how it shows in data: power of speed, time scale, sign, what happens at stop
  std::string source;
  std::vector<int> numbers = {};             ///< of physics.md §7
  std::vector<std::string> confusable = {};  ///< effects that look alike
  std::string separated_by = {};             ///< the experiment that tells them apart
};

/// One entry of the effect catalogue: the record that the simulator, the command line, the documentation and the
/// diagnosis read. A new effect is a new file in twin/effects that returns one of these.
struct Effect : EffectText {
  std::vector<FieldRecord> parameters;
  std::vector<Trial> trials;  ///< none: diagnosis does not try it
  std::function<std::unique_ptr<Part>(Value const& table)> read;
};

/// All entries, by name. The list is made from the files in twin/effects when the program is built.
[[nodiscard]] std::vector<Effect> const& effect_catalogue();

/// The entry of this name; InputError with the nearest one if there is none.
[[nodiscard]] Effect const& effect(std::string_view name);

/// Makes an entry of a struct with `std::string name`, a list of `fields` and `void add_to(Assembly&) const`; a
/// `void check(Value const& table) const` throws a FileError where its keys contradict one another.
template <class T>
Effect make_effect(EffectText text, std::vector<Trial> trials = {}) {
  class PartOf final : public Part {
   public:
    explicit PartOf(Value const& table) {
      read_fields(table, part_);
      if constexpr (requires { part_.check(table); }) part_.check(table);
    }
    [[nodiscard]] std::string const& name() const override { return part_.name; }
    void add_to(Assembly& assembly) const override { part_.add_to(assembly); }

   private:
    T part_;
  };
  return {std::move(text), list_fields<T>(), std::move(trials),
          [](Value const& table) { return std::make_unique<PartOf>(table); }};
}

}  // namespace thermotwin::twin
