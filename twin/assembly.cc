#include "twin/assembly.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>

#include "thermal/error.h"
#include "thermal/nearest_name.h"
#include "thermal/units.h"

namespace thermotwin::twin {
namespace {

using thermal::Body;
using thermal::InputError;
using thermal::Site;

constexpr double typed = 1e-9;  ///< of typed lengths, what rounding leaves [m]

/// "40 mm .. 80 mm" or "10 mm" [m].
struct Extent {
  double low = 0.0;
  std::optional<double> high;
};

std::string trim(std::string text) {
  auto const blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && blank(text.back())) text.pop_back();
  while (!text.empty() && blank(text.front())) text.erase(0, 1);
  return text;
}

Extent parse_extent(std::string const& text) {
  auto const length = [](std::string const& s) { return thermal::parse_value(trim(s), dimension::length); };
  auto const dots = text.find("..");
  if (dots == std::string::npos) return {length(text), {}};
  return {length(text.substr(0, dots)), length(text.substr(dots + 2))};
}

struct PlaceText {
  std::string body, face;
  std::vector<Extent> extents;
};

PlaceText parse_place(std::string const& text) {
  PlaceText place;
  std::string head = text;
  if (auto const open = text.find('['); open != std::string::npos) {
    if (text.back() != ']') throw InputError(fmt::format("the place '{}' lacks a closing bracket", text));
    head = text.substr(0, open);
    std::string inside = text.substr(open + 1, text.size() - open - 2) + ",";
    for (std::size_t begin = 0, comma; (comma = inside.find(',', begin)) != std::string::npos; begin = comma + 1)
      place.extents.push_back(parse_extent(inside.substr(begin, comma - begin)));
  }
  auto const dot = head.find('.');
  place.body = trim(head.substr(0, dot));
  if (dot != std::string::npos) place.face = trim(head.substr(dot + 1));
  return place;
}

/// Keeps what lies within [low, high] along the axis; cells that are cut count by their length inside.
Site clip(Site site, double low, double high) {
  std::vector<thermal::Contact> kept;
  double sum = 0.0;
  for (auto contact : site.contacts) {
    double const overlap = std::min(high, contact.high) - std::max(low, contact.low);
    if (overlap <= 0.0) continue;
    contact.share *= overlap / (contact.high - contact.low);
    contact.area *= overlap / (contact.high - contact.low);
    sum += contact.share;
    kept.push_back(contact);
  }
  for (auto& contact : kept) contact.share /= sum;
  site.contacts = std::move(kept);
  return site;
}

Site axial_site(Body const& body, PlaceText const& place) {
  double const length = body.edges[0].back();
  auto const within = [&](double s) {
    if (s < -typed || s > length + typed)
      throw InputError(
          fmt::format("{:.6g} mm is outside '{}', which is {:.6g} mm long", s * 1e3, body.name, length * 1e3));
  };
  if (place.extents.size() > 1)
    throw InputError(fmt::format("'{}' has one direction; the place names {}", body.name, place.extents.size()));
  Extent const extent = place.extents.front();
  within(extent.low);
  if (!extent.high) {
    if (place.face.empty()) return thermal::point(body, body.origin + extent.low * body.axis);
    return thermal::ring(body, place.face, extent.low);
  }
  within(*extent.high);
  if (!(*extent.high > extent.low))
    throw InputError(fmt::format("the stretch ends at {:.6g} mm, before it begins", *extent.high * 1e3));
  if (place.face.empty()) return clip(thermal::whole(body), extent.low, *extent.high);
  return thermal::face(body, place.face, extent.low, *extent.high);
}

/// Extents of a block count from its corner: three of them for the inside, two for a face (its own two directions).
Site block_site(Body const& body, PlaceText const& place) {
  int normal = -1;
  if (!place.face.empty())
    normal = std::string("xyz").find(place.face[0]) == std::string::npos ? -1 : place.face[0] - 'x';
  std::size_t const due = normal < 0 ? 3 : 2;
  if (place.extents.size() != due)
    throw InputError(
        fmt::format("the place on '{}' names {} extents; {} are due", body.name, place.extents.size(), due));
  Eigen::AlignedBox3d box;
  Eigen::Vector3d low, high;
  bool is_point = true;
  std::size_t next = 0;
  for (int d = 0; d < 3; ++d) {
    double const size = body.edges[std::size_t(d)].back();
    Extent const extent = d == normal ? Extent{place.face.ends_with("max") ? size : 0.0, {}} : place.extents[next++];
    double const end = extent.high.value_or(extent.low);
    for (double s : {extent.low, end})
      if (s < -typed || s > size + typed)
        throw InputError(fmt::format("{:.6g} mm is outside '{}', which is {:.6g} mm long in {}", s * 1e3, body.name,
                                     size * 1e3, char('x' + d)));
    if (extent.high) is_point = false;
    low[d] = body.origin[d] + extent.low;
    high[d] = body.origin[d] + end;
  }
  if (is_point) return thermal::point(body, low);
  if (normal < 0) return thermal::region(body, {low, high});
  return thermal::face(body, place.face, Eigen::AlignedBox3d(low, high));
}

/// Along one direction: a length, or the same point.
bool have_in_common(Extent const& a, Extent const& b) {
  double const a_end = a.high.value_or(a.low), b_end = b.high.value_or(b.low);
  double const common = std::min(a_end, b_end) - std::max(a.low, b.low);
  return common > typed || (std::abs(a.low - b.low) <= typed && std::abs(a_end - b_end) <= typed);
}

}  // namespace

