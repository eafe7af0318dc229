#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "twin/bodies.h"
#include "twin/file/value.h"

namespace thermotwin::twin {

/// `[[site]]` of a file of candidates: one place where a sensor could sit.
struct CandidateSite {
  std::string name;
  std::vector<std::string> at;  ///< place on a body, as in a machine file; several: their mean; "ambient": room air
  double cost = 1.0;
  Value::List shares = {};  ///< of its places, as a sensor of the machine has them; none: equal

  template <class Fields>
  static void fields(Fields& f) {
    f("name", &CandidateSite::name, "of the site; default: its place");
    f("at", &CandidateSite::at, "place on a body, as of a temperature_sensor; \"ambient\": room air");
    f("cost", &CandidateSite::cost, {}, "of a sensor there, in the unit of the budget; without: what its body costs");
  }
};

/// `[[body]]` of a file of candidates: what sensors on a body cost.
struct BodyCost {
  std::string name;
  double cost = 1.0;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &BodyCost::name, "of the body");
    f("cost", &BodyCost::cost, {}, "of a sensor on it");
  }
};

/// A file of candidates: where sensors may sit and what they cost.
struct CandidateRules {
  std::vector<CandidateSite> sites;    ///< the only ones; none: a mesh of sites on all surfaces
  std::vector<std::string> forbidden;  ///< bodies without sensors, besides those that turn
  std::vector<BodyCost> bodies;
  int most = 200;                                           ///< sites of the mesh
  double budget = std::numeric_limits<double>::infinity();  ///< that the costs of the chosen sites must not exceed
  std::optional<Value> document;                            ///< where all this stands, for messages; none: in no file

  template <class Fields>
  static void fields(Fields& f) {
    f("site", &CandidateRules::sites, "the only candidates; without: a mesh of sites on the surfaces of all bodies");
    f("forbidden", &CandidateRules::forbidden, "bodies that can carry no sensor, besides those that turn");
    f("body", &CandidateRules::bodies, "what sensors on a body cost; default: 1");
    f("most", &CandidateRules::most, "sites of the mesh");
    f("budget", &CandidateRules::budget, {}, "for the sum of the costs; default: no limit");
  }
};

/// FileError with the place of what is wrong in the file itself; what the machine lacks, candidate_sites finds.
[[nodiscard]] CandidateRules read_candidate_rules(std::filesystem::path const& path);

/// The candidates on a machine. Without sites in the rules: the room air, and a mesh on the outer surfaces of the
/// solids that neither turn nor are forbidden, one site per facet of their cells; if that is more than `most`, those
/// that farthest-point sampling takes first (Gonzalez 1985), each body having at least one and distances counted in its
/// own diagonal. Where the rules name a body that is not there or a place beyond it, or a budget that buys no sensor:
/// FileError with the place in their file. InputError for a machine without any site.
[[nodiscard]] std::vector<CandidateSite> candidate_sites(Value const& document, CandidateRules const& rules);

/// What a sensor at these places costs: what the rules say of a site there, or else the dearest of its bodies.
[[nodiscard]] double cost_at(std::vector<std::string> const& at, CandidateRules const& rules);

/// Bodies that carry no candidate since they are forbidden or turn; one that turns does carry sites of the rules' own.
[[nodiscard]] std::set<std::string> bodies_without_candidates(Value const& document, CandidateRules const& rules);

/// InputError unless a sensor could be there: a place on a body, or "ambient".
void check_place(std::string const& place, Bodies const& bodies);

/// Room for `spares` more sensors beside each: the sites, then as many copies "… (spare)", one after another.
[[nodiscard]] std::vector<CandidateSite> with_spares(std::vector<CandidateSite> sites, int spares);

/// The document with one more ideal sensor per site, after those that it has: `Machine::sensors` ends with them.
[[nodiscard]] Value with_sensors_at(Value document, std::vector<CandidateSite> const& sites);

}  // namespace thermotwin::twin
