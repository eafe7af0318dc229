#pragma once

#include <string>
#include <vector>

#include "models/distinguishing.h"
#include "twin/placement/ensemble.h"

namespace thermotwin::twin {

/// What effects that a machine does not have would do to the readings of sites.
struct EffectSignatures {
  std::vector<std::string> effects;  ///< "joint at motor to column_front"
  models::Signatures signatures;     ///< pairs: those that a sensor at every candidate would tell apart
  std::size_t alike = 0;             ///< pairs that even all candidates take for each other (confusable_cosine)
};

/// Every heat effect of the catalogue at every place that the machine has for it (Hypothesis), each for itself at a
/// tenth of its largest plausible amplitude: the rise of every site with it less the rise without it, over the
/// experiments of the options. The first `candidates` of the sites decide what is to be told apart; effects that warm
/// none of these by 1 mK stay out, and those that act on instruments.
[[nodiscard]] EffectSignatures effect_signatures(Value const& document, std::vector<CandidateSite> const& sites,
                                                 Eigen::Index candidates, EnsembleOptions const& options);

}  // namespace thermotwin::twin
