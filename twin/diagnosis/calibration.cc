#include "twin/diagnosis/calibration.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

#include "thermal/error.h"
#include "twin/diagnosis/amended_file.h"
#include "twin/diagnosis/effect_search.h"
#include "twin/diagnosis/estimate_text.h"
#include "twin/diagnosis/expected_noise.h"
#include "twin/diagnosis/run_files.h"
#include "twin/diagnosis/start.h"
#include "twin/diagnosis/zero_search.h"
#include "twin/file/output_path.h"
#include "twin/file/text_file.h"
#include "twin/file_kind.h"

namespace thermotwin::twin {
namespace {

constexpr double large_share = 0.3;      // of a unit vector
constexpr double more_than_noise = 2.0;  // misfit

std::string unit_of(Unknown const& unknown, Estimation const& estimation, Machine const& machine) {
  if (unknown.kind == Unknown::Kind::lag || unknown.kind == Unknown::Kind::clock) return "s";
  if (unknown.kind == Unknown::Kind::input || unknown.kind == Unknown::Kind::warmth) return "1";
  if (unknown.run < 0) return "K";
  auto const& channels = estimation.data()[std::size_t(unknown.run)].run->channels;
  if (unknown.kind == Unknown::Kind::zero) return unit_of(channels[estimation.zeros()[unknown.index].channel], machine);
  if (unknown.kind != Unknown::Kind::offset) return "K";
  auto const of_zero = std::find_if(channels.begin(), channels.end(), [&](auto const& channel) {
    return channel.name == estimation.channels()[unknown.index];
  });
  return unit_of(*of_zero, machine);
}

/// Whether it is a number, or of an instrument: what the tables show.
bool is_shown(Unknown const& unknown) {
  return !is_beyond_a_file(unknown.kind) && unknown.kind != Unknown::Kind::moment &&
         unknown.kind != Unknown::Kind::moments;
}

void add_estimates(Calibration& calibration, Estimation const& estimation, Fit const& fit, Machine const& machine) {
  auto const& unknowns = estimation.unknowns();
  for (std::size_t u = 0; u < unknowns.size(); ++u) {
    if (!is_shown(unknowns[u])) continue;
    auto const i = Eigen::Index(u);
    double const deviation = std::sqrt(fit.covariance(i, i));
    if (unknowns[u].kind != Unknown::Kind::number) {
      calibration.instruments.push_back({unknowns[u], fit.x[i], deviation, unit_of(unknowns[u], estimation, machine)});
      continue;
    }
    auto const& number = estimation.numbers()[unknowns[u].index];
    calibration.numbers.push_back({number, fit.x[i], deviation, deviation <= still_uncertain * number.deviation});
  }
}

/// Groups of unknowns that a chain of correlations ties.
std::vector<std::vector<std::string>> inseparable(std::vector<Unknown> const& unknowns, Fit const& fit) {
  std::vector<std::size_t> group(unknowns.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  for (std::size_t a = 0; a < unknowns.size(); ++a)
    for (std::size_t b = a + 1; b < unknowns.size(); ++b) {
      if (!is_shown(unknowns[a]) || !is_shown(unknowns[b])) continue;
      auto const i = Eigen::Index(a), j = Eigen::Index(b);
      double const covariance = fit.covariance(i, j);
      if (std::abs(covariance) > tied * std::sqrt(fit.covariance(i, i) * fit.covariance(j, j)))
        std::replace(group.begin(), group.end(), std::size_t(group[b]), std::size_t(group[a]));
    }
  std::vector<std::vector<std::string>> groups;
  for (std::size_t g = 0; g < unknowns.size(); ++g) {
    std::vector<std::string> names;
    for (std::size_t u = 0; u < unknowns.size(); ++u)
      if (group[u] == g) names.push_back(unknowns[u].name);
    if (names.size() > 1) groups.push_back(std::move(names));
  }
  return groups;
}

void add_collinearity(Calibration& calibration, Estimation const& estimation, Fit const& fit) {
  std::vector<Eigen::Index> identified;
  for (std::size_t n = 0; n < calibration.numbers.size(); ++n)
    if (calibration.numbers[n].identified) identified.push_back(Eigen::Index(n));
  if (identified.empty()) return;
  Eigen::MatrixXd sensitivities(estimation.rows(), Eigen::Index(identified.size()));
  for (std::size_t k = 0; k < identified.size(); ++k)
    sensitivities.col(Eigen::Index(k)) = fit.jacobian.column(identified[k]).normalized();
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> const solver((sensitivities.transpose() * sensitivities).eval());
  calibration.collinearity = 1.0 / std::sqrt(std::max(solver.eigenvalues()[0], 1e-12));
  for (std::size_t k = 0; k < identified.size(); ++k)
    if (std::abs(solver.eigenvectors()(Eigen::Index(k), 0)) > large_share)
      calibration.weakest.push_back(calibration.numbers[std::size_t(identified[k])].number.path);
}

double misfit_of(Estimation const& estimation, Fit const& fit) {
  return fit.residual.head(estimation.rows()).squaredNorm() / estimation.measured();
}

/// Of a machine that is right, as `whole` counts.
double gap_of_noise(Machine const& machine, std::vector<BinnedRun> const& runs) {
  std::vector<ChannelGap> noises;
  for (auto const& run : runs)
    for (std::size_t c = 0; c < run.run->channels.size(); ++c) {
      auto const& channel = run.run->channels[c];
      auto const noise = expected_noise(machine, channel.name, runs);
      Eigen::VectorXd const values = run.values.col(Eigen::Index(c));
      if (values.array().isNaN().all()) continue;
      double const slow = noise.slow_along(run.time, values)[0], samples = run.samples.col(Eigen::Index(c)).mean();
      double const white = noise.white / std::sqrt(std::max(1.0, samples));
      double const deviation = std::hypot(noise.fast, std::hypot(white, noise.rounding), slow);
      noises.push_back({run.run->name, channel.name, channel.displacement, "", deviation, deviation});
    }
  return whole(noises).after;
}

/// The fit of the identified numbers where the others are nominal.
void add_written(Calibration& calibration, Estimation const& estimation) {
  std::vector<std::size_t> others;
  for (std::size_t n = 0; n < calibration.numbers.size(); ++n)
    if (!calibration.numbers[n].identified) others.push_back(n);
  Fit fit = best_fit(estimation.knowing(others));
  for (std::size_t const n : others) fit.x[Eigen::Index(n)] = 0.0;
  for (std::size_t n = 0; n < calibration.numbers.size(); ++n) calibration.numbers[n].written = fit.x[Eigen::Index(n)];
  calibration.document = estimation.document_at(fit.x);
  calibration.lags = changed_lags(estimation, fit);
}

std::vector<ChangedValue> changes_of(Calibration const& calibration) {
  std::vector<ChangedValue> changes;
  if (calibration.friction) changes = calibration.friction->changes();
  changes.insert(changes.end(), calibration.lags.begin(), calibration.lags.end());
  for (auto const& number : calibration.numbers) {
    if (!number.identified) continue;
    auto change = changed_value(number.number, number.written, number.deviation);
    change.comment = fmt::format("estimate {} {}", written_value(number.estimate(), number.number.unit, 4),
                                 written_interval(number.standard_error(), number.number.unit));
    changes.push_back(std::move(change));
  }
  return changes;
}

}  // namespace

double CalibratedNumber::estimate() const { return number.value(logarithm); }
double CalibratedNumber::standard_error() const { return std::abs(number.slope(logarithm)) * deviation; }
double CalibratedNumber::departure() const { return std::abs(logarithm) / number.deviation; }
bool CalibratedNumber::implausible() const {
  bool const turned =
      number.value(written) * estimate() < 0.0 && std::abs(estimate()) > far_from_file * standard_error();
  return identified && (turned || std::abs(written) > far_from_file * number.deviation);
}

std::vector<std::string> Calibration::shortcomings() const {
  std::vector<std::string> reasons, far;
  if (misfit > more_than_noise) reasons.push_back(fmt::format("the misfit is above {:g}", more_than_noise));
  for (auto const& n : numbers)
    if (n.departure() > far_from_file) far.push_back(fmt::format("{} by {:.1f}", n.number.path, n.departure()));
  if (!far.empty())
    reasons.push_back(
        fmt::format("from the file by more than {:g} prior deviations: {}", far_from_file, fmt::join(far, ", ")));
  if (auto const sum = whole(gaps); sum.after > std::max(sum.before, expected_gap))
    reasons.push_back("the calibrated file is further from the data than yours");
  return reasons;
}

Calibration calibrate(Value const& machine, std::vector<BinnedRun> const& runs, FitWatch watch) {
  auto friction = friction_while_moving(machine, runs, DiagnosisOptions().threshold, watch);
  Value const& document = friction ? friction->document : machine;
  Estimation const as_stated = expected_estimation(document, runs).with_form_of_file().watched(std::move(watch));
  if (as_stated.numbers().empty())
    throw thermal::InputError(
        "the machine has no number that calibration could change: no conductance, film, friction, loss, mass or step "
        "of a structural loop");
  Fitted best{as_stated, best_fit(as_stated)};
  while (auto freed = with_changed_zeros(best.estimation, best.fit, DiagnosisOptions().threshold)) best = *freed;
  auto const& [estimation, fit] = best;
  Calibration calibration;
  calibration.converged = fit.converged;
  Machine const before = Machine::build(machine);
  add_estimates(calibration, estimation, fit, before);
  calibration.inseparable = inseparable(estimation.unknowns(), fit);
  add_collinearity(calibration, estimation, fit);
  calibration.misfit = misfit_of(estimation, fit);
  add_written(calibration, estimation);
  Machine const after = Machine::build(calibration.document);
  calibration.machine = before.name;
  calibration.gaps = gaps(before, after, runs);
  calibration.expected_gap = gap_of_noise(before, runs);
  calibration.friction = std::move(friction);
  return calibration;
}

Calibration calibrate_files(CalibrateFiles const& files) {
  refuse_to_overwrite(files.output, files.machine, files.data);
  refuse_to_replace(files.output, FileKind::machine);
  std::string const text = text_of_file(files.machine);
  Value const document = parse_toml(text, files.machine.string());
  std::vector<std::string> remarks;
  Machine const machine = Machine::build(document);
  auto const measured = read_runs(files.data, machine, remarks);
  auto const runs = binned(measured);
  auto const found = doubts(machine, runs);
  auto calibration = with_doubts(found, [&] { return calibrate(document, runs, files.watch); });
  calibration.doubts = found;
  if (calibration.friction) remarks.insert(remarks.begin(), calibration.friction->remark());
  calibration.remarks = remarks;
  if (files.show) files.show(calibration);
  if (!files.output.empty())
    write_amended(files.machine, files.output,
                  with_last_words(with_values(text, changes_of(calibration)),
                                  fmt::format("Calibrated from {}. ±: 95 %; numbers that these data do not identify "
                                              "are as they were.",
                                              names_of(files.data))));
  return calibration;
}

}  // namespace thermotwin::twin
