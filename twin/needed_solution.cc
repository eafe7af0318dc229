#include "twin/needed_solution.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>

#include "thermal/block.h"
#include "thermal/error.h"
#include "thermal/material.h"
#include "thermal/nearest_name.h"
#include "twin/description.h"
#include "twin/elastic_solution.h"
#include "twin/influence_file.h"

namespace thermotwin::twin {
namespace {

using thermal::InputError;

template <class Description>
std::vector<Description> read_list(Value const& document, std::string const& key) {
  std::vector<Description> result;
  Value const* value = document.find(key);
  if (!value || !value->is_list()) return result;
  for (auto const& table : std::get<Value::List>(value->content)) read_fields(table, result.emplace_back());
  return result;
}

double poisson_ratio(std::vector<MaterialDescription> const& own, std::string const& name) {
  auto const it = std::find_if(own.begin(), own.end(), [&](auto const& m) { return m.name == name; });
  if (it == own.end()) return thermal::material(name).poisson_ratio;
  return it->poisson_ratio ? *it->poisson_ratio : thermal::material(it->like).poisson_ratio;
}

BlockDescription const& find_block(std::vector<BlockDescription> const& blocks, std::string const& name) {
  auto const it = std::find_if(blocks.begin(), blocks.end(), [&](auto const& block) { return block.name == name; });
  if (it != blocks.end()) return *it;
  std::vector<std::string> names;
  for (auto const& block : blocks) names.push_back(block.name);
  throw InputError(fmt::format("unknown block '{}'; {}", name, thermal::did_you_mean(name, names)));
}

/// Only its shape counts here.
thermal::Body shape_of(BlockDescription const& d) {
  if (d.cells.size() != 3)
    throw InputError(fmt::format("'{}': cells has {} entries; three are due", d.name, d.cells.size()));
  std::array<int, 3> const cells = {int(d.cells[0]), int(d.cells[1]), int(d.cells[2])};
  return thermal::make_body(d.name, thermal::Block{thermal::material("C45"), d.corner, d.size, cells, 1.0});
}

}  // namespace

std::string NeededSolution::remark() const {
  return fmt::format("{}: {} on {}, held at {}", block.body.name, unit_loads[std::size_t(load)], block.loaded.place,
                     block.fixed.place);
}

std::vector<NeededSolution> needed_solutions(Value const& document) {
  auto const materials = read_list<MaterialDescription>(document, "material");
  auto const blocks = read_list<BlockDescription>(document, "block");
  std::vector<NeededSolution> needed;
  std::set<std::string> keys;
  for (bool const rotation : {true, false})
    for (auto const& channel : read_list<DisplacementDescription>(document, rotation ? "rotation" : "displacement"))
      for (auto const& influence : channel.influence) {
        auto const& description = find_block(blocks, influence.body);
        auto const block = elastic_block(shape_of(description), poisson_ratio(materials, description.material),
                                         influence.fixed, influence.loaded);
        Eigen::Vector3d const direction = LineDescription{.direction = channel.direction}.axis();
        Load const load = unit_load(block, direction, influence.point, rotation);
        for (int k = 0; k < 6; ++k)
          if (load[k] != 0.0 && keys.insert(solution_key(block, k)).second)
            needed.push_back({solution_key(block, k), block, k});
      }
  return needed;
}

int write_weights(std::filesystem::path const& machine_file, std::ostream& progress) {
  auto const needed = needed_solutions(read_toml(machine_file));
  auto const path = InfluenceFile::beside(machine_file);
  InfluenceFile file;
  for (auto const& one : needed)
    if (auto const known = find_solution(machine_file, one.key)) file.entries[one.key] = {one.remark(), *known};
  int const due = int(needed.size() - file.entries.size());
  int solved = 0;
  for (auto const& one : needed) {
    if (file.entries.contains(one.key)) continue;
    progress << fmt::format("{} of {}: {}, {} cells\n", ++solved, due, one.remark(), one.block.body.nodes())
             << std::flush;
    file.entries[one.key] = {one.remark(), solve_unit_load(one.block, one.load)};
    file.write(path);
  }
  if (!needed.empty()) file.write(path);
  progress << fmt::format("{}: {} of {} solutions are new\n", path.string(), solved, needed.size());
  return solved;
}

}  // namespace thermotwin::twin
