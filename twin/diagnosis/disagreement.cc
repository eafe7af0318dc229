#include "twin/diagnosis/disagreement.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <numeric>
#include <utility>

#include "twin/diagnosis/gap.h"
#include "twin/diagnosis/regimes.h"

namespace thermotwin::twin {
namespace {

constexpr double false_discoveries = 0.01;
constexpr int fewest_rows_of_part = 3;

/// One channel of one run: its residual, NaN where nothing was measured, and the same whitened, 0 there.
struct ChannelResidual {
  Eigen::VectorXd plain, whitened;
};

ChannelResidual residual_of(Eigen::VectorXd const& plain, BinnedRun const& run, Eigen::Index channel,
                            ChannelNoise const& noise) {
  Eigen::MatrixXd signal = plain;
  whitening_of(noise, run, channel).apply(signal);
  return {plain, signal.col(0)};
}

/// One part of it; nothing of a part with too few rows.
void add_part(std::vector<Disagreement>& cells, Disagreement cell, ChannelResidual const& residual,
              Regimes const& regimes, std::size_t part) {
  double squares = 0.0, power = 0.0;
  int rows = 0;
  for (Eigen::Index row = 0; row < residual.plain.size(); ++row) {
    if (regimes.of_row[std::size_t(row)] != part || std::isnan(residual.plain[row])) continue;
    cell.mean += residual.plain[row];
    squares += residual.plain[row] * residual.plain[row];
    power += residual.whitened[row] * residual.whitened[row];
    ++rows;
  }
  if (rows < fewest_rows_of_part) return;
  cell.mean /= rows;
  cell.rms = std::sqrt(squares / rows);
  cell.power = power / rows;
  cell.p_value = boost::math::cdf(boost::math::complement(boost::math::chi_squared(double(rows)), power));
  cells.push_back(std::move(cell));
}

void mark_significant(std::vector<Disagreement>& cells, std::string const& cut) {
  std::vector<Disagreement*> of_cut;
  std::vector<double> p_values;
  for (auto& cell : cells)
    if (cell.cut == cut) {
      of_cut.push_back(&cell);
      p_values.push_back(cell.p_value);
    }
  auto const found = discoveries(p_values, false_discoveries);
  for (std::size_t i = 0; i < of_cut.size(); ++i) of_cut[i]->significant = found[i];
}

}  // namespace

std::vector<bool> discoveries(std::vector<double> const& p_values, double rate) {
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p_values[a] < p_values[b]; });
  std::size_t count = 0;
  for (std::size_t k = 0; k < order.size(); ++k)
    if (p_values[order[k]] <= rate * double(k + 1) / double(order.size())) count = k + 1;
  std::vector<bool> found(p_values.size(), false);
  for (std::size_t k = 0; k < count; ++k) found[order[k]] = true;
  return found;
}

std::vector<Disagreement> disagreements(Estimation const& estimation, Eigen::VectorXd const& x,
                                        Machine const& machine) {
  auto const residuals = estimation.residuals_at(x);
  auto const& known = estimation.channels();
  std::vector<Disagreement> cells;
  for (std::size_t r = 0; r < residuals.size(); ++r) {
    auto const& run = estimation.data()[r];
    std::pair<std::string, Regimes> const cuts[] = {
        {"regime", thermal_regimes(run)}, {"speed", speed_regimes(*run.run, run.time)}, {"time", time_windows(run)}};
    for (std::size_t c = 0; c < run.run->channels.size(); ++c) {
      auto const& channel = run.run->channels[c];
      auto const place = std::find(known.begin(), known.end(), channel.name) - known.begin();
      auto const residual =
          residual_of(residuals[r].col(Eigen::Index(c)), run, Eigen::Index(c), estimation.noise()[std::size_t(place)]);
      for (auto const& [cut, regimes] : cuts)
        for (std::size_t part = 0; regimes.names.size() > 1 && part < regimes.names.size(); ++part)
          add_part(cells, {run.run->name, channel.name, unit_of(channel, machine), cut, regimes.names[part]}, residual,
                   regimes, part);
    }
  }
  for (char const* cut : {"regime", "speed", "time"}) mark_significant(cells, cut);
  return cells;
}

}  // namespace thermotwin::twin
