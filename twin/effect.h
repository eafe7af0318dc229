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

/// What the catalogue says about an effect, for people; the numbers come from the fields of its struct.
struct EffectText {
  std::string name;     ///< of its tables in a machine file: `[[joint]]`
  std::string meaning;  ///< one line
  std::string equation;
  std::string changes;    ///< source, link, film, boundary, sensor, deformation or input
  std::string places;     ///< where it can act
  std::string signature;  ///< how it shows in data: power of speed, time scale, sign, what happens at stop
  std::string source;
};

/// One entry of the effect catalogue: the record that the simulator, the command line, the documentation and the
/// diagnosis read. A new effect is a new file in twin/effects that returns one of these.
struct Effect : EffectText {
  std::vector<FieldRecord> parameters;
  std::function<std::unique_ptr<Part>(Value const& table)> read;
};

/// All entries, by name. The list is made from the files in twin/effects when the program is built.
[[nodiscard]] std::vector<Effect> const& effect_catalogue();

/// The entry of this name; InputError with the nearest one if there is none.
[[nodiscard]] Effect const& effect(std::string_view name);

/// Makes an entry of a struct with `std::string name`, a list of `fields` and `void add_to(Assembly&) const`.
template <class T>
Effect make_effect(EffectText text) {
  class PartOf final : public Part {
   public:
    explicit PartOf(Value const& table) { read_fields(table, part_); }
    [[nodiscard]] std::string const& name() const override { return part_.name; }
    void add_to(Assembly& assembly) const override { part_.add_to(assembly); }

   private:
    T part_;
  };
  return {std::move(text), list_fields<T>(), [](Value const& table) { return std::make_unique<PartOf>(table); }};
}

}  // namespace thermotwin::twin
