#include "twin/input_motion.h"

#include <cmath>

namespace thermotwin::twin {

InputMotion::InputMotion(std::vector<InputTerm> const& terms, thermal::Course const& course) {
  for (auto const& term : terms)
    if (int const channel = course.index_of(term.channel); channel >= 0)
      terms_.push_back({std::size_t(channel), term.coefficient, term.power});
}

double InputMotion::operator()(std::span<double const> inputs, std::span<double const> at_start) const {
  double sum = 0.0;
  for (auto const& [channel, coefficient, power] : terms_)
    sum += coefficient * (std::pow(inputs[channel], power) - std::pow(at_start[channel], power));
  return sum;
}

}  // namespace thermotwin::twin
