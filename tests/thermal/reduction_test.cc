#include "thermal/reduction.h"

#include <gtest/gtest.h>

#include "tests/thermal/random_network.h"
#include "thermal/block.h"
#include "thermal/body.h"
#include "thermal/error.h"
#include "thermal/reduced_integration.h"
#include "thermal/reduced_sums.h"

namespace thermotwin::thermal {
namespace {

/// A block of cast iron with free convection on all faces, and friction between two of its cells.
struct HeatedBlock {
  Network network;
  int sensor = 0;
};

HeatedBlock heated_block() {
  NetworkBuilder builder;
  int const part = builder.part("block"), friction = builder.part("friction");
  Block shape;
  shape.size = {0.4, 0.3, 0.2};
  shape.cells = {8, 6, 4};
  shape.material = material("GJL-250");
  Body const body = make_body("block", shape);
  add_to(builder, part, body);
  Port const air = builder.add_boundary({"air", 0.0, {{builder.channel("air"), 1.0}}});
  for (auto const& [name, facets] : body.faces)
    for (auto const& facet : facets)
      builder.add<RandomFilm>(part, {{Port::Kind::node, facet.cell}, air}, {4.0 * facet.area});
  int const hot = body.cell(1, 1, 3), warm = body.cell(6, 4, 3);
  builder.add<RandomFriction>(friction, {{Port::Kind::node, hot}, {Port::Kind::node, warm}}, {200.0, 0.01, 0.7},
                              {builder.channel("speed")});
  return {builder.build(), body.cell(2, 1, 3)};
}

FunctionCourse course_of(double period, double air) {
  std::vector<double> jumps;
  for (double t = period; t < 2e4; t += period) jumps.push_back(t);
  return {{"air", "speed"},
          [period, air](double t, std::span<double> u) {
            u[0] = T0 + air + 2.0 * std::sin(t / 5000.0);
            u[1] = std::fmod(std::floor(t / period) * 0.37 + 0.4, 1.0);
          },
          jumps};
}

Reduction reduced(HeatedBlock const& block, double share) {
  FunctionCourse const first = course_of(1500.0, 0.0), second = course_of(4000.0, 8.0);
  ReductionTask task;
  auto const nodes = block.network.nodes();
  task.training = {{&first, std::vector<double>(std::size_t(nodes), T0), 15000.0},
                   {&second, std::vector<double>(std::size_t(nodes), T0 + 5.0), 15000.0}};
  task.watched = {{{{block.sensor, 1.0}}, 0.01}};
  task.initial_rises = Eigen::MatrixXd::Ones(nodes, 1);
  task.share = share;
  return reduce(block.network, task);
}

double error_of(HeatedBlock const& block, ReferencePoint const& at, Subspace const& subspace) {
  FunctionCourse const fresh = course_of(2300.0, 4.0);
  std::vector<double> times;
  for (double t = 0.0; t <= 14000.0; t += 200.0) times.push_back(t);
  std::vector<double> const start(std::size_t(block.network.nodes()), T0 + 3.0);
  std::vector<double> full;
  integrate(block.network, fresh, start, times, tight(1e-8),
            [&](Sample const& sample) { full.push_back(sample.temperatures[std::size_t(block.sensor)]); });
  LinearPart const linear(block.network, at);
  ReducedNetwork const network(block.network, linear, subspace.shapes, subspace.elements);
  ReducedSums const sums(network, {{{block.sensor, 1.0}}});
  double worst = 0.0;
  std::size_t row = 0;
  integrate(network, fresh, network.state_of(start), times, 1e-5, [&](ReducedSample const& sample) {
    Eigen::VectorXd value;
    sums.evaluate(sample.state, value);
    worst = std::max(worst, std::abs(value[0] - full[row++]));
  });
  EXPECT_GT(*std::max_element(full.begin(), full.end()) - full.front(), 5.0);
  return worst;
}

TEST(Reduction, FewShapesAndLawsDoForACourseThatNoneHasSeenAndMoreDoBetter) {
  auto const block = heated_block();
  auto const coarse = reduced(block, 0.3), fine = reduced(block, 0.001);
  auto const all = nonlinear_elements(block.network, LinearPart(block.network, fine.reference)).size();
  EXPECT_LT(coarse.fine.shapes.cols(), fine.fine.shapes.cols());
  EXPECT_LT(fine.fine.shapes.cols(), block.network.nodes() / 4);
  EXPECT_LT(fine.fine.elements.size(), all / 2);
  double const coarse_error = error_of(block, coarse.reference, coarse.fine);
  double const fine_error = error_of(block, fine.reference, fine.fine);
  EXPECT_LT(fine_error, 0.005);
  EXPECT_LT(fine_error, 0.2 * coarse_error);
  EXPECT_LT(fine.training_error[0], 0.005);
}

TEST(Reduction, SourcesAreKeptAsTheyAre) {
  auto const block = heated_block();
  auto const found = reduced(block, 0.01);
  int sources = 0;
  for (auto const& element : found.fine.elements)
    if (!block.network.groups()[std::size_t(element.group)].law->conservative()) {
      EXPECT_EQ(element.weight, 1.0);
      ++sources;
    } else {
      EXPECT_GT(element.weight, 0.0);
    }
  EXPECT_EQ(sources, 1);
}

TEST(Reduction, TheSameTaskGivesTheSameSubspace) {
  auto const block = heated_block();
  auto const a = reduced(block, 0.01), b = reduced(block, 0.01);
  EXPECT_EQ(a.fine.shapes, b.fine.shapes);
  EXPECT_EQ(a.fine.elements.size(), b.fine.elements.size());
}

TEST(Reduction, NeedsTrainingRuns) {
  auto const block = heated_block();
  EXPECT_THROW((void)reduce(block.network, {}), InputError);
}

}  // namespace
}  // namespace thermotwin::thermal
