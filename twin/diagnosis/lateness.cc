#include "twin/diagnosis/lateness.h"

#include <algorithm>
#include <cmath>

#include "twin/diagnosis/gap.h"
#include "twin/instruments/first_order_lag.h"

namespace thermotwin::twin {
namespace {

constexpr double furthest_shift = 5400.0, shift_step = 60.0;  // s
constexpr double part_of_run = 1.0 / 8.0;

Eigen::VectorXd changes_from_row_to_row(Eigen::VectorXd const& values) {
  return values.tail(values.size() - 1) - values.head(values.size() - 1);
}

}  // namespace

double Lateness::left() const { return (1.0 - agreement * agreement) / (1.0 - unshifted * unshifted); }

Lateness lateness_of(Eigen::VectorXd const& time, Eigen::VectorXd const& seen, Eigen::VectorXd const& due) {
  double const begin = time[0], end = time[time.size() - 1];
  FirstOrderLag const prediction(time, due, 0.0);  // without a lag: a line between its points
  Eigen::VectorXd const changes = changes_from_row_to_row(seen);
  int const shifts = int(std::min(furthest_shift, part_of_run * (end - begin)) / shift_step);
  Lateness best;
  for (int s = -shifts; s <= shifts; ++s) {
    Eigen::VectorXd const shifted = time.unaryExpr([&](double t) {
      double const at = t - s * shift_step;
      return at < begin || at > end ? NAN : prediction.at(at);
    });
    double const agreement = correlation(changes, changes_from_row_to_row(shifted));
    if (s == 0) best.unshifted = agreement;
    if (agreement > best.agreement) best.agreement = agreement, best.time = s * shift_step;
  }
  return best;
}

}  // namespace thermotwin::twin
