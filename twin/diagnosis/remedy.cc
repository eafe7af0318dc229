#include "twin/diagnosis/remedy.h"

#include <algorithm>
#include <cmath>

#include "twin/diagnosis/diagnosis.h"
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

double least_distance(Eigen::MatrixXd const& products, Rivals const& rivals) {
  double least = INFINITY;
  for (std::size_t i = 0; i < rivals.hypotheses.size(); ++i)
    for (std::size_t j = 0; j < rivals.hypotheses.size(); ++j)
      if (i != j) least = std::min(least, apart(products, Eigen::Index(i), Eigen::Index(j), rivals.amplitudes[i]));
  return least;
}

}  // namespace

std::vector<Remedy> remedies(Value const& document, std::vector<BinnedRun> const& runs, Rivals const& rivals) {
  Machine const machine = Machine::build(document);
  Value const extended = with_added_sensors(document, machine);
  Machine const observed = Machine::build(extended);
  auto const schedules = separating_schedules(machine);
  std::vector<MeasuredRun> further;
  for (auto const& schedule : schedules) further.push_back(simulated_run(observed, schedule));
  std::vector<BinnedRun> all = runs;
  for (auto& run : binned(further)) all.push_back(std::move(run));
  Estimation const estimation = expected_estimation(extended, all);
  Fit const fit = estimation.fit(estimation.prior_mean(), 0);
  Eigen::MatrixXd columns = signatures(estimation, fit, rivals.hypotheses);
  estimation.whiten(columns);
  Separation const separation(estimation, fit, columns);

  auto const& channels = estimation.channels();
  std::vector<Remedy> found;
  for (std::size_t s = 0; s < schedules.size(); ++s)
    for (std::size_t c = 0; c <= channels.size(); ++c) {
      bool const sensor = c < channels.size();
      if (sensor && !channels[c].starts_with(added)) continue;
      Blocks use{std::vector<bool>(all.size(), false), std::vector<bool>(channels.size())};
      for (std::size_t r = 0; r < runs.size(); ++r) use.runs[r] = true;
      use.runs[runs.size() + s] = true;
      for (std::size_t k = 0; k < channels.size(); ++k) use.channels[k] = k == c || !channels[k].starts_with(added);
      found.push_back({schedules[s].name(), schedules[s].file, schedules[s].hours(),
                       sensor ? channels[c].substr(added.size()) : "",
                       least_distance(separation.products(use), rivals)});
    }
  std::stable_sort(found.begin(), found.end(), [](auto const& a, auto const& b) { return a.distance > b.distance; });
  return found;
}

}  // namespace thermotwin::twin
