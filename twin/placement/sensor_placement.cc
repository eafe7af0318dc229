#include "twin/placement/sensor_placement.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <set>
#include <stdexcept>

#include "models/placement.h"
#include "models/placement_bound.h"
#include "models/quantile.h"
#include "thermal/error.h"
#include "thermal/nearest_name.h"
#include "twin/assembly.h"
#include "twin/file/document.h"
#include "twin/machine.h"
#include "twin/placement/effect_signatures.h"
#include "twin/placement/snapshot_moments.h"
#include "twin/turning_bodies.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;
using thermal::InputError;
using Sites = std::vector<Index>;

constexpr double idle_share = 0.01;      // of the error: what the loss of an idle sensor adds at most
constexpr double most_sets = 1e6;        // that are all looked at
constexpr double most_angles = 2e7;      // likewise, of sets that shall tell effects apart
constexpr int first_unseen = 1'000'000;  // members of the design have smaller numbers

/// Every site has room for `dead` spares.
void check_room(PlacementOptions const& options, std::size_t sites) {
  auto const each = std::size_t(options.dead) + 1;
  if (std::size_t(options.sensors) <= sites * each) return;
  throw InputError(fmt::format("{} sensors, but only {} candidate sites{}", options.sensors, sites,
                               each > 1 ? fmt::format(" with room for {} each", each) : ""));
}

void check(PlacementOptions const& options, std::size_t sites) {
  if (options.sensors < 1) throw InputError(fmt::format("{} sensors; at least 1 is due", options.sensors));
  if (options.dead < 0) throw InputError(fmt::format("{} dead sensors; 0 or more are due", options.dead));
  if (options.dead >= options.sensors)
    throw InputError(fmt::format("{} of {} sensors dead; at least one must be left", options.dead, options.sensors));
  check_room(options, sites);
  if (options.dead > 0 && options.distinguish)
    throw InputError("sensors are chosen either to outlive dead ones or to tell effects apart, not for both");
  if (!(options.noise > 0.0)) throw InputError(fmt::format("the noise is {} K; it must be positive", options.noise));
  if (options.design.members < 2)
    throw InputError(fmt::format("{} members; at least 2 are due", options.design.members));
  if (options.unseen_members < 1)
    throw InputError(fmt::format("{} unseen members; at least 1 is due", options.unseen_members));
}

/// Sites that a user proposes, by name: a candidate's, a sensor's of the machine, or a place.
class Proposal {
 public:
  Proposal(Value const& document, CandidateRules const& rules, std::vector<CandidateSite>& sites)
      : rules_(rules), sites_(sites), tables_(document) {
    Value copy = document;
    for (auto const* table : tables_of(copy, "temperature_sensor")) {
      auto& sensor = sensors_.emplace_back(CandidateSite{name_in(*table), texts_of(*table, "at")});
      if (auto const* shares = table->find("shares"); shares && shares->is_list())
        sensor.shares = std::get<Value::List>(shares->content);
    }
  }

  /// The sites of these names; those that are not among the sites are appended.
  [[nodiscard]] Sites operator()(std::vector<std::string> const& names) {
    Sites proposed;
    for (auto const& name : names) {
      auto const site = index_of(name);
      if (std::find(proposed.begin(), proposed.end(), site) != proposed.end())
        throw InputError(fmt::format("'{}' is proposed twice", name));
      proposed.push_back(site);
    }
    return proposed;
  }

