#include "thermal/growth_field.h"

#include <algorithm>

#include "thermal/bounding_box.h"

namespace thermotwin::thermal {
namespace {

using Eigen::Vector3d;

/// Integrals of a function that is linear between its stations, and beyond the outermost ones.
class Antiderivative {
 public:
  Antiderivative(std::vector<double> stations, std::vector<double> values)
      : stations_(std::move(stations)), values_(std::move(values)), once_{0.0}, twice_{0.0} {
    for (std::size_t i = 0; i + 1 < stations_.size(); ++i) {
      double const x = stations_[i + 1];
      auto const [first, second] = from_station(i, x);
      once_.push_back(first);
      twice_.push_back(second);
    }
  }
  /// ∫ f ds and ∫∫ f ds ds, from h to x.
  [[nodiscard]] std::pair<double, double> between(double h, double x) const {
    auto const [once_h, twice_h] = from_station(interval(h), h);
    auto const [once_x, twice_x] = from_station(interval(x), x);
    return {once_x - once_h, twice_x - twice_h - once_h * (x - h)};
  }

 private:
  [[nodiscard]] std::size_t interval(double x) const {
    auto const above = std::upper_bound(stations_.begin(), stations_.end(), x) - stations_.begin();
    return std::size_t(
        std::clamp<std::ptrdiff_t>(above - 1, 0, std::max<std::ptrdiff_t>(0, std::ssize(stations_) - 2)));
  }
  [[nodiscard]] std::pair<double, double> from_station(std::size_t i, double x) const {
    double const t = x - stations_[i];
    double const slope =
        i + 1 < stations_.size() ? (values_[i + 1] - values_[i]) / (stations_[i + 1] - stations_[i]) : 0.0;
    return {once_[i] + t * (values_[i] + t * slope / 2.0),
            twice_[i] + t * (once_[i] + t * (values_[i] / 2.0 + t * slope / 6.0))};
  }

  std::vector<double> stations_, values_, once_, twice_;
};

struct Motion {
  Vector3d shift{0.0, 0.0, 0.0}, rotation{0.0, 0.0, 0.0};
};

/// One body, held somewhere.
class Growth {
 public:
  Growth(GrowingBody const& body, std::span<double const> rise, Motion const& held) : body_(body), held_(held) {
    int const directions = body.shape == Body::Shape::axial ? 1 : 3;
    for (int d = 0; d < directions; ++d) add_sections(d, rise);
  }

  [[nodiscard]] Motion at(Vector3d const& place) const {
    Motion motion{held_.shift + held_.rotation.cross(place - body_.held_at), held_.rotation};
    Vector3d const x = place - body_.origin, h = body_.held_at - body_.origin;
    for (auto const& sections : sections_) {
      double const to = x.dot(sections.normal), from = h.dot(sections.normal);
      motion.shift += sections.mean.between(from, to).first * sections.normal;
      for (auto const& bend : sections.bends) {
        auto const [tilt, deflection] = bend.gradient.between(from, to);
        motion.shift += (x.dot(bend.across) - bend.middle) * tilt * sections.normal - deflection * bend.across;
        motion.rotation += tilt * bend.across.cross(sections.normal);
      }
    }
    return motion;
  }

  [[nodiscard]] Vector3d node(int i, int j, int k) const {
    auto const& s = body_.stations;
    if (body_.shape == Body::Shape::axial) return body_.origin + s[0][std::size_t(i)] * body_.axis;
    return body_.origin + Vector3d(s[0][std::size_t(i)], s[1][std::size_t(j)], s[2][std::size_t(k)]);
  }

 private:
  struct Bend {
    Vector3d across;
    double middle;
    Antiderivative gradient;
  };
  struct Sections {
    Vector3d normal;
    Antiderivative mean;
    std::vector<Bend> bends;
  };

  void add_sections(int d, std::span<double const> rise);

