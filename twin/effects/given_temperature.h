#pragma once

#include <optional>
#include <string>

#include "thermal/error.h"
#include "twin/assembly.h"
#include "twin/file/document.h"

namespace thermotwin::twin {

/// A temperature that the machine does not make: constant, or that of an input channel plus an offset.
struct GivenTemperature {
  std::optional<double> temperature;  ///< [K]
  std::string follows;
  double offset = 0.0;  ///< [K]

  template <class Owner, class Fields>
  static void fields_of(Fields& f) {
    f.temperature("temperature", &Owner::temperature, "of the other side, where it is constant");
    f("follows", &Owner::follows, "where it is not constant: input channel with that temperature");
    f("offset", &Owner::offset, dimension::temperature_difference, "added to the temperature of that channel",
      Range{-20, 20});
  }

  /// FileError where a constant temperature and what only one that follows has are both given.
  void check(Value const& table) const {
    refuse_both(table, "follows", "temperature");
    if (offset != 0.0) refuse_both(table, "offset", "temperature");
  }
  /// InputError that begins with `owner` where neither is given.
  [[nodiscard]] thermal::Port port(Assembly& assembly, std::string const& owner) const {
    if (temperature) return assembly.network().add_boundary({owner, *temperature, {}});
    if (follows.empty()) throw thermal::InputError(owner + " needs a temperature or an input channel that it follows");
    return assembly.boundary(follows, offset);
  }
};

}  // namespace thermotwin::twin