 private:
  [[nodiscard]] Index index_of(std::string const& name) {
    for (std::size_t i = 0; i < sites_.size(); ++i)
      if (sites_[i].name == name) return Index(i);
    sites_.push_back(site_of(name));
    sites_.back().cost = cost_at(sites_.back().at, rules_);
    return Index(sites_.size()) - 1;
  }
  [[nodiscard]] CandidateSite site_of(std::string const& name) const {
    for (auto const& sensor : sensors_)
      if (sensor.name == name) return sensor;
    if (bodies_.all().contains(body_of(name))) {
      check_place(name, bodies_);
      return {name, {name}};
    }
    auto known = bodies_.order();
    for (auto const& sensor : sensors_) known.push_back(sensor.name);
    for (auto const& site : sites_)
      if (std::find(known.begin(), known.end(), site.name) == known.end()) known.push_back(site.name);
    throw InputError(
        fmt::format("there is no site, sensor or body '{}'; {}", name, thermal::did_you_mean(name, known)));
  }

  CandidateRules const& rules_;
  std::vector<CandidateSite>& sites_;
  std::vector<CandidateSite> sensors_;
  Tables tables_;
  Bodies bodies_{tables_};
};

double quantile(Eigen::VectorXd values, double share) {
  std::sort(values.begin(), values.end());
  return models::quantile({values.data(), std::size_t(values.size())}, share);
}

Sites without(Sites sites, Index site) {
  std::erase(sites, site);
  return sites;
}

/// Nodes of some bodies.
std::vector<Index> nodes_of(thermal::Geometry const& geometry, std::set<std::string> const& bodies) {
  std::vector<Index> nodes;
  for (auto const& body : geometry)
    if (bodies.contains(body.name))
      for (std::size_t cell = 0; cell < body.cells.size(); ++cell) nodes.push_back(body.first_node + Index(cell));
  return nodes;
}

/// Rows of an ensemble, less their mean.
struct Snapshots {
  Eigen::MatrixXd rise, displacements;
  Snapshots(Ensemble const& ensemble, Rows const& rows)
      : rise(ensemble.rise.middleRows(rows.first, rows.count)),
        displacements(ensemble.displacement.middleRows(rows.first, rows.count)) {
    rise.rowwise() -= rise.colwise().mean().eval();
    displacements.rowwise() -= displacements.colwise().mean().eval();
  }
};

/// Judges sets with one design and one unseen ensemble.
class Judge {
 public:
  Judge(Value const& document, PlacementOptions const& options);

  [[nodiscard]] PlacementReport operator()();

 private:
  [[nodiscard]] SetFigures figures(Sites const& set) const;
  /// Those without which all others are worse by less than 1 % together; the least useful goes first.
  [[nodiscard]] std::set<Index> idle_among(Sites set) const;
  [[nodiscard]] models::Placement best(Index count, Index dead) const;
  /// The same places, where no spare stands beside a sensor that is not there.
  [[nodiscard]] Sites spares_last(Sites const& set) const;
  [[nodiscard]] Proposed proposed() const;
  [[nodiscard]] InformationMap map(Sites const& set) const;
  [[nodiscard]] std::optional<double> widest_angle(models::Signatures const& signatures, Index count) const;
  [[nodiscard]] Sites widest_set(models::Signatures const& signatures, Index count) const;
  /// Those without which the smallest angle is narrower by less than 1 %; the least useful goes first.
  [[nodiscard]] std::vector<std::string> widening_nothing(models::Signatures const& signatures, Sites set) const;
  /// Fills in what the signatures say; returns the set that tells effects apart.
  [[nodiscard]] Sites distinguishing(Distinction& distinction, Sites const& for_displacement) const;
  [[nodiscard]] bool all_looked_at(Index count) const {
    return models::number_of_sets(candidates_, count, prices_) <= most_angles;
  }
  [[nodiscard]] EnsembleOptions unseen_options() const;
  [[nodiscard]] std::vector<std::string> remarks(PlacementReport const& report) const;

  Value const& document_;
  PlacementOptions const& options_;
  std::vector<CandidateSite> sites_;
  Index places_;          ///< the first of the sites: candidates without spares
  Index candidates_ = 0;  ///< with spares; proposed sites follow
  Sites proposed_;
  std::string machine_;
  std::vector<Eigen::Vector3d> positions_;
  std::vector<Index> barred_nodes_;  ///< of bodies on which no sensor may sit
  Ensemble design_, unseen_;
  std::optional<SnapshotMoments> moments_;
  models::PlacementProblem problem_;  ///< of the candidates
  models::PlacementProblem all_;      ///< of the proposed sites as well
  models::Prices prices_;             ///< of the candidates
};

