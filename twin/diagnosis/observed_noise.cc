#include "twin/diagnosis/observed_noise.h"

#include <cmath>

namespace thermotwin::twin {
namespace {

constexpr double reluctance = 10.0;  // 2 ln of the likelihood by which more noise must be the better

/// −2 ln likelihood of one channel's residuals in all runs.
double misfit(ChannelNoise const& noise, std::string const& channel, std::vector<BinnedRun> const& runs,
              std::vector<Eigen::MatrixXd> const& residuals) {
  double sum = 0.0;
  for (std::size_t r = 0; r < runs.size(); ++r)
    for (std::size_t c = 0; c < runs[r].run->channels.size(); ++c) {
      if (runs[r].run->channels[c].name != channel) continue;
      Whitening const whitening = whitening_of(noise, runs[r], Eigen::Index(c));
      Eigen::MatrixXd signal = residuals[r].col(Eigen::Index(c));
      whitening.apply(signal);
      sum += signal.squaredNorm() + 2.0 * whitening.log_scale();
    }
  return sum;
}

}  // namespace

std::vector<ChannelNoise> observed_noise(Estimation const& estimation, Eigen::VectorXd const& x,
                                         std::vector<ChannelNoise> const& expected) {
  auto const residuals = estimation.residuals_at(x);
  std::vector<ChannelNoise> noise = expected;
  for (std::size_t c = 0; c < noise.size(); ++c) {
    double best = INFINITY;
    for (double const fast : {1.0, 1.5, 2.5, 4.0})
      for (double const slow : {1.0, 2.0, 4.0, 8.0}) {
        ChannelNoise trial = expected[c];
        trial.fast *= fast;
        trial.slow *= slow;
        trial.slow_share *= slow;
        double const value = misfit(trial, estimation.channels()[c], estimation.data(), residuals) +
                             reluctance * (int(fast > 1.0) + int(slow > 1.0));
        if (value < best) {
          best = value;
          noise[c] = trial;
        }
      }
  }
  return noise;
}

}  // namespace thermotwin::twin
