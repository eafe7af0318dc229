#pragma once

#include <Eigen/Core>
#include <vector>

#include "twin/diagnosis/estimation.h"

namespace thermotwin::twin {

/// The model error that the residuals of a fit have: how much over minutes, how much over hours, channel by channel.
/// Never below what was expected: residuals of a fit are smaller than the noise. And more only where the likelihood
/// says so clearly: an effect that one channel shows most looks like noise there.
[[nodiscard]] std::vector<ChannelNoise> observed_noise(Estimation const& estimation, Eigen::VectorXd const& x,
                                                       std::vector<ChannelNoise> const& expected);

}  // namespace thermotwin::twin