Judge::Judge(Value const& document, PlacementOptions const& options)
    : document_(document),
      options_(options),
      sites_(candidate_sites(document, options.rules)),
      places_(Index(sites_.size())) {
  check(options, sites_.size());
  sites_ = with_spares(sites_, options.dead);
  candidates_ = Index(sites_.size());
  proposed_ = Proposal(document, options.rules, sites_)(options.proposed);
  Machine const machine = Machine::build(with_sensors_at(document, sites_));
  machine_ = machine.name;
  for (std::size_t s = machine.sensors.size() - sites_.size(); s < machine.sensors.size(); ++s)
    positions_.push_back(machine.sensors[s].position);
  barred_nodes_ = nodes_of(machine.geometry, bodies_without_candidates(document, options.rules));
  EnsembleOptions design = options.design;
  design.every_node = options.map;
  double const share = double(design.members) / (design.members + options.unseen_members);
  if (options.design.progress) design.progress = [&, share](double done) { options_.design.progress(share * done); };
  design_ = draw_ensemble(document, sites_, design);
  auto unseen = unseen_options();
  if (options.design.progress)
    unseen.progress = [&, share](double done) { options_.design.progress(share + (1.0 - share) * done); };
  unseen_ = draw_ensemble(document, sites_, unseen);
  moments_.emplace(design_, options.noise, options.teacher);
  problem_ = moments_->problem(candidates_);
  problem_.budget = options.rules.budget;
  problem_.cost.resize(candidates_);
  for (Index i = 0; i < candidates_; ++i) problem_.cost[i] = sites_[std::size_t(i)].cost;
  all_ = moments_->problem(Index(sites_.size()));
  prices_ = {problem_.cost, problem_.budget};
  if (!(problem_.prior() > 0.0))
    throw InputError(
        "none of the machine's displacements moves: no step of its structural loop has a weight, and no sensor could "
        "explain one");
}

EnsembleOptions Judge::unseen_options() const {
  EnsembleOptions unseen = options_.design;
  unseen.members = options_.unseen_members;
  unseen.first_member = first_unseen;
  unseen.experiments = options_.unseen;
  unseen.every_node = false;
  return unseen;
}

models::Placement Judge::best(Index count, Index dead) const {
  if (dead == 0 && models::number_of_sets(candidates_, count, prices_) <= most_sets)
    return models::exhaustive_placement(problem_, count);
  auto placement = models::place(problem_, count, dead);
  placement.sensors = spares_last(placement.sensors);
  return placement;
}

Sites Judge::spares_last(Sites const& set) const {
  Sites named;
  for (auto site : set) {
    for (site %= places_; std::find(named.begin(), named.end(), site) != named.end();) site += places_;
    named.push_back(site);
  }
  return named;
}

std::set<Index> Judge::idle_among(Sites set) const {
  double const limit = std::pow(1.0 + idle_share, 2) * models::remaining_variance(all_, set);
  std::set<Index> idle;
  while (set.size() > 1) {
    auto const least = std::min_element(set.rbegin(), set.rend(), [&](Index a, Index b) {
      return models::remaining_variance(all_, without(set, a)) < models::remaining_variance(all_, without(set, b));
    });
    auto const site = *least;
    if (models::remaining_variance(all_, without(set, site)) > limit) break;
    idle.insert(site);
    set = without(set, site);
  }
  return idle;
}

