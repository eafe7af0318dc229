#include "models/shared_screen.h"

#include "models/ranking.h"

namespace thermotwin::models {

using Eigen::Index;

std::shared_ptr<SharedScreen> shared_screen(SelectionOptions const& options) {
  return options.shared ? options.shared : std::make_shared<SharedScreen>();
}

InformationScreen const& SharedScreen::screen(Candidates const& from, SelectionOptions const& options) {
  std::call_once(screened_, [&] {
    screen_ = screen_by_information(from, options.seed, options.information);
    ++made_;
  });
  return screen_;
}

OrderedCandidates const& SharedScreen::ordered(Candidates const& from, SelectionOptions const& options, bool all) {
  std::size_t const which = all ? 1 : 0;
  std::call_once(parted_[which], [&] {
    auto const clustered = all ? first_numbers(from.count()) : screen(from, options).kept;
    std::vector<Index> order;
    for (Index const place : ascending(from.all.temperature_rise(Eigen::all, clustered)))
      order.push_back(clustered[static_cast<std::size_t>(place)]);
    auto const objects = normalised(from.all.temperature_rise(Eigen::all, order), options.normalisation);
    OrderedPartitions partitions(class_diameters(objects));
    ordered_[which].emplace(OrderedCandidates{std::move(order), std::move(partitions)});
    ++made_;
  });
  return *ordered_[which];
}

FuzzyPartitions& SharedScreen::fuzzy(Candidates const& from, std::uint64_t seed, ClusterScale scale) {
  auto const which = static_cast<std::size_t>(scale);
  std::call_once(scaled_[which], [&] {
    FuzzyOptions options;
    options.seed = seed;
    fuzzy_[which].emplace(course_points(from, scale), options);
  });
  return *fuzzy_[which];
}

int SharedScreen::made() const {
  int made = made_;
  for (auto const& partitions : fuzzy_) made += partitions ? partitions->made() : 0;
  return made;
}

}  // namespace thermotwin::models
