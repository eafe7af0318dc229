#include "twin/structural_loop.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "thermal/error.h"
#include "twin/influence.h"

namespace thermotwin::twin {

using thermal::InputError;

void add_growth(NodeWeights& weights, Place const& place, double factor) {
  for (auto const& contact : place.site.contacts)
    weights.emplace_back(place.first_node + contact.node, factor * contact.share);
}

double StructuralLoop::expansion_at(Place const& place, std::optional<double> given) const {
  if (given) return *given;
  if (auto const* metal = bodies_.material_of(place.body->name)) return metal->expansion;
  throw InputError(fmt::format("'{}' has no material; give the segment's expansion", place.body->name));
}

/// Length of the stretch that grows: given for lumps, else that of the place along its body's axis.
double StructuralLoop::segment_length(LoopSegment const& segment) const {
  Place const place = assembly_.place(segment.of);
  if (segment.length) return *segment.length;
  if (place.body->shape != thermal::Body::Shape::axial)
    throw InputError(fmt::format(
        "segment of '{}': 'length' is missing; only a stretch of a bar or cylinder has its own", segment.of));
  double low = INFINITY, high = -INFINITY;
  for (auto const& contact : place.site.contacts) {
    low = std::min(low, contact.low);
    high = std::max(high, contact.high);
  }
  auto const open = segment.of.find('[');
  if (open == std::string::npos) return high - low;
  auto const dots = segment.of.find("..");
  if (dots == std::string::npos)
    throw InputError(
        fmt::format("segment of '{}': a point does not grow; write a stretch, as in 'shaft[0 mm .. 40 mm]', "
                    "or give its 'length'",
                    segment.of));
  auto const length = [&](std::string const& text) { return thermal::parse_value(text, dimension::length); };
  return length(segment.of.substr(dots + 2, segment.of.size() - dots - 3)) -
         length(segment.of.substr(open + 1, dots - open - 1));
}

/// The tool moves by its lever times the rotation.
void StructuralLoop::add_rotation(Displacement& channel, LoopSegment const& segment) const {
  auto const it = std::find_if(channels_.begin(), channels_.end(),
                               [&](auto const& d) { return d.rotation && d.name == segment.rotation; });
  if (it == channels_.end()) throw InputError(fmt::format("unknown rotation '{}'", segment.rotation));
  if (!segment.lever) throw InputError(fmt::format("the lever of rotation '{}' is missing", segment.rotation));
  double const factor = segment.weight * segment.growth_factor * *segment.lever;
  for (auto const& [node, weight] : it->weights) channel.weights.emplace_back(node, factor * weight);
  for (auto term : it->input_terms) {
    term.coefficient *= factor;
    channel.input_terms.push_back(std::move(term));
  }
}

void StructuralLoop::add_segment(Displacement& channel, DisplacementDescription const& description,
                                 LoopSegment const& segment) const {
  if (!segment.rotation.empty()) return add_rotation(channel, segment);
  Place const of = assembly_.place(segment.of);
  double const alpha = segment.growth_factor * expansion_at(of, segment.expansion);
  double const length = segment_length(segment);
  if (segment.against.empty()) {
    add_growth(channel.weights, of, segment.weight * alpha * length / description.base.value_or(1.0));
    return;
  }
  if (!segment.height)
    throw InputError(fmt::format("bending of '{}' against '{}' needs a height", segment.of, segment.against));
  double const lever = channel.rotation ? 1.0 : 0.5 * length;  // the end turns by its curvature over the length
  double const factor = segment.weight * alpha * length * lever / *segment.height;
  add_growth(channel.weights, of, factor);
  add_growth(channel.weights, assembly_.place(segment.against), -factor);
}

/// A loop of one material at one temperature grows like its offset from table to tool (physics.md 3.8).
void StructuralLoop::check_closure(DisplacementDescription const& description) const {
  if (!description.closure) return;
  double sum = 0.0;
  for (auto const& segment : description.segment)
    if (segment.rotation.empty() && segment.against.empty()) sum += segment.weight * segment_length(segment);
  for (auto const& influence : description.influence)
    sum += closing_length(influence, description.direction, assembly_.body(influence.body));
  if (std::abs(sum - *description.closure) > 1e-9)
    throw InputError(
        fmt::format("the loop of '{}' does not close: its signed lengths add up to {:.6g} mm, not to {:.6g} mm",
                    description.name, sum * 1e3, *description.closure * 1e3));
}

void StructuralLoop::add(DisplacementDescription const& description, bool rotation) {
  Displacement channel{description.name, description.title, rotation, {}, {}};
  bool const grows = std::any_of(description.segment.begin(), description.segment.end(),
                                 [](LoopSegment const& segment) { return segment.against.empty(); });
  if (rotation && !description.base && grows)
    throw InputError(fmt::format("rotation '{}': 'base' is missing", description.name));
  if (!rotation && description.base)
    throw InputError(fmt::format("displacement '{}' has a 'base'; only a [[rotation]] has one", description.name));
  for (auto const& segment : description.segment) add_segment(channel, description, segment);
  for (auto const& influence : description.influence)
    add_influence(channel.weights, machine_file_, influence, description.direction, assembly_.body(influence.body),
                  bodies_.metal_of(influence.body), assembly_.first_node(influence.body), rotation);
  check_closure(description);
  for (auto const& term : assembly_.input_terms())
    if (term.displacement == description.name) channel.input_terms.push_back(term);
  for (auto const& term : assembly_.temperature_terms())
    if (term.displacement == description.name) add_growth(channel.weights, term.place, term.coefficient);
  channels_.push_back(std::move(channel));
}

void StructuralLoop::add_beyond(DisplacementDescription const& description) {
  auto const channel =
      std::find_if(channels_.begin(), channels_.end(), [&](auto const& d) { return d.name == description.name; });
  for (auto const& segment : description.beyond) add_segment(*channel, description, segment);
}

}  // namespace thermotwin::twin
