#include "twin/compensation/model_clock.h"

#include <algorithm>

namespace thermotwin::twin {
namespace {

constexpr double drift = 1e-3;

}  // namespace

ModelClock::ModelClock(double speed, double tolerance, std::size_t senders)
    : speed_(speed), tolerance_(tolerance), leads_(senders, {never, never}), most_have_(never), ahead_(never) {}

void ModelClock::hear(std::size_t sender, double lead) {
  auto& [last, largest] = leads_[sender];
  double const confirmed = last == never ? lead : std::min(lead, last);
  last = lead;
  if (confirmed <= largest) return;
  largest = confirmed;
  std::vector<double> all;
  for (auto const& leads : leads_) all.push_back(leads.largest);
  auto const median = all.begin() + std::ptrdiff_t(all.size() - 1) / 2;
  std::nth_element(all.begin(), median, all.end());
  most_have_ = *median;
}

bool ModelClock::heard(std::size_t sender) const { return leads_[sender].last > never; }
bool ModelClock::started() const { return ahead_ > never; }

void ModelClock::follow(double lead, double wall) {
  if (!started()) wall_ = wall;
  ahead_ = std::max(ahead_ - drift * speed_ * std::max(0.0, wall - wall_), lead);
  wall_ = std::max(wall_, wall);
}

}  // namespace thermotwin::twin
