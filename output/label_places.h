#pragma once

#include <Eigen/Core>
#include <vector>

namespace thermotwin::output {

/// A name beside a dot: where the dot is and how large the name, in pixels, y upwards.
struct Label {
  Eigen::Vector2d dot;
  Eigen::Vector2d size;
};

/// Lower left corners of the names, each as near to its dot as there is room beside the other names and all dots: the
/// first places its name first. A name that finds no room stands where it would alone.
[[nodiscard]] std::vector<Eigen::Vector2d> label_places(std::vector<Label> const& labels, double dot_radius,
                                                        Eigen::Vector2d const& page);

}  // namespace thermotwin::output
