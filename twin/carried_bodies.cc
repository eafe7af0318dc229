#include "twin/carried_bodies.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

#include "thermal/error.h"
#include "thermal/nearest_name.h"

namespace thermotwin::twin {
namespace {

using thermal::InputError;

class Chain {
 public:
  Chain(std::vector<HungBody> const& bodies, Eigen::Vector3d const& up) : bodies_(bodies), up_(up) {}

  /// Index of a body in the result, once those that carry it are there.
  int place(HungBody const& hung) {
    auto const [it, first_visit] = placed_.insert({hung.name, on_the_way});
    if (!first_visit) {
      if (it->second == on_the_way)
        throw InputError(fmt::format("'{}' is carried by what it carries itself", hung.name));
      return it->second;
    }
    auto growing = thermal::growing_body(*hung.body, hung.first_node, hung.expansion);
    growing.held_at = thermal::lower_face(*hung.body, up_);
    if (!hung.description.carried_by.empty()) {
      auto const& carrier = find(hung.description.carried_by);
      growing.carrier = place(carrier);
      growing.held_at = thermal::contact_centre(*hung.body, *carrier.body);
    }
    if (hung.description.held_at) growing.held_at = *hung.description.held_at;
    result.push_back(std::move(growing));
    return placed_[hung.name] = int(result.size()) - 1;
  }

  std::vector<thermal::GrowingBody> result;

 private:
  static constexpr int on_the_way = -1;

  HungBody const& find(std::string const& name) const {
    auto const it = std::find_if(bodies_.begin(), bodies_.end(), [&](auto const& b) { return b.name == name; });
    if (it != bodies_.end()) return *it;
    std::vector<std::string> names;
    for (auto const& body : bodies_) names.push_back(body.name);
    throw InputError(fmt::format("unknown body '{}'; {}", name, thermal::did_you_mean(name, names)));
  }

  std::vector<HungBody> const& bodies_;
  Eigen::Vector3d up_;
  std::map<std::string, int> placed_;
};

}  // namespace

std::vector<thermal::GrowingBody> carried_bodies(std::vector<HungBody> const& bodies, Eigen::Vector3d const& up) {
  Chain chain(bodies, up);
  for (auto const& body : bodies) chain.place(body);
  return std::move(chain.result);
}

}  // namespace thermotwin::twin
