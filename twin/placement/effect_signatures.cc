#include "twin/placement/effect_signatures.h"

#include <cmath>
#include <numeric>
#include <optional>
#include <set>

#include "thermal/error.h"
#include "twin/challenge/challenge_runs.h"
#include "twin/diagnosis/hypothesis.h"
#include "twin/diagnosis/separation.h"
#include "twin/parallel.h"
#include "twin/run.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;

constexpr double share_of_largest = 0.1, least_rise = 1e-3;  // of an amplitude; [K]
constexpr double tolerance = 1e-6;                           // differences of runs are small

/// One hypothesis per effect and place: shapes of one effect are not told apart.
std::vector<Hypothesis> heat_effects(Value const& document, Machine const& machine) {
  std::vector<Hypothesis> kept;
  std::set<std::string> labels;
  for (auto& hypothesis : hypotheses(document, machine)) {
    bool of_instrument = false;
    for (auto const& site : hypothesis.trial->sites)
      of_instrument = of_instrument || site.kind == "sensor" || site.kind == "displacement";
    if (!of_instrument && labels.insert(hypothesis.label()).second) kept.push_back(std::move(hypothesis));
  }
  return kept;
}

/// Readings of the candidate sites in all runs, one below the other.
class SiteCourses {
 public:
  SiteCourses(Machine const& nominal, std::size_t sites, EnsembleOptions const& options)
      : sites_(sites), stop_(options.stop), experiments_(options.experiments) {
    if (experiments_.empty()) experiments_ = {challenge_runs(nominal.limits, options.seed)[1]};
    for (auto& experiment : experiments_) experiment.sampling = experiment.duration / options.snapshots;
  }

  [[nodiscard]] Eigen::MatrixXd operator()(Machine const& machine) const {
    RunOptions options;
    options.integration.relative_tolerance = options.integration.absolute_tolerance = tolerance;
    options.stop = stop_;
    Eigen::MatrixXd all(0, Index(sites_));
    for (auto const& experiment : experiments_) {
      auto const data = run(machine, experiment, options).dataset;
      Index const before = all.rows();
      all.conservativeResize(before + data.time_s.size(), all.cols());
      for (std::size_t s = 0; s < sites_; ++s)
        all.col(Index(s)).tail(data.time_s.size()) =
            data.truth_readings[data.truth_readings.size() - sites_ + s].values;
    }
    return all;
  }

 private:
  std::size_t sites_;
  std::atomic<bool> const* stop_;
  std::vector<scenarios::Experiment> experiments_;
};

/// Courses of all effects at each site become Gram matrices.
models::Signatures gram_matrices(std::vector<Eigen::MatrixXd> const& courses) {
  models::Signatures signatures;
  for (Index site = 0; site < courses.front().cols(); ++site) {
    Eigen::MatrixXd at_site(courses.front().rows(), Index(courses.size()));
    for (std::size_t e = 0; e < courses.size(); ++e) at_site.col(Index(e)) = courses[e].col(site);
    signatures.gram.emplace_back(at_site.transpose() * at_site);
  }
  return signatures;
}

std::size_t keep_pairs_apart(models::Signatures& signatures, Index effects, Index candidates) {
  for (Index a = 0; a < effects; ++a)
    for (Index b = a + 1; b < effects; ++b) signatures.pairs.emplace_back(a, b);
  std::vector<Index> every(static_cast<std::size_t>(candidates));
  std::iota(every.begin(), every.end(), Index(0));
  auto const apart = models::angles(signatures, every);
  std::vector<std::pair<Index, Index>> kept;
  for (std::size_t p = 0; p < signatures.pairs.size(); ++p)
    if (std::cos(apart[Index(p)]) <= confusable_cosine) kept.push_back(signatures.pairs[p]);
  auto const alike = signatures.pairs.size() - kept.size();
  signatures.pairs = std::move(kept);
  return alike;
}

}  // namespace

EffectSignatures effect_signatures(Value const& document, std::vector<CandidateSite> const& sites, Index candidates,
                                   EnsembleOptions const& options) {
  Value const with_sites = with_sensors_at(document, sites);
  Machine const nominal = Machine::build(with_sites);
  auto const effects = heat_effects(document, nominal);
  SiteCourses const readings(nominal, sites.size(), options);
  Eigen::MatrixXd const without = readings(nominal);
  std::vector<std::optional<Eigen::MatrixXd>> differences(effects.size());
  in_parallel(effects.size(), options.progress, nullptr, [&](std::size_t e) {
    try {
      auto const& effect = effects[e];
      auto const changed = with_hypothesis(with_sites, effect, "tried", share_of_largest * effect.largest);
      differences[e] = readings(Machine::build(changed)) - without;
    } catch (thermal::InputError const&) {  // it cannot act there
    } catch (thermal::IntegrationError const&) {
    }
  });
  EffectSignatures result;
  std::vector<Eigen::MatrixXd> courses;
  for (std::size_t e = 0; e < effects.size(); ++e) {
    if (!differences[e] || differences[e]->leftCols(candidates).cwiseAbs().maxCoeff() < least_rise) continue;
    result.effects.push_back(effects[e].label());
    courses.push_back(*differences[e] / differences[e]->norm());
  }
  if (courses.size() < 2) throw thermal::InputError("the machine has no two missing effects that its sites would show");
  result.signatures = gram_matrices(courses);
  result.alike = keep_pairs_apart(result.signatures, Index(courses.size()), candidates);
  if (result.signatures.pairs.empty())
    throw thermal::InputError("no two missing effects are told apart, not even by a sensor at every site");
  return result;
}

}  // namespace thermotwin::twin
