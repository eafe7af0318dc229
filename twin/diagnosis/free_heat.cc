#include "twin/diagnosis/free_heat.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "models/log_determinant.h"
#include "thermal/threaded_product.h"
#include "twin/diagnosis/finding.h"
#include "twin/diagnosis/regimes.h"
#include "twin/diagnosis/warmer_air.h"
#include "twin/parallel.h"

namespace thermotwin::twin {
namespace {

constexpr double first_deviations[] = {3.0, 30.0, 300.0};  // σ_0 [W]
constexpr double of_air = 0.01;                            // of what heat may be [K/W]
constexpr double jump_time = 60.0;                         // in which the heat may jump with an input [s]
constexpr double jump_worth = 4 * 3600.0;                  // as much as it may change otherwise in so long [s]
constexpr double half_a_day = 12 * 3600.0;                 // [s]
constexpr Eigen::Index knots_at_once = 12;                 // whose responses are found together
constexpr double intensities[] = {0.01, 0.1, 0.5, 2.0};

/// At regular times, and two for every jump of the inputs, before and after it: what is switched on jumps as well.
Eigen::VectorXd knots_of(BinnedRun const& run, int count) {
  double const from = run.steps.front().begin, to = run.steps.back().end;
  double const spacing = std::max(half_a_day, to - from) / count;
  std::vector<double> knots = {from};
  auto const fill_until = [&](double end) {
    auto const parts = int(std::ceil((end - knots.back()) / spacing - 0.5));
    double const begin = knots.back();
    for (int p = 1; p < parts; ++p) knots.push_back(begin + (end - begin) * p / parts);
  };
  auto const& course = *run.run->course;
  for (double jump = course.next_jump(from); jump < to - 0.5 * spacing; jump = course.next_jump(jump)) {
    if (jump - knots.back() < 0.5 * spacing) continue;
    fill_until(jump);
    knots.insert(knots.end(), {jump, jump + jump_time});
  }
  fill_until(to);
  knots.push_back(to);
  return Eigen::Map<Eigen::VectorXd>(knots.data(), Eigen::Index(knots.size()));
}

double hat(Eigen::VectorXd const& knots, Eigen::Index k, double t) {
  if (k > 0 && t < knots[k]) return std::max(0.0, (t - knots[k - 1]) / (knots[k] - knots[k - 1]));
  if (k + 1 < knots.size() && t > knots[k]) return std::max(0.0, (knots[k + 1] - t) / (knots[k + 1] - knots[k]));
  return 1.0;
}

/// Of straight lines between knots the integral over time is this, times the values there [s].
Eigen::VectorXd weights_of(Eigen::VectorXd const& knots) {
  auto const n = knots.size() - 1;
  Eigen::VectorXd const steps = knots.tail(n) - knots.head(n);
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(n + 1);
  weights.head(n) += 0.5 * steps;
  weights.tail(n) += 0.5 * steps;
  return weights;
}

/// Where a run's knots begin among those of all runs.
Eigen::Index first_knot(std::vector<Eigen::VectorXd> const& knots, std::size_t run) {
  return std::accumulate(knots.begin(), knots.begin() + std::ptrdiff_t(run), Eigen::Index(0),
                         [](Eigen::Index count, auto const& k) { return count + k.size(); });
}

/// Sites as shares of one watt [K/s]: node × site. The air has none here.
Eigen::MatrixXd shapes_of(Machine const& machine, std::vector<HeatSite> const& sites) {
  auto const& capacity = machine.network().capacity();
  Eigen::MatrixXd shapes = Eigen::MatrixXd::Zero(Eigen::Index(capacity.size()), Eigen::Index(sites.size()));
  for (std::size_t s = 0; s < sites.size(); ++s) {
    double whole = 0.0;
    for (int i = 0; i < sites[s].nodes; ++i) whole += capacity[std::size_t(sites[s].first_node + i)];
    for (int i = 0; i < sites[s].nodes; ++i) shapes(sites[s].first_node + i, Eigen::Index(s)) = 1.0 / whole;
  }
  return shapes;
}

/// Response of a run to the heat at the knots from `first` up to `end`: knot by knot, the sites of each; `air`: the
/// number of its site, or −1.
ReadingByParameter response_to(LinearisedRun const& twin, Eigen::MatrixXd const& shapes, Eigen::Index air,
                               Eigen::VectorXd const& knots, Eigen::Index first, Eigen::Index end) {
  auto const sites = shapes.cols();
  auto const& network = twin.machine().network();
  auto const warmer = warmer_air(network);
  thermal::ParameterColumns const of_air_alone(network, {&warmer});
  thermal::NodeByParameter by_air;
  auto const forcing = [&](thermal::Evaluation& evaluation, double t, auto const& state, auto const& input,
                           thermal::NodeByParameter& into) {
    into.setZero(shapes.rows(), (end - first) * sites);
    bool evaluated = air < 0;  // of the air, once for the two knots between which t lies
    for (Eigen::Index k = first; k < end; ++k) {
      double const share = hat(knots, k, t);
      if (share <= 0.0) continue;
      into.middleCols((k - first) * sites, sites) = share * shapes;
      if (!evaluated) of_air_alone.evaluate(evaluation, state.data(), input.data(), by_air);
      evaluated = true;
      if (air >= 0) into.col((k - first) * sites + air) = share * by_air.col(0);
    }
  };
  auto const& steps = twin.data().steps;
  double const begin = knots[std::max<Eigen::Index>(first - 1, 0)];
  auto const step = std::find_if(steps.begin(), steps.end(), [&](auto const& s) { return s.end > begin; });
  return twin.response(forcing, Eigen::MatrixXd::Zero(shapes.rows(), (end - first) * sites),
                       std::size_t(step - steps.begin()));
}

/// Precision of the random walk through all runs, each with its own start.
Eigen::MatrixXd walk_precision(std::vector<Eigen::VectorXd> const& knots, double first_deviation, double intensity) {
  Eigen::Index size = 0;
  for (auto const& k : knots) size += k.size();
  Eigen::MatrixXd precision = Eigen::MatrixXd::Zero(size, size);
  Eigen::Index at = 0;
  for (auto const& k : knots) {
    precision(at, at) += 1.0 / (first_deviation * first_deviation);
    for (Eigen::Index i = 0; i + 1 < k.size(); ++i) {
      double const step = k[i + 1] - k[i];
      bool const jump = step < 1.5 * jump_time;  // other knots are 7 min apart at least
      double const p = 1.0 / (intensity * intensity * (jump ? jump_worth : step));
      precision(at + i, at + i) += p;
      precision(at + i + 1, at + i + 1) += p;
      precision(at + i, at + i + 1) -= p;
      precision(at + i + 1, at + i) -= p;
    }
    at += k.size();
  }
  return precision;
}

FreeHeat estimate(HeatSite const& site, std::vector<Eigen::VectorXd> const& knots, Eigen::MatrixXd const& information,
                  Eigen::VectorXd const& towards) {
  auto const size = information.rows();
  FreeHeat best{site, -INFINITY, knots, {}, Eigen::MatrixXd::Zero(size, size), {}};
  double const unit = site.is_air() ? of_air : 1.0;
  Eigen::VectorXd heat = Eigen::VectorXd::Zero(size);
  for (double const first_deviation : first_deviations)
    for (double const intensity : intensities) {
      Eigen::MatrixXd const prior = walk_precision(knots, unit * first_deviation, unit * intensity);
      Eigen::LLT<Eigen::MatrixXd> const posterior(information + prior), before(prior);
      Eigen::VectorXd const q = posterior.solve(towards);
      double const gain = q.dot(towards) - models::log_determinant(posterior) + models::log_determinant(before);
      if (!(gain > best.gain)) continue;
      best.gain = gain;
      heat = q;
      best.spread = posterior.matrixU().solve(Eigen::MatrixXd::Identity(size, size));
    }
  Eigen::Index at = 0;
  for (auto const& k : knots) {
    best.heat.emplace_back(heat.segment(at, k.size()));
    at += k.size();
  }
  return best;
}

/// Per run, the whitened response to the heat at every knot of every site: sites one after another.
std::vector<Eigen::MatrixXd> columns_of(Estimation const& estimation, Machine const& machine,
                                        std::vector<HeatSite> const& sites, std::vector<Eigen::VectorXd> const& knots) {
  auto const shapes = shapes_of(machine, sites);
  Eigen::Index const air = sites.back().is_air() ? shapes.cols() - 1 : -1;
  std::vector<std::optional<LinearisedRun>> twins(knots.size());
  std::vector<Eigen::MatrixXd> columns(knots.size());
  in_parallel(knots.size(), [&](std::size_t r) {
    auto const& data = estimation.data()[r];
    twins[r].emplace(machine, data);
    columns[r].resize(data.values.size(), knots[r].size() * shapes.cols());
  });
  struct Part {
    std::size_t run;
    Eigen::Index first, end;
  };
  std::vector<Part> parts;
  for (std::size_t r = 0; r < knots.size(); ++r)
    for (Eigen::Index k = 0; k < knots[r].size(); k += knots_at_once)
      parts.push_back({r, k, std::min(k + knots_at_once, knots[r].size())});
  in_parallel(parts.size(), [&](std::size_t p) {
    auto const& [r, first, end] = parts[p];
    std::vector<Eigen::Index> places;
    for (Eigen::Index k = first; k < end; ++k)
      for (Eigen::Index s = 0; s < shapes.cols(); ++s) places.push_back(s * knots[r].size() + k);
    put_columns(response_to(*twins[r], shapes, air, knots[r], first, end), 1.0, places, columns[r]);
  });
  for (std::size_t r = 0; r < knots.size(); ++r) estimation.whiten(r, columns[r]);
  return columns;
}

Eigen::VectorXd all_runs(std::vector<Eigen::VectorXd> const& courses) {
  Eigen::VectorXd all(0);
  for (auto const& course : courses) {
    all.conservativeResize(all.size() + course.size());
    all.tail(course.size()) = course;
  }
  return all;
}

/// A mean of the heat, by the weights of all knots.
Watts watts(FreeHeat const& heat, Eigen::VectorXd const& weights) {
  double const mean = weights.dot(all_runs(heat.heat));
  return {mean, whole_error((heat.spread.transpose() * weights).norm(), mean)};
}

/// By how much the air of each run differs from its record throughout is an unknown of its own. `nuisance`: what data
/// and priors know of the unknowns but for the walk, `shared` with it.
void add_steady_air(FreeHeat& air, Estimation const& estimation, Eigen::VectorXd const& without_walk,
                    Eigen::LLT<Eigen::MatrixXd> const& nuisance, Eigen::MatrixXd const& shared) {
  Eigen::VectorXd const x = without_walk + nuisance.solve(shared * all_runs(air.heat));
  Eigen::MatrixXd const follows = nuisance.solve(shared * air.spread);
  auto const knots = air.spread.rows(), parts = air.spread.cols(), unknowns = x.size();
  air.spread.conservativeResize(knots, parts + unknowns);
  air.spread.rightCols(unknowns).setZero();
  for (std::size_t u = 0; u < estimation.unknowns().size(); ++u) {
    auto const& unknown = estimation.unknowns()[u];
    if (unknown.kind != Unknown::Kind::air) continue;
    auto const r = std::size_t(unknown.run);
    auto const i = Eigen::Index(u);
    air.heat[r].array() += x[i];
    auto spread = air.spread.middleRows(first_knot(air.knots, r), air.knots[r].size());
    spread.leftCols(parts).rowwise() += follows.row(i);
    spread.rightCols(unknowns).rowwise() +=
        nuisance.matrixL().solve(Eigen::VectorXd::Unit(unknowns, i)).transpose().eval();
  }
}

/// From kelvins of the air to what it brings into the body that takes up most of it.
void tell_in_watts(FreeHeat& air, Machine const& machine, std::vector<BinnedRun> const& data) {
  auto const warmer = warmer_air(machine.network());
  for (auto const& run : data)
    for (auto const& [body, heat] : LinearisedRun(machine, run).more_heat_per_unit(warmer))
      air.per_kelvin[body] += heat.mean() / double(data.size());
  auto const most = std::max_element(air.per_kelvin.begin(), air.per_kelvin.end(),
                                     [](auto const& a, auto const& b) { return a.second < b.second; });
  air.site.body = most->first;
  air.spread *= most->second;
  for (auto& of_run : air.heat) of_run *= most->second;
}

}  // namespace

std::map<std::string, double> FreeHeat::shares() const {
  std::map<std::string, double> shares = {{site.body, 1.0}};
  for (auto const& [body, conductance] : per_kelvin) shares[body] = conductance / per_kelvin.at(site.body);
  return shares;
}

Eigen::VectorXd FreeHeat::standard_error(std::size_t run) const {
  return spread.middleRows(first_knot(knots, run), knots[run].size()).rowwise().norm();
}

Watts FreeHeat::mean_of_all() const {
  std::vector<Eigen::VectorXd> weights;
  for (auto const& k : knots) weights.push_back(weights_of(k));
  Eigen::VectorXd const seconds = all_runs(weights);
  return watts(*this, seconds / seconds.sum());
}

std::vector<HeatSite> heat_sites(Machine const& machine) {
  std::vector<HeatSite> sites;
  for (auto const& body : machine.geometry) {
    int const count = int(body.cells.size());
    int const parts = count >= 9 && count <= 60 ? 3 : 1;
    for (int p = 0; p < parts; ++p) {
      int const from = count * p / parts, to = count * (p + 1) / parts;
      sites.push_back({body.name, body.first_node + from, to - from});
    }
  }
  auto const& warmer = warmer_air(machine.network()).boundary_offset;
  if (std::any_of(warmer.begin(), warmer.end(), [](double offset) { return offset > 0.0; }))
    sites.push_back({"", 0, 0});
  return sites;
}

std::vector<FreeHeat> scan_for_free_heat(Estimation const& estimation, Fit const& fit, int count) {
  Machine const machine = estimation.machine_at(fit.x);
  auto const sites = heat_sites(machine);
  std::vector<Eigen::VectorXd> knots;
  for (auto const& run : estimation.data()) knots.push_back(knots_of(run, count));
  auto const columns = columns_of(estimation, machine, sites, knots);
  Eigen::LLT<Eigen::MatrixXd> const nuisance(fit.information);
  Eigen::VectorXd const explained = nuisance.solve(fit.jacobian.gradient(fit.residual));
  std::vector<Eigen::MatrixXd> shared(knots.size());
  std::vector<Eigen::VectorXd> residual;
  for (std::size_t r = 0; r < knots.size(); ++r) {
    auto const first = estimation.first_row(r), rows = columns[r].rows();
    shared[r] = fit.jacobian.transposed_times(columns[r], first);
    residual.emplace_back(fit.residual.segment(first, rows));
  }
  std::vector<FreeHeat> scan(sites.size());
  in_parallel(sites.size(), [&](std::size_t s) {
    Eigen::Index width = 0;
    for (auto const& k : knots) width += k.size();
    Eigen::MatrixXd own = Eigen::MatrixXd::Zero(width, width), with_unknowns(fit.x.size(), width);
    Eigen::VectorXd towards(width);
    Eigen::Index at = 0;
    for (std::size_t r = 0; r < knots.size(); ++r) {  // heat in one run shows in no other
      auto const count = knots[r].size(), first = Eigen::Index(s) * count;
      Eigen::MatrixXd const response = columns[r].middleCols(first, count);
      own.block(at, at, count, count) = thermal::threaded_square(response);
      with_unknowns.middleCols(at, count) = shared[r].middleCols(first, count);
      towards.segment(at, count) = response.transpose() * residual[r];
      at += count;
    }
    Eigen::MatrixXd const information = own - thermal::threaded_square(nuisance.matrixL().solve(with_unknowns));
    towards -= with_unknowns.transpose() * explained;
    scan[s] = estimate(sites[s], knots, information, towards);
    if (sites[s].is_air()) add_steady_air(scan[s], estimation, fit.x - explained, nuisance, with_unknowns);
  });
  if (scan.back().site.is_air()) tell_in_watts(scan.back(), machine, estimation.data());
  std::stable_sort(scan.begin(), scan.end(), [](auto const& a, auto const& b) { return a.gain > b.gain; });
  return scan;
}

namespace {

/// The machine as it was fitted, but for one of its effects.
Machine lacking(Estimation const& amended, Fit const& fit, std::size_t effect) {
  Eigen::VectorXd x = fit.x;
  x[x.size() - Eigen::Index(amended.effects().size() - effect)] = as_good_as_none;
  return amended.machine_at(x);
}

}  // namespace

std::string warmed_most(Estimation const& amended, Fit const& fit, std::size_t effect) {
  Machine const machine = amended.machine_at(fit.x), without = lacking(amended, fit, effect);
  auto const& network = machine.network();
  std::map<std::string, double> warmed;  // [K/s]
  for (auto const& run : amended.data()) {
    LinearisedRun const twin(machine, run);
    auto const more = twin.more_heat_than(without);
    for (auto const& range : network.ranges()) {
      auto const first = network.capacity().begin() + range.first;
      auto const [moving, standing] = twin.mean(more.at(range.name));
      warmed[range.name] += (std::abs(moving) + std::abs(standing)) / std::accumulate(first, first + range.count, 0.0);
    }
  }
  auto const less = [](auto const& a, auto const& b) { return a.second < b.second; };
  return std::max_element(warmed.begin(), warmed.end(), less)->first;
}

FreeHeat heat_of_effects(Estimation const& amended, Fit const& fit, std::string const& body) {
  auto const effects = Eigen::Index(amended.effects().size());
  Eigen::VectorXd const amplitudes = fit.x.tail(effects);
  Machine const machine = amended.machine_at(fit.x);
  std::vector<Machine> lacking_one;
  for (std::size_t e = 0; e < amended.effects().size(); ++e) lacking_one.push_back(lacking(amended, fit, e));
  Eigen::MatrixXd const root =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(fit.covariance.bottomRightCorner(effects, effects)).operatorSqrt();
  FreeHeat all;
  all.site.body = body;
  for (auto const& run : amended.data()) {
    LinearisedRun const twin(machine, run);
    auto const steps = Eigen::Index(run.steps.size());
    Eigen::VectorXd knots(steps + 1);
    for (Eigen::Index s = 0; s < steps; ++s) knots[s] = run.steps[std::size_t(s)].begin;
    knots[steps] = run.steps.back().end;
    Eigen::MatrixXd each(steps + 1, effects);
    for (Eigen::Index e = 0; e < effects; ++e) {
      each.col(e).head(steps) = twin.more_heat_than(lacking_one[std::size_t(e)]).at(body);
      each(steps, e) = each(steps - 1, e);
    }
    Eigen::MatrixXd const per_unit = each * amplitudes.cwiseInverse().asDiagonal();
    all.knots.push_back(knots);
    all.heat.emplace_back(each.rowwise().sum());
    all.spread.conservativeResize(all.spread.rows() + knots.size(), effects);
    all.spread.bottomRows(knots.size()) = per_unit * root;
  }
  return all;
}

HeatBySpeed heat_by_speed(FreeHeat const& heat, std::vector<BinnedRun> const& data) {
  std::vector<std::string> names;
  std::map<std::string, Eigen::VectorXd> weights;  // of the knots in the sum over the rows of a regime
  std::map<std::string, double> rows, squares;
  for (std::size_t r = 0; r < data.size(); ++r) {
    auto const regimes = speed_regimes(*data[r].run, data[r].time);
    auto const& knots = heat.knots[r];
    auto const first = first_knot(heat.knots, r);
    for (Eigen::Index i = 0; i < data[r].time.size(); ++i) {
      auto const& name = regimes.names[regimes.of_row[std::size_t(i)]];
      auto const [weight, is_new] = weights.try_emplace(name, Eigen::VectorXd::Zero(heat.spread.rows()));
      if (is_new) names.push_back(name);
      double q = 0.0;
      for (Eigen::Index k = 0; k < knots.size(); ++k) {
        double const share = hat(knots, k, data[r].time[i]);
        q += share * heat.heat[r][k];
        weight->second[first + k] += share;
      }
      rows[name] += 1.0;
      squares[name] += q * q;
    }
  }
  HeatBySpeed result;
  double count = 0.0, square = 0.0;
  for (auto const& name : names) {
    Eigen::VectorXd const weight = weights[name] / rows[name];
    result.mean.emplace_back(name, watts(heat, weight));
    count += rows[name];
    square += squares[name] - rows[name] * std::pow(result.mean.back().second.mean, 2);
  }
  result.swing = std::sqrt(std::max(0.0, square) / count);
  return result;
}

LinearisedRun::MeanHeat mean_heat(FreeHeat const& heat, std::size_t r, BinnedRun const& run) {
  auto const &t = heat.knots[r], &q = heat.heat[r];
  double moving = 0.0, standing = 0.0;
  LinearisedRun::MeanHeat mean;
  for (Eigen::Index k = 0; k + 1 < t.size(); ++k) {
    double const step = t[k + 1] - t[k];
    bool const moves = is_moving(*run.run->course, 0.5 * (t[k] + t[k + 1]));
    (moves ? mean.moving : mean.standing) += 0.5 * step * (q[k] + q[k + 1]);
    (moves ? moving : standing) += step;
  }
  return {moving > 0.0 ? mean.moving / moving : 0.0, standing > 0.0 ? mean.standing / standing : 0.0};
}

}  // namespace thermotwin::twin