bool have_in_common(Place const& a, Place const& b) {
  if (a.body != b.body) return false;
  if (a.body->shape == Body::Shape::lump) return true;
  PlaceText const one = parse_place(a.text), other = parse_place(b.text);
  auto const face_of = [&](PlaceText const& place) {
    return place.face.empty() && a.body->faces.contains("surface") ? "surface" : place.face;
  };
  if (face_of(one) != face_of(other)) return false;
  for (std::size_t i = 0; i < std::min(one.extents.size(), other.extents.size()); ++i)
    if (!have_in_common(one.extents[i], other.extents[i])) return false;
  return true;
}

std::string body_of(std::string const& place) { return trim(place.substr(0, place.find_first_of("[."))); }

Site site_of(Body const& body, std::string const& text) {
  PlaceText const parsed = parse_place(text);
  if (parsed.extents.empty()) return parsed.face.empty() ? thermal::whole(body) : thermal::face(body, parsed.face);
  if (body.shape == Body::Shape::block) return block_site(body, parsed);
  if (body.shape == Body::Shape::axial) return axial_site(body, parsed);
  throw InputError(fmt::format("'{}' is a lump: it has no places within", body.name));
}

double Place::area() const { return site.area(); }

Eigen::Vector3d Place::centre() const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (auto const& contact : site.contacts) sum += contact.share * contact.centre;
  return sum;
}

Assembly::Assembly(std::map<std::string, thermal::Body> const& bodies, std::vector<std::string> const& order,
                   double maximum_spindle_speed, Eigen::Vector3d const& up)
    : bodies_(bodies), maximum_spindle_speed_(maximum_spindle_speed), up_(up) {
  begin_part("conduction");
  for (auto const& name : order) first_nodes_[name] = add_to(builder_, part_, bodies_.at(name)).index;
}

thermal::Body const& Assembly::body(std::string const& name, std::vector<std::string> const& or_else) const {
  auto const it = bodies_.find(name);
  if (it != bodies_.end()) return it->second;
  auto names = or_else;
  for (auto const& entry : bodies_) names.push_back(entry.first);
  throw InputError(fmt::format("unknown body '{}'; {}", name, thermal::did_you_mean(name, names)));
}

int Assembly::first_node(std::string const& name) const { return first_nodes_.at(body(name).name); }

Place Assembly::place(std::string const& text, std::vector<std::string> const& or_else) const {
  Body const& found = body(parse_place(text).body, or_else);
  return {text, &found, first_nodes_.at(found.name), site_of(found, text)};
}

