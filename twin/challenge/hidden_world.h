#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "output/dataset.h"
#include "twin/diagnosis/hypothesis.h"
#include "twin/file/value.h"

namespace thermotwin::twin {

/// What is hidden in a challenge.
enum class CaseKind { one, none, outside, two, sensor };

/// "one", "none", "outside", "two" or "sensor"; InputError otherwise.
[[nodiscard]] CaseKind case_kind(std::string const& name);
[[nodiscard]] std::string name_of(CaseKind kind);

/// The kind that a seed stands for: of every ten, five hide one effect, two nothing, one an effect outside of the
/// catalogue, one two effects, one a faulty sensor.
[[nodiscard]] CaseKind case_kind(std::uint64_t seed);

struct HiddenEffect {
  Hypothesis hypothesis;  ///< effect and site, on the nominal machine
  double amplitude = 0.0;
};

/// A sensor whose readings go wrong (physics.md §7 nos. 27 to 29).
struct HiddenFault {
  std::string sensor;
  std::string kind;        ///< "drift", "lag", "contact", "stuck" or "jumping"
  double amplitude = 0.0;  ///< drift [K/s], lag [s], share of the way to the air [1], jump [K]; of a stuck one 0
  double from = 0.0;       ///< share of run 1 after which it is stuck; it is throughout the other runs
};

/// The measured machine behind a challenge: another form of the network, other parameters, imperfect instruments, and
/// what the nominal machine does not have. The same seed draws the same world.
struct HiddenWorld {
  CaseKind kind = CaseKind::none;
  std::uint64_t seed = 0;
  Value healthy;  ///< the document without what is hidden
  Value hidden;
  std::vector<HiddenEffect> effects;
  std::optional<HiddenFault> fault;
  std::map<std::string, double> drawn;  ///< factor on each coefficient, or SI value of an instrument's key
};

/// Draws coefficients (20 % lognormal for conductances, film coefficients and areas, powers, friction), heat capacities
/// and weights of the structural loop (10 %), and the specimen of every sensor (offset 0.15 K, lag 10 to 60 s, model
/// error AR(1) of 10 min and 0.1 K); then the effects, at sites of the nominal machine, between 0.15 and 0.8 of the
/// largest plausible amplitude (or of Trial::hidden_up_to), such that the nominal machine shows them on the held-out
/// run: 1 µm or 0.4 K.
[[nodiscard]] HiddenWorld draw_hidden_world(Value const& nominal, std::uint64_t seed, CaseKind kind);

/// The draw without anything hidden: spread 1 is that of a challenge, 0 leaves all coefficients. Numbers of which the
/// file states a range ([[uncertain]]) are drawn evenly within it, whatever they are.
[[nodiscard]] Value vary_parameters(Value document, std::uint64_t seed, double spread,
                                    std::map<std::string, double>& drawn);

/// Adds what instruments and records do that no machine file says: noise of displacements (AR(1) of 10 min and 0.3 µm,
/// white 0.1 µm), of the recorded speed (0.5 %) and air temperature (0.1 K), a stuck or jumping sensor. Each run, by
/// its name, has noise of its own.
void disturb(output::Dataset& dataset, HiddenWorld const& world, std::string const& run);

}  // namespace thermotwin::twin
