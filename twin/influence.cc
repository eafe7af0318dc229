#include "twin/influence.h"

#include <fmt/format.h>

#include "thermal/error.h"
#include "twin/elastic_block.h"
#include "twin/elastic_solution.h"
#include "twin/influence_file.h"

namespace thermotwin::twin {
namespace {

using thermal::InputError;

Eigen::Vector3d direction_of(std::string const& text) { return LineDescription{.direction = text}.axis(); }

std::vector<double> solution(std::filesystem::path const& machine_file, ElasticBlock const& block, int load) {
  auto found = find_solution(machine_file, solution_key(block, load));
  if (!found)
    throw InputError(fmt::format("there are no influence weights for '{}' ({}) in {}; run: thermotwin weights {}",
                                 block.body.name, unit_loads[std::size_t(load)], weights_file(machine_file).string(),
                                 machine_file.string()));
  if (int(found->size()) != block.body.nodes())
    throw InputError(
        fmt::format("{} has {} numbers for '{}', which has {} cells; delete the file and run: thermotwin "
                    "weights {}",
                    weights_file(machine_file).string(), found->size(), block.body.name, block.body.nodes(),
                    machine_file.string()));
  return *std::move(found);
}

std::vector<double> stored(std::filesystem::path const& machine_file, ElasticBlock const& block, Load const& load) {
  std::vector<double> sums(std::size_t(block.body.nodes()), 0.0);
  for (int k = 0; k < 6; ++k) {
    if (load[k] == 0.0) continue;
    auto const part = solution(machine_file, block, k);
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += load[k] * part[i];
  }
  return sums;
}

}  // namespace

void add_influence(std::vector<std::pair<int, double>>& weights, std::filesystem::path const& machine_file,
                   InfluenceDescription const& influence, std::string const& direction, thermal::Body const& body,
                   thermal::Material const& material, int first_node, bool rotation) {
  auto const block = elastic_block(body, material.poisson_ratio, influence.fixed, influence.loaded);
  Load const load = unit_load(block, direction_of(direction), influence.point, rotation);
  auto const sums = influence.solution == "beam" ? beam_solution(block, load) : stored(machine_file, block, load);
  for (int i = 0; i < body.nodes(); ++i)
    weights.emplace_back(first_node + i, influence.weight * material.expansion * sums[std::size_t(i)]);
}

double closing_length(InfluenceDescription const& influence, std::string const& direction, thermal::Body const& body) {
  auto const block = elastic_block(body, 0.0, influence.fixed, influence.loaded);
  return influence.weight * (centre_of(block.loaded) - centre_of(block.fixed)).dot(direction_of(direction));
}

}  // namespace thermotwin::twin