Place Assembly::surface(std::string const& text) const {
  PlaceText const parsed = parse_place(text);
  Body const& found = body(parsed.body);
  if (!parsed.face.empty() || !found.faces.contains("surface")) {
    Place result = place(text);
    if (parsed.face.empty())
      throw InputError(fmt::format("'{}' needs a face, for example '{}.{}'", text, found.name,
                                   found.faces.empty() ? "surface" : found.faces.begin()->first));
    return result;
  }
  auto const bracket = text.find('[');
  return place(found.name + ".surface" + (bracket == std::string::npos ? "" : text.substr(bracket)));
}

thermal::Port Assembly::node(Place const& place, int local) const {
  return {thermal::Port::Kind::node, place.first_node + local};
}

thermal::Port Assembly::port(Place const& place) {
  auto const& contacts = place.site.contacts;
  if (contacts.size() == 1) return node(place, contacts.front().node);
  auto const it = averages_.find(place.text);
  if (it != averages_.end()) return it->second;
  thermal::Average average;
  average.name = place.text;
  for (auto const& contact : contacts) {
    average.nodes.push_back(place.first_node + contact.node);
    average.weights.push_back(contact.share);
  }
  return averages_[place.text] = builder_.add_average(std::move(average));
}

thermal::Port Assembly::air(Eigen::Vector3d const& point) {
  double const height = up_.dot(point);
  auto const it = airs_.find(height);
  if (it != airs_.end()) return it->second;
  return airs_[height] = builder_.add_boundary(
             {fmt::format("air at {:g} m", height),
              0.0,
              {{builder_.channel("ambient.floor_temperature"), 1.0}, {builder_.channel("ambient.gradient"), height}}});
}

void Assembly::add_air_terms() {
  for (auto const& [height, port] : airs_)
    for (auto const& term : air_terms_) {
      std::vector<thermal::Boundary::Term> follows;
      if (!term.channel.empty()) follows.push_back({builder_.channel(term.channel), term.rise});
      builder_.add_to_boundary(port, term.gradient * (height - term.reference_height), follows);
    }
}

std::vector<int> Assembly::friction_channels(std::string const& speed) {
  constexpr std::string_view of_axis = ".speed";
  std::string const axis = speed.ends_with(of_axis) ? speed.substr(0, speed.size() - of_axis.size()) : "";
  return {channel(speed), channel(friction_while_moving_.contains(axis) ? axis + ".moving_speed" : speed)};
}

double Assembly::rated_speed(std::optional<double> own, std::string const& channel) const {
  if (own && !(*own > 0.0)) throw InputError("'rated_speed' must be above 0");
  if (!own && !(maximum_spindle_speed_ > 0.0) && !channel.starts_with("spindle."))
    throw InputError(fmt::format("what follows '{}' needs a rated_speed: the machine has no spindle", channel));
  return own.value_or(maximum_spindle_speed_);
}

void Assembly::displace(InputTerm term) {
  if (!std::isfinite(term.coefficient) || !std::isfinite(term.power))
    throw InputError(fmt::format("the displacement '{}' would be {} u^{}, u the input '{}'", term.displacement,
                                 term.coefficient, term.power, term.channel));
  static_cast<void>(channel(term.channel));
  input_terms_.push_back(std::move(term));
}

void Assembly::displace(TemperatureTerm term) {
  if (!std::isfinite(term.coefficient) || !std::isfinite(term.strain))
    throw InputError(fmt::format("the displacement '{}' would change by {} per kelvin of '{}'", term.displacement,
                                 std::isfinite(term.coefficient) ? term.strain : term.coefficient, term.place.text));
  temperature_terms_.push_back(std::move(term));
}

thermal::Port Assembly::boundary(std::string const& channel, double offset) {
  auto const key = std::pair(channel, offset);
  auto const it = boundaries_.find(key);
  if (it != boundaries_.end()) return it->second;
  return boundaries_[key] = builder_.add_boundary({channel, offset, {{builder_.channel(channel), 1.0}}});
}

Assembly::Torque const& Assembly::torque_of(std::string const& part) const {
  auto const it = torques_.find(part);
  if (it != torques_.end()) return it->second;
  std::vector<std::string> names;
  for (auto const& entry : torques_) names.push_back(entry.first);
  throw InputError(fmt::format("no part '{}' with a friction torque stands before this one; {}", part,
                               thermal::did_you_mean(part, names)));
}

}  // namespace thermotwin::twin
