#include "twin/extrapolation_watch.h"

#include <algorithm>
#include <fmt/format.h>
#include <tuple>

namespace thermotwin::twin {
namespace {

constexpr double least_share = 0.01, time_between_looks = 300.0;  // [s]

double distance(thermal::Validity const& range, double number) {
  return std::max(range.lower - number, number - range.upper);
}

}  // namespace

std::string text_of(Extrapolated const& e) {
  return fmt::format("{}: {} is {:.3g}, the law is stated for {:.3g} to {:.3g}; {:.0f} % of all heat moves so", e.part,
                     e.range->number, e.number, e.range->lower, e.range->upper, 100.0 * e.share);
}

void ExtrapolationWatch::look(double time, double const* temperature, double const* input) {
  double const since = time - last_time_;
  last_time_ = time;
  next_time_ = time + time_between_looks;
  for (auto const& group : network_->groups()) {
    if (group.inside) continue;
    auto const batch = group.batch();
    for (int e = 0; e < batch.count; ++e) {
      scratch_.clear();
      double const heat = since * group.law->watch(batch, e, temperature, input, scratch_);
      std::vector<thermal::Validity const*> counted;  // a formula may ask twice
      for (auto const& [range, number] : scratch_) {
        auto const [at, first] = beyond_.try_emplace({group.parts[std::size_t(e)], range}, Beyond{number, 0.0});
        auto& kept = at->second;
        if (distance(*range, number) > distance(*range, kept.number)) kept.number = number;
        if (std::find(counted.begin(), counted.end(), range) != counted.end()) continue;
        kept.heat += heat;
        counted.push_back(range);
      }
    }
  }
}

std::vector<Extrapolated> ExtrapolationWatch::found(double moved) const {
  std::vector<Extrapolated> all;
  for (auto const& [place, beyond] : beyond_)
    if (moved > 0.0 && beyond.heat >= least_share * moved)
      all.push_back({network_->parts()[std::size_t(place.first)], place.second, beyond.number, beyond.heat / moved});
  std::sort(all.begin(), all.end(), [](auto const& a, auto const& b) {
    return std::tuple(-a.share, a.part, a.range->number) < std::tuple(-b.share, b.part, b.range->number);
  });
  return all;
}

}  // namespace thermotwin::twin
