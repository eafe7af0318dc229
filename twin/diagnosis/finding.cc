#include "twin/diagnosis/finding.h"

#include <algorithm>
#include <cmath>

#include "twin/diagnosis/estimate_text.h"

namespace thermotwin::twin {
namespace {

constexpr double credible = 0.95;
constexpr std::size_t most_alternatives = 3;
constexpr double error_of_form = 0.02;  // of a signature
constexpr double lump_limit = 0.1;      // Biot number
constexpr double conductivity = 20.0;   // of a body of several parts [W/(m K)]

/// h at the Biot number up to which a body is a lump [W/(m² K)]; without end for one that is cut into cells.
double strongest_film(std::string const& body, thermal::Geometry const& geometry) {
  auto const found = std::find_if(geometry.begin(), geometry.end(), [&](auto const& b) { return b.name == body; });
  if (found == geometry.end() || found->cells.size() != 1) return INFINITY;
  return lump_limit * conductivity / (std::cbrt(thermal::volume(found->cells[0])) / 6.0);
}

/// How many times too large 2 ln of one name against another is where both explain about that much: a signature s,
/// |s|² = strength, is what the machine does but for a share ε, which adds ε² |s|² to the whitened noise's variance of 1
/// along what the two differ by.
double scatter_of(double strength) { return 1.0 + error_of_form * error_of_form * std::max(0.0, strength); }

}  // namespace

bool is_at_end(double of_largest) { return std::abs(of_largest) > 0.999 * most_of_largest; }

double whole_error(double of_fit, double estimate) {
  constexpr double fit_share = 1.2, form_share = 0.1;
  return std::hypot(fit_share * of_fit, form_share * estimate);
}

void Finding::take(double of_largest, double error, thermal::Geometry const& geometry) {
  double const unit = hypothesis.largest;
  amplitude = of_largest * unit;
  standard_error = whole_error(error, of_largest) * unit;
  at_least = hypothesis.dimension() == thermal::dimension::film_coefficient &&
             amplitude > strongest_film(hypothesis.body, geometry);
}

double Finding::low() const { return amplitude - two_sided_95 * standard_error; }

double Finding::high() const {
  return at_least ? most_of_largest * hypothesis.largest : amplitude + two_sided_95 * standard_error;
}

bool Finding::is_at_end() const { return twin::is_at_end(amplitude / hypothesis.largest); }

bool Finding::is_negligible() const {
  double const unit = hypothesis.largest, errors = hypothesis.is_about("sensor") ? two_sided_95 : 1.0;
  return std::abs(amplitude) < errors * standard_error ||
         hypothesis.is_ordinary(amplitude / unit, standard_error / unit);
}

std::string Finding::interval_text(std::string const& unit) const {
  if (at_least) return "or more, at least " + written_value(low(), unit, 2);
  return written_interval(standard_error, unit) + (is_at_end() ? ", as much as is plausible here" : "");
}

void Explanation::add(Finding const& finding, double too_large) {
  double const first = alternatives.empty() ? finding.strength : alternatives[0].strength;
  double const weight = std::exp(0.5 * std::min(0.0, finding.strength - first) / (too_large * scatter_of(first)));
  auto const same = std::find_if(alternatives.begin(), alternatives.end(), [&](Finding const& other) {
    return other.hypothesis.effect == finding.hypothesis.effect;
  });
  if (same != alternatives.end()) {
    same->weight += weight;
    return;
  }
  alternatives.push_back(finding);
  alternatives.back().weight = weight;
}

void Explanation::keep_the_likely() {
  std::stable_sort(alternatives.begin() + 1, alternatives.end(),
                   [](Finding const& a, Finding const& b) { return a.weight > b.weight; });
  double sum = 0.0, held = 0.0;
  for (auto const& finding : alternatives) sum += finding.weight;
  std::size_t told = 0;
  while (told < std::min(alternatives.size(), most_alternatives) && held < credible * sum)
    held += alternatives[told++].weight;
  alternatives.resize(told);
  for (auto& finding : alternatives) finding.weight /= held;
}

}  // namespace thermotwin::twin
