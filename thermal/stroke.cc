#include "thermal/stroke.h"

#include <fmt/format.h>

#include "thermal/error.h"

namespace thermotwin::thermal {
namespace {

void require_track(Site const& track) {
  bool sorted = track.kind == Site::Kind::axial;
  for (std::size_t i = 1; i < track.contacts.size(); ++i)
    sorted = sorted && std::abs(track.contacts[i].low - track.contacts[i - 1].high) < 1e-9;
  if (!sorted)
    throw InputError(fmt::format("'{}' ({}) is no track: a moving part needs the mantle of a bar or a cylinder",
                                 track.body, track.place));
}

}  // namespace

Site dwell(Site const& track, double from, double to, double window) {
  require_track(track);
  require_positive(track.body, "length of the moving part [m]", window);
  if (to < from) std::swap(from, to);
  double const low = track.contacts.front().low, high = track.contacts.back().high;
  if (from - 0.5 * window < low - 1e-6 || to + 0.5 * window > high + 1e-6)
    throw InputError(
        fmt::format("the moving part reaches from {:.6g} to {:.6g} m, beyond its track on '{}', {:.6g} to "
                    "{:.6g} m",
                    from - 0.5 * window, to + 0.5 * window, track.body, low, high));
  Site site = track;
  site.place = fmt::format("{} under a moving part from {:.6g} to {:.6g} m", track.place, from, to);
  for (auto& contact : site.contacts) {
    double const covered = mean_overlap(contact.low, contact.high, window, from, to);
    contact.area *= covered / (contact.high - contact.low);
    contact.share = covered / window;
  }
  std::erase_if(site.contacts, [](Contact const& c) { return c.share < 1e-12; });
  return site;
}

Port add_moving_average(NetworkBuilder& builder, Site const& track, int from, int to, double window) {
  require_track(track);
  require_positive(track.body, "length of the moving part [m]", window);
  Average average;
  average.name = fmt::format("moving part on {}", track.body);
  average.from_channel = from;
  average.to_channel = to;
  average.window = window;
  average.edges.push_back(track.contacts.front().low);
  for (auto const& contact : track.contacts) {
    average.nodes.push_back(port_of(builder, track, contact).index);
    average.edges.push_back(contact.high);
    average.weights.push_back(contact.share);
  }
  return builder.add_average(std::move(average));
}

}  // namespace thermotwin::thermal
