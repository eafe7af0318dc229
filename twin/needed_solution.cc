#include "twin/needed_solution.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

#include "thermal/block.h"
#include "thermal/error.h"
#include "thermal/material.h"
#include "thermal/nearest_name.h"
#include "twin/description.h"
#include "twin/elastic_solution.h"

namespace thermotwin::twin {
namespace {

using thermal::InputError;

Value::List const& tables(Value const& document, std::string const& key) {
  static Value::List const none;
  Value const* value = document.find(key);
  return value && value->is_list() ? std::get<Value::List>(value->content) : none;
}

template <class Description>
Description read_table(Value const& table) {
  Description description;
  read_fields(table, description);
  return description;
}

template <class Description>
std::vector<Description> read_list(Value const& document, std::string const& key) {
  std::vector<Description> result;
  for (auto const& table : tables(document, key)) result.push_back(read_table<Description>(table));
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
  return thermal::make_body(d.name, thermal::Block{thermal::material("C45"), d.corner, d.size, d.cell_counts(), 1.0});
}

class Collector {
 public:
  explicit Collector(Value const& document)
      : materials_(read_list<MaterialDescription>(document, "material")),
        blocks_(read_list<BlockDescription>(document, "block")) {}

  void add(DisplacementDescription const& channel, bool rotation) {
    Eigen::Vector3d const direction = LineDescription{.direction = channel.direction}.axis();
    for (auto const& influence : channel.influence) {
      if (influence.solution != "solid") continue;
      auto const& description = find_block(blocks_, influence.body);
      auto const block = elastic_block(shape_of(description), poisson_ratio(materials_, description.material),
                                       influence.fixed, influence.loaded);
      Load const load = unit_load(block, direction, influence.point, rotation);
      for (int k = 0; k < 6; ++k)
        if (load[k] != 0.0 && keys_.insert(solution_key(block, k)).second)
          needed_.push_back({solution_key(block, k), block, k});
    }
  }
  [[nodiscard]] std::vector<NeededSolution> const& needed() const { return needed_; }

 private:
  std::vector<MaterialDescription> materials_;
  std::vector<BlockDescription> blocks_;
  std::vector<NeededSolution> needed_;
  std::set<std::string> keys_;
};

}  // namespace

std::string NeededSolution::remark() const {
  return fmt::format("{}: {} on {}, held at {}", block.body.name, unit_loads[std::size_t(load)], block.loaded.place,
                     block.fixed.place);
}

std::vector<NeededSolution> needed_solutions(Value const& document) {
  Collector collector(document);
  for (bool const rotation : {true, false})
    for (auto const& table : tables(document, rotation ? "rotation" : "displacement")) try {
        collector.add(read_table<DisplacementDescription>(table), rotation);
      } catch (FileError const&) {
        throw;
      } catch (InputError const& error) {
        throw FileError(table.where, error.what());
      }
  return collector.needed();
}

std::map<std::string, Solution> known_solutions(std::filesystem::path const& machine_file, Value const& document) {
  std::map<std::string, Solution> solutions;
  for (auto const& one : needed_solutions(document))
    if (auto const known = find_solution(machine_file, one.key)) solutions[one.key] = {one.remark(), *known};
  return solutions;
}

int write_weights(std::filesystem::path const& machine_file, std::ostream& progress) {
  Value const document = read_toml(machine_file);
  auto const needed = needed_solutions(document);
  if (needed.empty()) {
    progress << fmt::format("{}: no displacement rests on a block: nothing to compute\n", machine_file.string());
    return 0;
  }
  auto const path = weights_file(machine_file);
  auto solutions = known_solutions(machine_file, document);
  int const due = int(needed.size() - solutions.size());
  int solved = 0;
  for (auto const& one : needed) {
    if (solutions.contains(one.key)) continue;
    progress << fmt::format("{} of {}: {}, {} cells\n", ++solved, due, one.remark(), one.block.body.nodes())
             << std::flush;
    solutions[one.key] = {one.remark(), solve_unit_load(one.block, one.load)};
    write_solutions(path, solutions);
  }
  write_solutions(path, solutions);
  progress << fmt::format("{}: {} of {} solutions are new\n", path.string(), solved, needed.size());
  return solved;
}

}  // namespace thermotwin::twin