SetFigures Judge::figures(Sites const& set) const {
  SetFigures result;
  auto const ordered = models::by_information(all_, set);
  double const variance = models::remaining_variance(all_, ordered);
  auto const idle = idle_among(ordered);
  for (auto const site : ordered) {
    auto const& described = sites_[std::size_t(site)];
    double const left = std::sqrt(models::remaining_variance(all_, without(ordered, site)));
    result.sensors.push_back({described, positions_[std::size_t(site)], left, idle.contains(site)});
    result.cost += described.cost;
  }
  auto const predicted = moments_->cross_validated(ordered);
  auto const seen = moments_->unseen(unseen_, ordered);
  result.model_um = std::sqrt(variance);
  result.predicted_um = std::sqrt(predicted.mean_square.sum());
  result.unseen_um = std::sqrt(seen.mean_square.sum());
  result.unseen_low_um = std::sqrt(quantile(seen.of_members, 0.1));
  result.unseen_high_um = std::sqrt(quantile(seen.of_members, 0.9));
  result.worst_um = std::sqrt(models::worst_variance(all_, ordered, options_.dead));
  Eigen::VectorXd prior = Eigen::VectorXd::Zero(design_.displacement.cols());
  for (auto const& rows : moments_->groups())
    prior += Snapshots(design_, rows).displacements.colwise().squaredNorm() / double(design_.rise.rows());
  for (Index c = 0; c < prior.size(); ++c)
    result.channels.push_back({design_.channels[std::size_t(c)], std::sqrt(prior[c]),
                               std::sqrt(predicted.mean_square[c]), std::sqrt(seen.mean_square[c])});
  return result;
}

Proposed Judge::proposed() const {
  auto const variance = [&](Sites const& set) { return models::remaining_variance(all_, set); };
  Proposed result{figures(proposed_), {}, {}, {}, {}};
  Sites fewer, more;
  for (auto const site : proposed_) {
    auto const rest = without(proposed_, site);
    if (rest.empty() || (!fewer.empty() && variance(rest) >= variance(fewer))) continue;
    fewer = rest;
    result.without = sites_[std::size_t(site)].name;
  }
  for (Index site = 0; site < places_; ++site) {
    if (std::find(proposed_.begin(), proposed_.end(), site) != proposed_.end()) continue;
    auto beside = proposed_;
    beside.push_back(site);
    if (!more.empty() && variance(beside) >= variance(more)) continue;
    more = beside;
    result.with = sites_[std::size_t(site)].name;
  }
  if (!fewer.empty()) result.fewer = figures(fewer);
  if (!more.empty()) result.more = figures(more);
  return result;
}

/// As RemainingVariance does it, with every node as one more site.
InformationMap Judge::map(Sites const& set) const {
  Index const nodes = design_.node_rise.cols();
  Eigen::VectorXd alone = Eigen::VectorXd::Zero(nodes), beside = alone;
  for (auto const& rows : moments_->groups()) {
    Snapshots const seen(design_, rows);
    auto const& y = seen.displacements;
    Eigen::MatrixXd const chosen = seen.rise(Eigen::all, set);
    Eigen::MatrixXd readings = chosen.transpose() * chosen / double(rows.count);
    readings.diagonal().array() += moments_->noise_variance();
    auto const factor = readings.llt();
    Eigen::MatrixXd const told = factor.solve(chosen.transpose() * y / double(rows.count));
    for (Index node = 0; node < nodes; ++node) {
      Eigen::VectorXd x = design_.node_rise.col(node).segment(rows.first, rows.count).cast<double>();
      x.array() -= x.mean();
      Eigen::RowVectorXd const cross = x.transpose() * y / double(rows.count);
      Eigen::VectorXd const shared = chosen.transpose() * x / double(rows.count);
      double const variance = x.squaredNorm() / double(rows.count);
      alone[node] += cross.squaredNorm() / (variance + moments_->noise_variance());
      double const rest = std::max(0.0, variance - shared.dot(factor.solve(shared)));
      beside[node] += (cross - shared.transpose() * told).squaredNorm() / (rest + moments_->noise_variance());
    }
  }
  auto const lessened = [&](double variance, Eigen::VectorXd const& gains) {
    auto const left = (variance - gains.array() / double(moments_->groups().size())).cwiseMax(0.0);
    Eigen::VectorXd less = std::sqrt(variance) - left.sqrt();
    less(barred_nodes_).setConstant(std::nan(""));
    return less;
  };
  return {lessened(all_.prior(), alone), lessened(models::remaining_variance(all_, set), beside)};
}

