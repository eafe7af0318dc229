#include "twin/placement/snapshot_moments.h"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "models/placement.h"
#include "tests/twin/random_machine.h"
#include "thermal/error.h"
#include "twin/file/value.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;

/// A sensor in every place that moves the tool leaves what the uncertain growth of the parts and its noise leave.
TEST(SnapshotMoments, ForetellTheErrorOnMachinesThatTookNoPart) {
  RandomMachine const machine(5);
  auto const document = parse_toml(machine.text(), "random");
  std::vector<CandidateSite> sites;
  for (auto const& body : machine.bodies()) sites.push_back({body, {body}});
  EnsembleOptions options;
  options.members = 60;
  auto const design = draw_ensemble(document, sites, options);
  options.seed = 5000;
  auto const unseen = draw_ensemble(document, sites, options);
  SnapshotMoments const moments(design, 0.1);
  auto const problem = moments.problem(Index(sites.size()));
  auto const set = models::place(problem, 4).sensors;
  double const predicted = moments.cross_validated(set).mean_square.sum();
  double const realised = error_on(unseen, moments.estimate(set), moments.noise_variance()).mean_square.sum();
  EXPECT_NEAR(predicted / realised, 1.0, 0.25);  // 60 machines, so 20 % of chance
  EXPECT_GT(predicted, models::remaining_variance(problem, set));
  EXPECT_NEAR(error_on(design, moments.estimate(set), moments.noise_variance()).mean_square.sum(),
              models::remaining_variance(problem, set), 1e-6 * problem.prior());
}

/// A displacement that follows one site, in every machine with a gain of its own: trained on the machine, a sensor
/// there leaves little more than its noise; one estimate for all machines is left with what the gains differ by.
TEST(SnapshotMoments, OfMachinesThatTeachThemselvesKnowTheirGains) {
  constexpr Index rows = 60, members = 8;
  Ensemble ensemble;
  ensemble.channels = {"E"};
  ensemble.rise.resize(rows * members, 1);
  ensemble.displacement.resize(rows * members, 1);
  for (Index m = 0; m < members; ++m) {
    for (int run = 0; run < 2; ++run) ensemble.runs.push_back({int(m), "", m * rows + run * (rows / 2), rows / 2});
    for (Index r = 0; r < rows; ++r) {
      ensemble.rise(m * rows + r, 0) = 10.0 * std::sin(0.3 * double(r));
      ensemble.displacement(m * rows + r, 0) = (2.0 + 0.2 * double(m % 2)) * ensemble.rise(m * rows + r, 0);
    }
  }
  SnapshotMoments const family(ensemble, 0.1), machine(ensemble, 0.1, Teacher::machine);
  EXPECT_EQ(machine.groups().size(), std::size_t(members));
  Index const site = 0;
  double const noise = 0.1 * 2.1, spread = 0.1 * 10.0 * std::sqrt(0.5);
  EXPECT_NEAR(std::sqrt(models::remaining_variance(machine.problem(1), {&site, 1})), noise, 0.02 * noise);
  EXPECT_NEAR(std::sqrt(models::remaining_variance(family.problem(1), {&site, 1})), std::hypot(noise, spread),
              0.05 * spread);
  EXPECT_NEAR(std::sqrt(machine.cross_validated({&site, 1}).mean_square.sum()), noise, 0.05 * noise);
  EXPECT_NEAR(std::sqrt(machine.unseen(ensemble, {&site, 1}).of_members[3]), 0.1 * 2.2, 0.05 * noise);
  ensemble.runs.resize(1);
  EXPECT_THROW(SnapshotMoments(ensemble, 0.1, Teacher::machine), thermal::InputError);
}

}  // namespace
}  // namespace thermotwin::twin
