#include "models/mutual_information.h"

#include <algorithm>
#include <boost/math/special_functions/digamma.hpp>
#include <boost/random/uniform_int_distribution.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

#include "models/quantile.h"

namespace thermotwin::models {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// A value on an edge belongs to the bin above, whatever its last bits.
constexpr double edge_tolerance = 1e-9;

void check(VectorXd const& x, VectorXd const& y) {
  if (x.size() != y.size())
    throw std::invalid_argument(fmt::format("mutual information of {} and {} samples", x.size(), y.size()));
  if (x.size() < 4) throw std::invalid_argument(fmt::format("mutual information of {} samples: at least 4", x.size()));
  if (!x.allFinite() || !y.allFinite()) throw std::invalid_argument("mutual information of a value that is no number");
}

bool constant(VectorXd const& x) { return x.maxCoeff() == x.minCoeff(); }

double freedman_diaconis(VectorXd const& x) {
  std::vector<double> sorted(x.begin(), x.end());
  std::sort(sorted.begin(), sorted.end());
  double const spread = quantile(sorted, 0.75) - quantile(sorted, 0.25);
  auto const samples = static_cast<double>(x.size());
  double const width = 2 * spread / std::cbrt(samples);
  return std::min(samples, std::ceil((sorted.back() - sorted.front()) / width));
}

int bin_count(VectorXd const& x, MutualInformationOptions const& options) {
  if (options.bins) {
    if (*options.bins < 2) throw std::invalid_argument(fmt::format("{} bins: at least 2", *options.bins));
    return *options.bins;
  }
  auto const samples = static_cast<double>(x.size());
  switch (options.count) {
    case BinCount::sturges:
      return std::max(2, static_cast<int>(std::ceil(std::log2(samples))) + 1);
    case BinCount::square_root:
      return std::max(2, static_cast<int>(std::sqrt(samples)));
    case BinCount::cellucci:
      return std::max(2, static_cast<int>(std::sqrt(samples / 5)));
    case BinCount::freedman_diaconis:
      return std::max(2, static_cast<int>(freedman_diaconis(x)));
  }
  throw std::logic_error("a rule for the number of bins without its formula");
}

/// The bin of each sample.
struct Binned {
  std::vector<int> bin;
  int bins = 0;
};

Binned equally_wide(VectorXd const& x, int bins) {
  Binned binned{{}, bins};
  double const low = x.minCoeff(), range = x.maxCoeff() - low;
  for (double const value : x)
    binned.bin.push_back(std::min(bins - 1, static_cast<int>((value - low) / range * bins + edge_tolerance)));
  return binned;
}

Binned equally_frequent(VectorXd const& x, int bins) {
  std::vector<double> sorted(x.begin(), x.end());
  std::sort(sorted.begin(), sorted.end());
  Binned binned{{}, bins};
  for (double const value : x) {
    auto const rank = std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin();
    binned.bin.push_back(static_cast<int>(rank * bins / x.size()));
  }
  return binned;
}

Binned binned(VectorXd const& x, MutualInformationOptions const& options) {
  int const bins = bin_count(x, options);
  return options.edges == BinEdges::equal_width ? equally_wide(x, bins) : equally_frequent(x, bins);
}

/// H = ln N − Σ n ln n / N of the occupied bins, and how many there are.
struct Entropy {
  double value = 0;
  int occupied = 0;
};

Entropy entropy(std::vector<int> const& bin, std::size_t bins) {
  std::vector<int> counts(bins, 0);
  for (int const b : bin) ++counts[static_cast<std::size_t>(b)];
  Entropy h;
  for (int const n : counts) {
    if (n == 0) continue;
    ++h.occupied;
    h.value -= n * std::log(n);
  }
  auto const samples = static_cast<double>(bin.size());
  h.value = std::log(samples) + h.value / samples;
  return h;
}

Entropy joint_entropy(Binned const& x, Binned const& y) {
  std::vector<int> cell(x.bin.size());
  for (std::size_t i = 0; i < cell.size(); ++i) cell[i] = x.bin[i] * y.bins + y.bin[i];
  return entropy(cell, static_cast<std::size_t>(x.bins) * static_cast<std::size_t>(y.bins));
}

/// Orders of the samples in which blocks are permuted and keep their inner order (Fisher and Yates).
class Permutations {
 public:
  Permutations(Index samples, Index block, std::uint64_t seed)
      : samples_(samples),
        block_(block),
        random_(seed),
        order_(static_cast<std::size_t>((samples + block - 1) / block)) {
    std::iota(order_.begin(), order_.end(), Index{0});
  }