Sites Judge::widest_set(models::Signatures const& signatures, Index count) const {
  return all_looked_at(count) ? models::widest_of_all_sets(signatures, count, prices_)
                              : models::place_to_distinguish(signatures, count, prices_);
}

/// None for a number of sensors that cannot be, or that the budget does not buy.
std::optional<double> Judge::widest_angle(models::Signatures const& signatures, Index count) const {
  if (count < 1 || count > candidates_) return std::nullopt;
  auto const set = widest_set(signatures, count);
  if (Index(set.size()) < count) return std::nullopt;
  return models::closest_pair(signatures, set).angle;
}

std::vector<std::string> Judge::widening_nothing(models::Signatures const& signatures, Sites set) const {
  auto const angle = [&](Sites const& of) { return models::closest_pair(signatures, of).angle; };
  double const limit = (1.0 - idle_share) * angle(set);
  std::vector<std::string> idle;
  while (set.size() > 1) {
    auto const least = *std::max_element(
        set.begin(), set.end(), [&](Index a, Index b) { return angle(without(set, a)) < angle(without(set, b)); });
    if (angle(without(set, least)) < limit) break;
    idle.push_back(sites_[std::size_t(least)].name);
    set = without(set, least);
  }
  return idle;
}

Sites Judge::distinguishing(Distinction& distinction, Sites const& for_displacement) const {
  auto const found = effect_signatures(document_, sites_, candidates_, options_.design);
  auto signatures = found.signatures;
  signatures.gram.resize(std::size_t(candidates_));
  auto const set = widest_set(signatures, options_.sensors);
  auto const count = Index(set.size());  // a budget may end first
  auto const closest = models::closest_pair(signatures, set);
  auto const [first, second] = signatures.pairs[closest.pair];
  Sites every(static_cast<std::size_t>(places_));
  std::iota(every.begin(), every.end(), Index(0));
  distinction = {found.effects.size(),
                 signatures.pairs.size(),
                 found.alike,
                 closest.angle,
                 models::closest_pair(signatures, every).angle,
                 models::closest_pair(signatures, for_displacement).angle,
                 widest_angle(signatures, count - 1),
                 widest_angle(signatures, count + 1),
                 {},
                 found.effects[std::size_t(first)],
                 found.effects[std::size_t(second)],
                 widening_nothing(signatures, set),
                 all_looked_at(options_.sensors)};
  if (!proposed_.empty()) distinction.proposed = models::closest_pair(found.signatures, proposed_).angle;
  return set;
}

