#include "output/label_places.h"

#include <Eigen/Geometry>
#include <array>

namespace thermotwin::output {
namespace {

using Box = Eigen::AlignedBox2d;

constexpr int rings = 12;
constexpr int line_points = 16;  // at which a line to a dot is looked at

/// Which point of the name looks at the dot: right above first, then around.
constexpr std::array<std::array<double, 2>, 12> sides = {{{1, 0.4},
                                                          {1, -0.4},
                                                          {-1, 0.4},
                                                          {-1, -0.4},
                                                          {1, 1},
                                                          {1, -1},
                                                          {-1, 1},
                                                          {-1, -1},
                                                          {0.3, 1},
                                                          {0.3, -1},
                                                          {-0.3, 1},
                                                          {-0.3, -1}}};

/// The name of a dot on one of its sides, so many dots' radii away.
Box placed(Label const& label, std::array<double, 2> const& side, double gap) {
  Eigen::Vector2d const direction(side[0], side[1]);
  Eigen::Vector2d const centre =
      label.dot + gap * direction.normalized() + 0.5 * label.size.cwiseProduct(direction.cwiseMin(1.0).cwiseMax(-1.0));
  return {centre - 0.5 * label.size, centre + 0.5 * label.size};
}

bool is_free(Box const& box, Eigen::Vector2d const& dot, std::vector<Box> const& taken, std::size_t n_dots) {
  for (auto const& other : taken)
    if (!box.intersection(other).isEmpty()) return false;
  for (int i = 1; i < line_points; ++i) {
    Eigen::Vector2d const point = dot + double(i) / line_points * (box.center() - dot);
    for (std::size_t k = n_dots; k < taken.size(); ++k)
      if (taken[k].contains(point)) return false;
  }
  return true;
}

}  // namespace

std::vector<Eigen::Vector2d> label_places(std::vector<Label> const& labels, double dot_radius,
                                          Eigen::Vector2d const& page) {
  Box const whole(Eigen::Vector2d::Zero(), page);
  std::vector<Box> taken;
  for (auto const& label : labels) taken.emplace_back(label.dot.array() - dot_radius, label.dot.array() + dot_radius);
  std::vector<Eigen::Vector2d> places;
  for (auto const& label : labels) {
    Box chosen = placed(label, sides[0], 1.5 * dot_radius);
    bool found = false;
    for (int ring = 0; ring < rings && !found; ++ring)
      for (auto const& side : sides) {
        Box const box = placed(label, side, (1.5 + 1.5 * ring) * dot_radius);
        found = whole.contains(box) && is_free(box, label.dot, taken, labels.size());
        if (!found) continue;
        chosen = box;
        break;
      }
    places.push_back(chosen.min());
    taken.push_back(chosen);
  }
  return places;
}

}  // namespace thermotwin::output
