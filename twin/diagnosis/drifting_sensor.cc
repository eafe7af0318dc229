#include "twin/diagnosis/drifting_sensor.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <map>
#include <string>

#include "thermal/bounding_box.h"
#include "twin/assembly.h"
#include "twin/bodies.h"
#include "twin/diagnosis/birge_ratio.h"
#include "twin/diagnosis/score.h"
#include "twin/file/tables.h"

namespace thermotwin::twin {
namespace {

constexpr double air_slow = 0.02;         // what is not known of the air around a sensor [K]
constexpr double way_of_range = 0.5;      // of what is expected of a range, for the way from the start
constexpr double share_of_slab = 0.02;    // of what a slab of a lump's longest edge would show, for the same
constexpr double least_statistic = 13.0;  // T of a drift
constexpr int most_drifting = 2;          // beyond, something else pulls at all of them
constexpr double seconds_a_day = 86400.0;

/// By how much more than its mean the face of a slab rises that was heated through it for a time t, L²/(3 α t), L: the
/// longest edge of a lump; of every sensor on one (Carslaw & Jaeger, Conduction of Heat in Solids, 2nd ed. 1959, 3.8).
std::map<std::string, double> unevenness_after(double t, Value const& document) {
  Tables tables(document);
  Bodies const bodies(tables);
  std::map<std::string, double> shares;
  for (auto const& [sensor, table] : tables.read<SensorDescription>("temperature_sensor"))
    for (auto const& place : sensor.at) {
      auto const body = bodies.all().find(body_of(place));
      if (body == bodies.all().end() || body->second.nodes() > 1) continue;
      auto const* material = bodies.material_of(body->first);
      if (!material) continue;
      double const edge = thermal::bounding_box(body->second.cells).sizes().maxCoeff();
      double& share = shares[sensor.name];
      share = std::max(share, edge * edge / (3.0 * thermal::diffusivity(*material) * t));
    }
  return shares;
}

/// The question to the same runs when a model is taken to be the better the nearer the machine is to rest.
Estimation with_rest(Estimation const& estimation, std::vector<Hypothesis> const& drifts) {
  auto noise = estimation.noise();
  auto unevenness = unevenness_after(noise[0].slow_time, estimation.document());
  for (std::size_t c = 0; c < noise.size(); ++c) {
    auto const reads = [&](Hypothesis const& drift) { return drift.body == estimation.channels()[c]; };
    if (std::none_of(drifts.begin(), drifts.end(), reads)) continue;
    noise[c].way_share =
        std::max(way_of_range * noise[c].slow_share, share_of_slab * unevenness[estimation.channels()[c]]);
    noise[c].slow_share = 0.0;
    noise[c].slow += air_slow;
  }
  return estimation.with(noise);
}

/// Whether a sensor sits elsewhere than the file says, evidently: what it shows as the machine warms is another's then.
bool has_left_its_place(std::string const& sensor, Estimation const& estimation, Fit const& fit) {
  auto const& unknowns = estimation.unknowns();
  for (std::size_t u = 0; u < unknowns.size(); ++u)
    if (unknowns[u].kind == Unknown::Kind::place && estimation.places()[unknowns[u].index].sensor == sensor &&
        unknowns[u].departure(fit.x[Eigen::Index(u)]) > far_from_file)
      return true;
  return false;
}

}  // namespace

std::optional<FaultySensor> drifting_sensor(Estimation const& estimation, Fit const& calibrated,
                                            std::vector<Hypothesis> const& hypotheses) {
  auto const sensors = Machine::build(estimation.document()).sensors;
  auto const is_drift = [&](Hypothesis const& h) {
    auto const touches = [&](Sensor const& sensor) {
      return sensor.description.name == h.body && !sensor.weights.empty();
    };
    return h.effect->name == "sensor_drift" && std::any_of(sensors.begin(), sensors.end(), touches);
  };
  auto const is_of_machine = [](Hypothesis const& h) { return !h.is_about("sensor"); };
  std::vector<Hypothesis> drifts;
  std::copy_if(hypotheses.begin(), hypotheses.end(), std::back_inserter(drifts), is_drift);
  if (drifts.empty()) return std::nullopt;
  Estimation const resting = with_rest(estimation, drifts);
  Fit const fit = resting.fit(calibrated.x, 6);
  auto const scores_of = [&](std::vector<Hypothesis> const& tried) {
    Eigen::MatrixXd columns = signatures(resting, fit, tried);
    resting.whiten(columns);
    return Remainder(fit, columns).scores(tried);
  };
  auto const scores = scores_of(drifts);
  auto const clearest = std::max_element(scores.begin(), scores.end(),
                                         [](Score const& a, Score const& b) { return a.statistic < b.statistic; });
  auto const drifting =
      std::count_if(scores.begin(), scores.end(), [](Score const& s) { return s.statistic >= least_statistic; });
  bool const clear = clearest->statistic >= least_statistic * strictness(estimation, calibrated);
  if (!clear || drifting > most_drifting) return std::nullopt;
  auto const& drift = drifts[std::size_t(clearest - scores.begin())];
  if (has_left_its_place(drift.body, estimation, calibrated)) return std::nullopt;
  std::vector<Hypothesis> others;
  std::copy_if(hypotheses.begin(), hypotheses.end(), std::back_inserter(others), is_of_machine);
  auto const rivals = scores_of(others);
  double const evidence = evidence_of(*clearest, drift);
  for (std::size_t k = 0; k < others.size(); ++k)
    if (evidence_of(rivals[k], others[k]) > evidence) return std::nullopt;
  double const unit = drift.largest * seconds_a_day;
  return FaultySensor{drift.body, fmt::format("drifts by {:.2f} ± {:.2f} K a day, which shows where the machine rests",
                                              clearest->amplitude * unit, unit / std::sqrt(clearest->information))};
}

}  // namespace thermotwin::twin
