#include "thermal/course_inputs.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string>

#include "thermal/error.h"
#include "thermal/nearest_name.h"
#include "thermal/units.h"

namespace thermotwin::thermal {
namespace {

void check_unit(Network const& network, InputChannel const& channel) {
  auto const& shares = network.shares();
  if (std::find(shares.begin(), shares.end(), channel.name) == shares.end()) return;
  if (dimension_of(channel.unit) == dimension::dimensionless) return;
  throw InputError(
      fmt::format("the machine takes the input '{}' as a share between 0 and 1, and the experiment gives it in {}; a "
                  "share is for example machine.on or spindle.running",
                  channel.name, channel.unit));
}

}  // namespace

CourseInputs::CourseInputs(Network const& network, Course const& course)
    : course_(&course), raw_(course.channels().size()), values_(std::size_t(network.channels())) {
  std::vector<std::string> given;
  for (auto const& channel : course.channels()) given.push_back(channel.name);
  for (int i = 0; i < network.external_channels(); ++i) {
    auto const& name = network.channel_names()[std::size_t(i)];
    auto const it = std::find(given.begin(), given.end(), name);
    if (it == given.end())
      throw InputError(fmt::format("the machine needs the input '{}', which the experiment does not give; {}", name,
                                   did_you_mean(name, given)));
    source_.push_back(std::size_t(it - given.begin()));
    check_unit(network, course.channels()[source_.back()]);
  }
}

double CourseInputs::enter_piece(double t) {
  start_ = t;
  end_ = course_->next_jump(t);
  known_ = std::numeric_limits<double>::quiet_NaN();
  return end_;
}

std::vector<double> const& CourseInputs::at(double t) {
  if (t == known_) return values_;
  course_->evaluate(t < end_ ? t : std::nextafter(end_, start_), raw_);
  for (std::size_t i = 0; i < source_.size(); ++i) values_[i] = raw_[source_[i]];
  known_ = t;
  return values_;
}

}  // namespace thermotwin::thermal
