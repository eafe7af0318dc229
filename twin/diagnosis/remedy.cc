#include "twin/diagnosis/remedy.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "twin/diagnosis/expected_noise.h"
#include "twin/diagnosis/run_files.h"
#include "twin/diagnosis/schedule.h"
#include "twin/diagnosis/score.h"
#include "twin/diagnosis/separation.h"
#include "twin/file/document.h"

namespace thermotwin::twin {
namespace {

constexpr std::string_view added = "added.";

/// The machine with a sensor more on every body.
Value with_added_sensors(Value document, Machine const& machine) {
  for (auto const& body : machine.geometry) {
    Location const where{document.where.file, 1'000'000, 1};
    append_table(document, "temperature_sensor",
                 make_table(where, {{"name", std::string(added) + body.name}, {"at", body.name}, {"kind", "pt100"}}));
  }
  return document;
}

/// `first`: column of the first rival in `products`.
double least_distance(Eigen::MatrixXd const& products, Eigen::Index first, Rivals const& rivals) {
  double least = INFINITY;
  auto const count = Eigen::Index(rivals.hypotheses.size());
  for (Eigen::Index i = 0; i < count; ++i) {
    double const amplitude = rivals.amplitudes[std::size_t(i)];
    least = std::min(least, seen(products, first + i, amplitude));
    for (Eigen::Index j = 0; j < count; ++j)
      if (i != j) least = std::min(least, apart(products, first + i, first + j, amplitude));
  }
  return least;
}

}  // namespace

std::vector<std::vector<Remedy>> remedies(Value const& document, std::vector<BinnedRun> const& runs,
                                          std::vector<Rivals> const& rivals) {
  Machine const machine = Machine::build(document);
  Value const extended = with_added_sensors(document, machine);
  Machine const observed = Machine::build(extended);
  auto const schedules = separating_schedules(machine, runs);
  std::vector<MeasuredRun> further;
  for (auto const& schedule : schedules) further.push_back(simulated_run(observed, schedule));
  std::vector<BinnedRun> all = runs;
  for (auto& run : binned(further)) all.push_back(std::move(run));
  std::vector<Hypothesis> hypotheses;
  for (auto const& group : rivals)
    hypotheses.insert(hypotheses.end(), group.hypotheses.begin(), group.hypotheses.end());
  Estimation const estimation = expected_estimation(extended, all);
  Fit const fit = estimation.fit(estimation.prior_mean(), 0);
  Eigen::MatrixXd columns = signatures(estimation, fit, hypotheses);
  estimation.whiten(columns);
  Separation const separation(estimation, fit, columns);

  auto const& channels = estimation.channels();
  std::vector<std::vector<Remedy>> found(rivals.size());
  for (std::size_t s = 0; s < schedules.size(); ++s)
    for (std::size_t c = 0; c <= channels.size(); ++c) {
      bool const sensor = c < channels.size();
      if (sensor && !channels[c].starts_with(added)) continue;
      Blocks use{std::vector<bool>(all.size(), false), std::vector<bool>(channels.size())};
      for (std::size_t r = 0; r < runs.size(); ++r) use.runs[r] = true;
      use.runs[runs.size() + s] = true;
      for (std::size_t k = 0; k < channels.size(); ++k) use.channels[k] = k == c || !channels[k].starts_with(added);
      Eigen::MatrixXd const products = separation.products(use);
      Eigen::Index first = 0;
      for (std::size_t g = 0; g < rivals.size(); ++g) {
        found[g].push_back({schedules[s].name(), schedules[s].file, schedules[s].hours(),
                            sensor ? channels[c].substr(added.size()) : "",
                            least_distance(products, first, rivals[g])});
        first += Eigen::Index(rivals[g].hypotheses.size());
      }
    }
  for (auto& list : found)
    std::stable_sort(list.begin(), list.end(), [](auto const& a, auto const& b) { return a.distance > b.distance; });
  return found;
}

nlohmann::ordered_json json_of(Remedy const& remedy) {
  return {{"experiment", remedy.schedule},
          {"file", remedy.file.string()},
          {"hours", remedy.hours},
          {"added_sensor", remedy.sensor},
          {"distance", remedy.distance}};
}

}  // namespace thermotwin::twin
