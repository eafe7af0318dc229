#pragma once

#include "thermal/site.h"

namespace thermotwin::thermal {

/// Where a moving part (a ball nut, a carriage) is along the body that it rides on (physics.md 2.10): a window of given
/// length whose centre lies between two positions along the axis of the track. The track is an axial site.

/// The site that the window covers on average when its centre is equally often everywhere from `from` to `to` [m], e.g.
/// a nut at constant feed: the exact integral of the overlap with each cell, ramps at the ends included; shares of
/// areas likewise. InputError if the window leaves the track.
[[nodiscard]] Site dwell(Site const& track, double from, double to, double window);

/// The average that follows the window: its centre is spread evenly between two input channels [m along the track's
/// axis]; where both are the same channel, it is where the part is now.
Port add_moving_average(NetworkBuilder& builder, Site const& track, int from, int to, double window);

}  // namespace thermotwin::thermal
