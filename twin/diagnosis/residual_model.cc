#include "twin/diagnosis/residual_model.h"

#include <fmt/format.h>

#include "thermal/error.h"
#include "thermal/evaluation.h"

namespace thermotwin::twin {

using thermal::InputError;

namespace {

void check_regime(ResidualModel const& model, std::size_t index) {
  auto const& regime = model.regimes[index];
  Eigen::Index const nodes = model.capacity.size(), channels = model.noise.size();
  if (regime.dynamics.rows() != nodes || regime.dynamics.cols() != nodes)
    throw InputError(fmt::format("regime {}: dynamics of {} x {} for {} heat capacities", index, regime.dynamics.rows(),
                                 regime.dynamics.cols(), nodes));
  if (regime.observation.rows() != channels || regime.observation.cols() != nodes)
    throw InputError(fmt::format("regime {}: observation of {} x {} for {} channels and {} nodes", index,
                                 regime.observation.rows(), regime.observation.cols(), channels, nodes));
  bool const ordered = index == 0 ? regime.first_row == 0 : regime.first_row > model.regimes[index - 1].first_row;
  if (!ordered)
    throw InputError(fmt::format("regime {} begins at row {}: the first must begin at row 0, each after the one before",
                                 index, regime.first_row));
}

void check_positive(char const* what, Eigen::VectorXd const& values) {
  for (Eigen::Index i = 0; i < values.size(); ++i)
    if (!(values[i] > 0.0)) throw InputError(fmt::format("{} {} is {}; it must be above 0", what, i, values[i]));
}

}  // namespace

Regime linearise(thermal::Network const& network, std::span<double const> state, std::span<double const> input,
                 std::vector<NodeWeights> const& channels) {
  thermal::Evaluation evaluation(network);
  thermal::Linearisation at;
  evaluation.linearise(state.data(), input.data(), at);
  Regime regime;
  regime.dynamics = evaluation.jacobian(state.data(), input.data());
  regime.observation.setZero(Eigen::Index(channels.size()), network.nodes());
  for (std::size_t c = 0; c < channels.size(); ++c)
    for (auto const& [node, weight] : channels[c]) regime.observation(Eigen::Index(c), node) += weight * at.slope[node];
  return regime;
}

void check(ResidualModel const& model, Eigen::MatrixXd const& residuals) {
  check_positive("interval", Eigen::VectorXd::Constant(1, model.interval));
  check_positive("heat capacity of node", model.capacity);
  check_positive("noise of channel", model.noise);
  if (model.regimes.empty()) throw InputError("a residual model needs at least one regime");
  for (std::size_t i = 0; i < model.regimes.size(); ++i) check_regime(model, i);
  if (residuals.cols() != model.noise.size())
    throw InputError(fmt::format("residuals of {} channels for a model of {}", residuals.cols(), model.noise.size()));
  if (residuals.array().isInf().any()) throw InputError("an infinite residual; a missing sample is NaN");
}

}  // namespace thermotwin::twin
