#pragma once

#include <functional>
#include <string>
#include <vector>

#include "twin/diagnosis/hypothesis.h"
#include "twin/diagnosis/remedy.h"
#include "twin/diagnosis/schedule.h"
#include "twin/file/value.h"

namespace thermotwin::twin {

/// What experiments and sensors can show at all, before there are any data.
struct Plan {
  struct Effect {
    Hypothesis hypothesis;
    double seen = 0.0;  ///< d_i at half of its largest plausible amplitude
    double kept = 0.0;  ///< share of its signature that calibration cannot imitate
  };
  /// Two effects, and the sites at which they are most alike for how clearly they are seen.
  struct Ambiguity {
    std::size_t effect = 0, rival = 0;  ///< of `effects`
    double cosine = 0.0;
    double distance = 0.0;  ///< d_ij
    std::vector<Remedy> remedies;
  };
  std::vector<std::string> schedules;
  double hours = 0.0;
  std::vector<Effect> effects;         ///< one per effect and site, in its clearest shape; clearest first
  std::vector<Ambiguity> ambiguities;  ///< pairs seen but less than 6 apart; one per pair of effects, worst first
};

struct PlanOptions {
  std::vector<std::string> without;  ///< effects that are not tried
  std::size_t with_remedies = 6;     ///< ambiguities for which remedies are sought
  std::function<void(std::string const&)> progress;
};

[[nodiscard]] Plan plan(Value const& document, std::vector<Schedule> const& schedules, PlanOptions const& options);

[[nodiscard]] std::string plan_text(Plan const& plan);
[[nodiscard]] std::string plan_json(Plan const& plan);

}  // namespace thermotwin::twin
