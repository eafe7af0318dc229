#pragma once

#include "output/dataset.h"

namespace thermotwin::tests {

/// Inputs, readings and displacements as a logger has them that was switched on so many rows late.
inline output::Dataset without_first(Eigen::Index rows, output::Dataset const& data) {
  Eigen::Index const left = data.time_s.size() - rows;
  output::Dataset late;
  late.time_s = data.time_s.tail(left);
  late.inputs = data.inputs;
  late.readings = data.readings;
  late.displacements = data.displacements;
  for (auto* group : {&late.inputs, &late.readings, &late.displacements})
    for (auto& channel : *group) channel.values = channel.values.tail(left).eval();
  return late;
}

}  // namespace thermotwin::tests
