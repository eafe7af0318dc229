#pragma once

#include <string>
#include <vector>

#include "thermal/geometry.h"
#include "twin/diagnosis/hypothesis.h"

namespace thermotwin::twin {

/// Standard error of an estimate, from the one that the fit states: 1.2 of that, and a tenth of the estimate, which is
/// what a machine of some ten nodes gets wrong by its form, however clear the data are (docs/diagnosis_record.md).
[[nodiscard]] double whole_error(double of_fit, double estimate);

/// Whether an amplitude, in units of its largest, is as much as is plausible: the fit would have more.
[[nodiscard]] bool is_at_end(double of_largest);

/// An effect at a site as fitted.
struct Finding {
  Hypothesis hypothesis;
  double amplitude = 0.0;       ///< [SI]
  double standard_error = 0.0;  ///< [SI]
  /// A film on a lump, as strong as what the lump itself conducts or nearly so: what was fitted is both, one behind the
  /// other, and the film alone may be anything above.
  bool at_least = false;
  double strength = 0.0;  ///< 2 ln of the evidence against a machine without it
  double weight = 0.0;    ///< among its alternatives

  /// Takes an amplitude of the fit and its standard error there, in units of its largest. Beyond a Biot number h L/k of
  /// 0.1, with L = V^(1/3)/6 as of a cube and k = 20 W/(m K) as of a body of several parts, a lump is none (Incropera,
  /// Fundamentals of Heat and Mass Transfer, 5.2).
  void take(double of_largest, double error, thermal::Geometry const& geometry);

  /// Ends of the 95 % interval [SI].
  [[nodiscard]] double low() const;
  [[nodiscard]] double high() const;
  [[nodiscard]] bool is_at_end() const;
  /// Less than its standard error, of a fault of an instrument than its 95 % interval, or no more than the best of
  /// machines may have.
  [[nodiscard]] bool is_negligible() const;
  /// "± 10 W/(m2 K)"; without an upper end "or more, at least 170 W/(m2 K)"; at the end of what is plausible with a
  /// word that it is.
  [[nodiscard]] std::string interval_text(std::string const& unit) const;
};

/// One thing that is missing: one effect, or several that the data cannot tell apart. The first is the one that was
/// fitted, the others are the likeliest first.
struct Explanation {
  std::vector<Finding> alternatives;

  /// One more place of an effect. Its weight against the first, exp of half of what their strengths differ by and no
  /// more than 1, goes to the name: the most evident place, to be added first, speaks for it. What they differ by is
  /// divided by 1 + 0.02² S, S the first's strength, for no signature is known to better than 2 %; and by `too_large`,
  /// how many times too large their 2 ln are taken to be.
  void add(Finding const& finding, double too_large);
  /// Weights add up to 1, and no more names are kept than hold what is missing with a probability of 95 %; three at
  /// most.
  void keep_the_likely();
};

}  // namespace thermotwin::twin
