#include "twin/volumetric/geometric_errors.h"

#include <algorithm>
#include <fmt/format.h>
#include <numbers>

#include "thermal/error.h"
#include "thermal/nearest_name.h"
#include "twin/instruments/random_stream.h"

namespace thermotwin::twin {
namespace {

constexpr std::string_view components = "XYZABC", axes = "XYZ";

std::string name_of(int axis, int component) {
  return fmt::format("E{}{}", components[std::size_t(component)], axes[std::size_t(axis)]);
}

double size_of(ErrorSize const& size, int axis, int component) {
  if (component >= 3) return size.angular;
  return component == axis ? size.linear : size.straightness;
}

ErrorCourse drawn(ErrorCourse course, double size, bool with_line, RandomStream random) {
  double const line = with_line ? size * random.normal() : 0.0, bend = size * random.normal();
  course.polynomial = {0.0, line - bend, bend};
  for (int k = 1; k <= 2; ++k) {
    double const amplitude = 0.5 * size * random.normal();
    double const phase = random.uniform(0.0, 2.0 * std::numbers::pi);
    course.harmonics.push_back({amplitude, 2.0 * (course.to - course.from) / k, phase});
  }
  return course;
}

}  // namespace

CarriageError GeometricErrors::at(int axis, double q) const {
  auto const& own = courses[std::size_t(axis)];
  return {{own[0](q), own[1](q), own[2](q)}, {own[3](q), own[4](q), own[5](q)}};
}

GeometricErrors no_errors(Workspace const& workspace) {
  GeometricErrors errors;
  for (int axis = 0; axis < 3; ++axis)
    errors.courses[std::size_t(axis)].fill({workspace.from[axis], workspace.to[axis], {}, {}, {}});
  return errors;
}

std::vector<std::string> element_names() {
  std::vector<std::string> names;
  for (int axis = 0; axis < 3; ++axis)
    for (int component = 0; component < 6; ++component) names.push_back(name_of(axis, component));
  return names;
}

ElementPlace element_place(std::string_view name) {
  auto const names = element_names();
  auto const it = std::find(names.begin(), names.end(), name);
  if (it == names.end())
    throw thermal::InputError(
        fmt::format("unknown error element '{}'; {}", name, thermal::did_you_mean(std::string(name), names)));
  int const index = int(it - names.begin());
  return {index / 6, index % 6};
}

GeometricErrors draw_errors(Workspace const& workspace, ErrorSize const& size, std::uint64_t seed) {
  GeometricErrors errors = no_errors(workspace);
  for (int axis = 0; axis < 3; ++axis)
    for (int c = 0; c < 6; ++c) {
      auto& course = errors.courses[std::size_t(axis)][std::size_t(c)];
      bool const with_line = c == axis || c >= 3;
      course = drawn(course, size_of(size, axis, c), with_line, RandomStream(seed, "volumetric/" + name_of(axis, c)));
    }
  constexpr std::array<char const*, 3> pairs = {"XY", "XZ", "YZ"};
  for (int i = 0; i < 3; ++i) {
    RandomStream random(seed, fmt::format("volumetric/squareness_{}", pairs[std::size_t(i)]));
    errors.squareness[i] = size.squareness * random.normal();
  }
  return errors;
}

}  // namespace thermotwin::twin
