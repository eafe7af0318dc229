#include "twin/diagnosis/gap.h"

#include <algorithm>
#include <cmath>

#include "twin/diagnosis/linearised_run.h"

namespace thermotwin::twin {

double spread(Eigen::VectorXd const& values) {
  double sum = 0.0, squares = 0.0, count = 0.0;
  for (double const v : values)
    if (!std::isnan(v)) {
      sum += v;
      squares += v * v;
      count += 1.0;
    }
  return count > 0.0 ? std::sqrt(std::max(0.0, squares / count - sum * sum / (count * count))) : NAN;
}

/// From the spreads of sum and difference: 4 cov(a, b) = var(a + b) − var(a − b). A value that is missing in one is in
/// both.
double correlation(Eigen::VectorXd const& a, Eigen::VectorXd const& b) {
  double const scale = 4.0 * spread(a + 0.0 * b) * spread(b + 0.0 * a);
  return scale > 0.0 ? (std::pow(spread(a + b), 2) - std::pow(spread(a - b), 2)) / scale : 0.0;
}

std::string unit_of(MeasuredChannel const& channel, Machine const& machine) {
  if (!channel.displacement) return "K";
  bool const rotation = std::any_of(machine.displacements.begin(), machine.displacements.end(),
                                    [&](auto const& d) { return d.rotation && d.name == channel.name; });
  return rotation ? "urad" : "um";
}

double in_unit(std::string const& unit, double si) { return unit.starts_with('u') ? 1e6 * si : si; }

std::vector<ChannelGap> gaps(Machine const& before, Machine const& after, std::vector<BinnedRun> const& runs,
                             Machine const* calibrated) {
  std::vector<ChannelGap> result;
  for (auto const& run : runs) {
    auto const left_by = [&](Machine const& machine) -> Eigen::MatrixXd {
      return run.values - LinearisedRun(machine, run).prediction();
    };
    Eigen::MatrixXd const was = left_by(before), is = left_by(after);
    Eigen::MatrixXd const fitted = calibrated ? left_by(*calibrated) : Eigen::MatrixXd();
    for (std::size_t c = 0; c < run.run->channels.size(); ++c) {
      auto const& channel = run.run->channels[c];
      auto const column = Eigen::Index(c);
      result.push_back({run.run->name, channel.name, channel.displacement, unit_of(channel, before),
                        spread(was.col(column)), spread(is.col(column)),
                        calibrated ? spread(fitted.col(column)) : NAN});
    }
  }
  return result;
}

WholeGap whole(std::vector<ChannelGap> const& gaps) {
  WholeGap sum;
  int count = 0;
  for (auto const& gap : gaps) {
    if (std::isnan(gap.before) || std::isnan(gap.after)) continue;
    double const unit = gap.displacement ? 1e-6 : 0.1;
    sum.before += gap.before * gap.before / (unit * unit);
    sum.after += gap.after * gap.after / (unit * unit);
    ++count;
  }
  if (count == 0) return sum;
  return {std::sqrt(sum.before / count), std::sqrt(sum.after / count)};
}

}  // namespace thermotwin::twin
