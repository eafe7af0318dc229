#pragma once

#include "thermal/integrate.h"

namespace thermotwin::thermal {

/// A whole run as `integrate` makes it, by exponential steps in the modes of the network's linear part
/// (exponential_step.h), of which none is left out: what conducts at constant conductance is solved exactly, and a step
/// is as long as films, friction and losses allow. It takes the shorter time where inputs jump often, for after a jump
/// BDF begins anew with order 1 (docs/performance.md). The error of one step in a temperature that a law sees is at
/// most a tenth of what `integrate` allows.
///
/// Keeps no energies: those of samples and summary are 0. Knows no parameters, solver or longest step of `options`.
///
/// InputError for a network with relays or tracks, for more than 400 nodes (a mode touches every node), and when the
/// course lacks a channel; IntegrationError when the step runs to nothing, or more are tried than `options` allow.
IntegrationSummary integrate_in_modes(Network const& network, Course const& course,
                                      std::span<double const> initial_temperatures,
                                      std::span<double const> output_times, IntegrationOptions const& options,
                                      Observer const& observe);

/// The same InputError, before anything is run.
void check_modes(Network const& network);

}  // namespace thermotwin::thermal
