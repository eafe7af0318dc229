#include "twin/diagnosis/plan.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

#include "twin/diagnosis/expected_noise.h"
#include "twin/diagnosis/run_files.h"
#include "twin/diagnosis/score.h"
#include "twin/diagnosis/separation.h"

namespace thermotwin::twin {
namespace {

/// The clearest shape of each effect at each site.
std::vector<Plan::Effect> clearest(std::vector<Hypothesis> const& all, Eigen::MatrixXd const& products,
                                   Eigen::VectorXd const& whole, std::vector<Eigen::Index>& columns) {
  std::map<std::string, Eigen::Index> best;
  for (std::size_t k = 0; k < all.size(); ++k) {
    auto const [it, fresh] = best.emplace(all[k].label(), Eigen::Index(k));
    if (!fresh && products(Eigen::Index(k), Eigen::Index(k)) > products(it->second, it->second))
      it->second = Eigen::Index(k);
  }
  std::vector<std::pair<double, Eigen::Index>> order;
  for (auto const& [label, k] : best) order.emplace_back(seen(products, k, usual_amplitude), k);
  std::stable_sort(order.begin(), order.end(), [](auto const& a, auto const& b) { return a.first > b.first; });
  std::vector<Plan::Effect> effects;
  for (auto const& [distance, k] : order) {
    double const kept = whole[k] > 0.0 ? std::sqrt(std::max(0.0, products(k, k)) / whole[k]) : 0.0;
    effects.push_back({all[std::size_t(k)], distance, kept});
    columns.push_back(k);
  }
  return effects;
}

/// Per pair of effects, the sites at which the first is seen and least apart from the second.
std::vector<Plan::Ambiguity> ambiguities(std::vector<Plan::Effect> const& effects, Eigen::MatrixXd const& products,
                                         std::vector<Eigen::Index> const& columns) {
  std::map<std::pair<std::string, std::string>, Plan::Ambiguity> worst;
  for (std::size_t i = 0; i < effects.size() && effects[i].seen >= wanted_distance; ++i)
    for (std::size_t j = 0; j < effects.size(); ++j) {
      auto const &one = *effects[i].hypothesis.effect, &other = *effects[j].hypothesis.effect;
      if (one.name == other.name) continue;
      double const distance = apart(products, columns[i], columns[j], usual_amplitude);
      double const needed = usual_amplitude * products(columns[i], columns[j]) / products(columns[j], columns[j]);
      bool const plausible = std::abs(needed) <= 1.0 && (needed > 0.0 || effects[j].hypothesis.trial->either_sign);
      if (distance >= wanted_distance || !plausible) continue;
      auto const key = std::minmax(one.name, other.name);
      Plan::Ambiguity const ambiguity{i, j, cosine(products, columns[i], columns[j]), distance, {}};
      auto const [it, fresh] = worst.emplace(key, ambiguity);
      if (!fresh && distance < it->second.distance) it->second = ambiguity;
    }
  std::vector<Plan::Ambiguity> result;
  for (auto const& [names, ambiguity] : worst) result.push_back(ambiguity);
  std::stable_sort(result.begin(), result.end(), [](auto const& a, auto const& b) { return a.distance < b.distance; });
  return result;
}

}  // namespace

Plan plan(Value const& document, std::vector<Schedule> const& schedules, PlanOptions const& options) {
  auto const say = [&](std::string const& what) {
    if (options.progress) options.progress(what);
  };
  Machine const machine = Machine::build(document);
  Plan plan;
  std::vector<MeasuredRun> simulated;
  say("simulating the planned experiments");
  for (auto const& schedule : schedules) {
    simulated.push_back(simulated_run(machine, schedule));
    plan.schedules.push_back(schedule.name());
    plan.hours += schedule.hours();
  }
  auto const runs = binned(simulated);
  auto const all = hypotheses(document, machine, options.without);
  say(fmt::format("what they would show of {} shapes of effects at their sites", all.size()));
  Estimation const estimation = expected_estimation(document, runs);
  Fit const fit = estimation.fit(estimation.prior_mean(), 0);
  Eigen::MatrixXd columns = signatures(estimation, fit, all);
  estimation.whiten(columns);
  Eigen::VectorXd const whole = columns.colwise().squaredNorm();
  Separation const separation(estimation, fit, columns);
  Eigen::MatrixXd const products = separation.products(
      {std::vector<bool>(runs.size(), true), std::vector<bool>(estimation.channels().size(), true)});
  std::vector<Eigen::Index> chosen;
  plan.effects = clearest(all, products, whole, chosen);
  plan.ambiguities = ambiguities(plan.effects, products, chosen);
  std::vector<Rivals> rivals;
  for (std::size_t a = 0; a < std::min(options.with_remedies, plan.ambiguities.size()); ++a)
    rivals.push_back(
        {{plan.effects[plan.ambiguities[a].effect].hypothesis, plan.effects[plan.ambiguities[a].rival].hypothesis},
         {usual_amplitude, usual_amplitude}});
  if (rivals.empty()) return plan;
  say(fmt::format("what would tell the worst {} apart", rivals.size()));
  auto found = remedies(document, runs, rivals);
  for (std::size_t a = 0; a < found.size(); ++a) plan.ambiguities[a].remedies = std::move(found[a]);
  return plan;
}

}  // namespace thermotwin::twin