  GrowingBody const& body_;
  Motion held_;
  std::vector<Sections> sections_;
};

int count(GrowingBody const& body, int d) { return std::max(1, int(body.stations[std::size_t(d)].size())); }

/// Calls visit(place in the grid, node of the body), in the order of the nodes.
template <class Visit>
void for_cells(GrowingBody const& body, Visit visit) {
  int node = 0;
  if (body.shape == Body::Shape::axial) {
    for (int i = 0; i < count(body, 0); ++i)
      for (int j = 0; j < count(body, 1); ++j) visit(std::array{i, j, 0}, node++);
  } else {
    for (int k = 0; k < count(body, 2); ++k)
      for (int j = 0; j < count(body, 1); ++j)
        for (int i = 0; i < count(body, 0); ++i) visit(std::array{i, j, k}, node++);
  }
}

double middle_of(std::vector<double> const& stations) { return 0.5 * (stations.front() + stations.back()); }

/// Σ w θ ξ/Σ w ξ² in each section across d, with ξ = 1 or, if e ≥ 0, the distance from the middle along e; times α.
std::vector<double> section_values(GrowingBody const& body, std::span<double const> rise, int d, int e) {
  std::vector<double> sums(std::size_t(count(body, d)), 0.0), squares(sums);
  for_cells(body, [&](std::array<int, 3> const& place, int node) {
    auto const section = std::size_t(place[std::size_t(d)]);
    double xi = 1.0;
    if (e >= 0) {
      auto const& stations = body.stations[std::size_t(e)];
      xi = stations[std::size_t(place[std::size_t(e)])] - middle_of(stations);
    }
    double const weight = body.weights[std::size_t(node)];
    sums[section] += weight * xi * rise[std::size_t(body.first_node + node)];
    squares[section] += weight * xi * xi;
  });
  for (std::size_t s = 0; s < sums.size(); ++s)
    sums[s] = squares[s] > 0.0 ? body.expansion * sums[s] / squares[s] : 0.0;
  return sums;
}

void Growth::add_sections(int d, std::span<double const> rise) {
  auto const& stations = body_.stations[std::size_t(d)];
  bool const axial = body_.shape == Body::Shape::axial;
  Sections sections{axial ? body_.axis : Vector3d(Vector3d::Unit(d)),
                    Antiderivative(stations, section_values(body_, rise, d, -1)),
                    {}};
  for (int e = 0; e < 3 && !axial; ++e)
    if (e != d)
      sections.bends.push_back({Vector3d::Unit(e), middle_of(body_.stations[std::size_t(e)]),
                                Antiderivative(stations, section_values(body_, rise, d, e))});
  sections_.push_back(std::move(sections));
}

}  // namespace

GrowingBody growing_body(Body const& body, int first_node, double expansion) {
  GrowingBody growing{body.shape, body.origin, body.axis, body.stations, body.capacities, first_node,
                      expansion,  -1,          {}};
  if (body.shape == Body::Shape::lump)
    for (int d = 0; d < 3; ++d) growing.stations[std::size_t(d)] = {0.5 * bounding_box(body.cells).sizes()[d]};
  return growing;
}

Vector3d lower_face(Body const& body, Vector3d const& up) {
  auto const box = bounding_box(body.cells);
  return box.center() - 0.5 * box.sizes().dot(up) * up;
}

Vector3d contact_centre(Body const& body, Body const& carrier) {
  auto const own = bounding_box(body.cells), other = bounding_box(carrier.cells);
  Vector3d const low = own.min().cwiseMax(other.min()), high = own.max().cwiseMin(other.max());
  Vector3d centre = 0.5 * (low + high);
  for (int d = 0; d < 3; ++d)
    if (low[d] > high[d]) centre[d] = own.min()[d] > other.max()[d] ? own.min()[d] : own.max()[d];
  return centre;
}

Eigen::Matrix3Xd growth_field(std::vector<GrowingBody> const& bodies, std::span<double const> rise) {
  Eigen::Matrix3Xd field = Eigen::Matrix3Xd::Zero(3, Eigen::Index(rise.size()));
  std::vector<Growth> grown;
  for (auto const& body : bodies) {
    Motion const held = body.carrier < 0 ? Motion{} : grown.at(std::size_t(body.carrier)).at(body.held_at);
    auto const& growth = grown.emplace_back(body, rise, held);
    for_cells(body, [&](std::array<int, 3> const& place, int node) {
      field.col(body.first_node + node) = growth.at(growth.node(place[0], place[1], place[2])).shift;
    });
  }
  return field;
}

}  // namespace thermotwin::thermal