  std::vector<int> next(std::vector<int> const& values) {
    for (std::size_t i = order_.size() - 1; i > 0; --i)
      std::swap(order_[i], order_[boost::random::uniform_int_distribution<std::size_t>(0, i)(random_)]);
    std::vector<int> permuted;
    for (Index const block : order_)
      for (Index i = block * block_; i < std::min(samples_, (block + 1) * block_); ++i)
        permuted.push_back(values[static_cast<std::size_t>(i)]);
    return permuted;
  }

 private:
  Index samples_, block_;
  std::mt19937_64 random_;
  std::vector<Index> order_;
};

VectorXd scaled_without_ties(VectorXd const& x, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  boost::random::uniform_real_distribution<double> const noise(-1e-9, 1e-9);
  VectorXd const centred = x.array() - x.mean();
  double const deviation = centred.norm() / std::sqrt(static_cast<double>(x.size()));
  return centred / deviation + VectorXd::NullaryExpr(x.size(), [&] { return noise(random); });
}

}  // namespace

MutualInformation mutual_information(VectorXd const& x, VectorXd const& y, MutualInformationOptions const& options) {
  check(x, y);
  if (options.block < 1) throw std::invalid_argument(fmt::format("blocks of {} samples: at least 1", options.block));
  MutualInformation information;
  information.samples = x.size();
  if (constant(x) || constant(y)) return information;

  Binned const x_bins = binned(x, options);
  Binned y_bins = binned(y, options);
  Entropy const h_x = entropy(x_bins.bin, static_cast<std::size_t>(x_bins.bins));
  Entropy const h_y = entropy(y_bins.bin, static_cast<std::size_t>(y_bins.bins));
  Entropy const h_xy = joint_entropy(x_bins, y_bins);
  information.bins_x = x_bins.bins;
  information.bins_y = y_bins.bins;
  information.plug_in = h_x.value + h_y.value - h_xy.value;
  information.saturated = h_xy.occupied == h_x.occupied && h_xy.occupied == h_y.occupied;

  Permutations permutations(x.size(), options.block, options.seed);
  auto const as_measured = y_bins.bin;
  double null_sum = 0;
  int as_much = 0;
  for (int i = 0; i < options.permutations; ++i) {
    y_bins.bin = permutations.next(as_measured);
    double const null = h_x.value + h_y.value - joint_entropy(x_bins, y_bins).value;
    null_sum += null;
    if (null >= information.plug_in - 1e-12) ++as_much;
  }
  information.p_value = (1.0 + as_much) / (1.0 + options.permutations);

  information.value = information.plug_in;
  if (options.bias == BiasCorrection::miller_madow)
    information.value -= (h_xy.occupied - h_x.occupied - h_y.occupied + 1) / (2.0 * static_cast<double>(x.size()));
  if (options.bias == BiasCorrection::shuffle_null && options.permutations > 0)
    information.value -= null_sum / options.permutations;
  double const scale = std::sqrt(h_x.value * h_y.value);
  information.normalised = scale > 0 ? information.value / scale : 0.0;
  return information;
}

double nearest_neighbour_information(VectorXd const& x, VectorXd const& y, int neighbours) {
  check(x, y);
  if (neighbours < 1 || neighbours >= x.size())
    throw std::invalid_argument(fmt::format("{} neighbours among {} samples", neighbours, x.size()));
  if (constant(x) || constant(y)) return 0.0;
  VectorXd const u = scaled_without_ties(x, 1), v = scaled_without_ties(y, 2);
  double sum = 0;
  VectorXd distance(u.size());
  for (Index i = 0; i < u.size(); ++i) {
    auto const du = (u.array() - u(i)).abs();
    auto const dv = (v.array() - v(i)).abs();
    distance = du.max(dv);
    std::nth_element(distance.begin(), distance.begin() + neighbours, distance.end());
    double const reach = distance(neighbours);  // the sample itself is the nearest
    sum += boost::math::digamma(static_cast<double>((du < reach).count())) +
           boost::math::digamma(static_cast<double>((dv < reach).count()));
  }
  auto const samples = static_cast<double>(u.size());
  return boost::math::digamma(neighbours) + boost::math::digamma(samples) - sum / samples;
}

}  // namespace thermotwin::models