PlacementReport Judge::operator()() {
  PlacementReport report;
  report.machine = machine_;
  for (auto const& table : Tables(document_).of("temperature_sensor")) report.taken.insert(name_in(table));
  report.candidates = std::size_t(places_);
  report.members = options_.design.members;
  report.unseen_members = options_.unseen_members;
  report.numbers = design_.numbers;
  report.ranged = design_.ranged;
  report.dead = options_.dead;
  report.teacher = options_.teacher;
  report.noise = options_.noise;
  for (auto const& run : design_.runs)
    if (run.member == 0) report.experiments.push_back(run.experiment);
  for (auto const& run : unseen_.runs)
    if (run.member == 0) report.unseen_experiments.push_back(run.experiment);
  report.prior_um = std::sqrt(problem_.prior());
  Sites every(static_cast<std::size_t>(places_));
  std::iota(every.begin(), every.end(), Index(0));
  report.floor_um = std::sqrt(models::remaining_variance(problem_, every));

  Index const count = options_.sensors, dead = options_.dead;
  auto chosen = best(count, dead);
  report.proved = dead == 0 && models::number_of_sets(candidates_, count, prices_) <= most_sets;
  report.bound_um = report.proved ? std::sqrt(chosen.variance) : std::sqrt(models::placement_bound(problem_, count));
  if (options_.distinguish) {
    chosen.sensors = distinguishing(report.distinction.emplace(), chosen.sensors);
    report.proved = false;  // what was proved is another set
  }
  report.recommended = figures(chosen.sensors);
  auto const room = Index(chosen.sensors.size());  // a budget may end first
  if (room > 1) report.fewer = figures(best(room - 1, std::min(dead, room - 2)).sensors);
  if (room == count && count < candidates_)
    if (auto const more = best(count + 1, dead).sensors; Index(more.size()) > count) report.more = figures(more);
  if (!proposed_.empty()) report.proposed = proposed();
  if (options_.map) report.map = map(chosen.sensors);
  report.remarks = remarks(report);
  return report;
}

std::vector<std::string> Judge::remarks(PlacementReport const& report) const {
  std::vector<std::string> words;
  auto const& rules = options_.rules;
  auto const& chosen = report.recommended.sensors;
  if (int(chosen.size()) < options_.sensors && std::isfinite(rules.budget))
    words.push_back(fmt::format("{} were asked for; the budget of {:g} has room for no better set than these {}",
                                options_.sensors, rules.budget, chosen.size()));
  else if (int(chosen.size()) < options_.sensors)
    words.push_back(fmt::format("{} were asked for; beside {}, no other site tells anything more", options_.sensors,
                                chosen.size() == 1 ? "this one" : fmt::format("these {}", chosen.size())));
  if (report.distinction && !report.distinction->idle.empty())
    words.push_back(fmt::format("without {} the smallest angle is less than {:g} % narrower",
                                fmt::join(report.distinction->idle, " and "), 100.0 * idle_share));
  auto const idle = std::count_if(chosen.begin(), chosen.end(), [](auto const& sensor) { return sensor.idle; });
  if (idle > 0 && options_.dead == 0 && !options_.distinguish)  // those sets need theirs: as spares, for the effects
    words.push_back(
        fmt::format("{} would do: without {} the error is less than {:g} % larger", chosen.size() - std::size_t(idle),
                    idle == 1 ? "the idle one" : fmt::format("the {} idle ones", idle), 100.0 * idle_share));
  auto const turning = turning_bodies(document_);
  auto const about = [&](SetFigures const& set, std::string const& which) {
    std::set<std::string> turn, forbidden;
    for (auto const& sensor : set.sensors)
      for (auto const& at : sensor.site.at) {
        auto const body = body_of(at);
        if (std::find(turning.begin(), turning.end(), body) != turning.end()) turn.insert(body);
        if (std::find(rules.forbidden.begin(), rules.forbidden.end(), body) != rules.forbidden.end())
          forbidden.insert(body);
      }
    if (!turn.empty())
      words.push_back(
          fmt::format("the {} set sits on what turns: {}; its signals need a way out", which, fmt::join(turn, ", ")));
    if (!forbidden.empty())
      words.push_back(fmt::format("the {} set sits on what is forbidden: {}", which, fmt::join(forbidden, ", ")));
    if (set.cost > rules.budget)
      words.push_back(
          fmt::format("the {} set costs {:g}, more than the budget of {:g}", which, set.cost, rules.budget));
  };
  about(report.recommended, "recommended");
  if (report.proposed) about(report.proposed->set, "proposed");
  return words;
}

}  // namespace

PlacementReport place_sensors(Value const& document, PlacementOptions const& options) {
  try {
    return Judge(document, options)();
  } catch (std::invalid_argument const& error) {
    throw InputError(error.what());
  }
}

}  // namespace thermotwin::twin
