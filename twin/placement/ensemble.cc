#include "twin/placement/ensemble.h"

#include <map>

#include "thermal/error.h"
#include "twin/challenge/challenge_runs.h"
#include "twin/challenge/hidden_world.h"
#include "twin/history.h"
#include "twin/parallel.h"
#include "twin/run.h"
#include "twin/uncertain_range.h"

namespace thermotwin::twin {
namespace {

using thermal::InputError;

constexpr double run_tolerance = 1e-4;  // of the integration: far below what the members differ by

std::vector<scenarios::Experiment> experiments_of(EnsembleOptions const& options, Machine const& machine,
                                                  std::uint64_t seed) {
  auto experiments = options.experiments;
  if (experiments.empty()) {
    auto const drawn = challenge_runs(machine.limits, seed);
    experiments = {drawn[1], drawn[2]};
    experiments[0].title = "blocks of 20 min, drawn at random";
    experiments[1].title = "blocks of 20 to 90 min, drawn at random";
  }
  for (auto& experiment : experiments) experiment.sampling = experiment.duration / options.snapshots;
  return experiments;
}

Eigen::MatrixXd columns(std::vector<output::Channel> const& channels, std::vector<std::size_t> const& which) {
  Eigen::MatrixXd values(channels.at(which.at(0)).values.size(), Eigen::Index(which.size()));
  for (std::size_t c = 0; c < which.size(); ++c) values.col(Eigen::Index(c)) = channels[which[c]].values;
  return values;
}

template <class Matrix>
Matrix since_start(Matrix values) {
  values.rowwise() -= values.row(0).eval();
  return values;
}

/// One run, all snapshots.
struct Part {
  std::string experiment;
  Eigen::MatrixXd rise, displacement;
  Eigen::MatrixXf node_rise;
};

constexpr std::uint64_t drawn_by_one_seed = std::uint64_t{1} << 32;

class Draw {
 public:
  Draw(Value const& document, std::vector<CandidateSite> const& sites, EnsembleOptions const& options)
      : document_(with_sensors_at(document, sites)), options_(options), nominal_(Machine::build(document_)) {
    for (std::size_t s = nominal_.sensors.size() - sites.size(); s < nominal_.sensors.size(); ++s)
      sensors_.push_back(s);
    auto const channels = displacement_channels(nominal_);
    for (std::size_t c = 0; c < channels.size(); ++c)
      if (channels[c].unit == "um") displacements_.push_back(c), names_.push_back(channels[c].name);
    if (names_.empty()) throw InputError("the machine has no displacement that sensors could explain");
  }

  [[nodiscard]] std::vector<Part> member(int number) const;
  [[nodiscard]] Ensemble operator()() const;

 private:
  Value document_;
  EnsembleOptions const& options_;
  Machine nominal_;
  std::vector<std::size_t> sensors_, displacements_;
  std::vector<std::string> names_;
};

std::vector<Part> Draw::member(int number) const {
  std::map<std::string, double> drawn;
  std::uint64_t const seed =
      1 + (options_.seed - 1) * drawn_by_one_seed + std::uint64_t(options_.first_member + number);
  Machine const machine = Machine::build(vary_parameters(document_, seed, 1.0, drawn));
  RunOptions run_options;
  run_options.integration.relative_tolerance = run_options.integration.absolute_tolerance = run_tolerance;
  run_options.node_temperatures = options_.every_node;
  run_options.stop = options_.stop;
  std::vector<Part> parts;
  for (auto const& experiment : experiments_of(options_, machine, seed)) {
    auto const data = run(machine, experiment, run_options).dataset;
    parts.push_back({experiment.title,
                     since_start(columns(data.truth_readings, sensors_)),
                     columns(data.truth_displacements, displacements_),
                     {}});
    if (options_.every_node) parts.back().node_rise = since_start<Eigen::MatrixXf>(*data.node_temperatures);
  }
  return parts;
}

void append(Ensemble& ensemble, int member, std::vector<Part> const& parts) {
  auto const add = [](auto& all, auto const& rows) {
    all.conservativeResize(all.rows() + rows.rows(), rows.cols());
    all.bottomRows(rows.rows()) = rows;
  };
  for (auto const& part : parts) {
    ensemble.runs.push_back({member, part.experiment, ensemble.rise.rows(), part.rise.rows()});
    add(ensemble.rise, part.rise);
    add(ensemble.displacement, part.displacement);
    if (part.node_rise.size() > 0) add(ensemble.node_rise, part.node_rise);
  }
}

Ensemble Draw::operator()() const {
  std::vector<std::vector<Part>> members(std::size_t(options_.members));
  in_parallel(members.size(), options_.progress, nullptr, [&](std::size_t m) { members[m] = member(int(m)); });
  Ensemble ensemble;
  ensemble.channels = names_;
  std::map<std::string, double> drawn;
  static_cast<void>(vary_parameters(document_, options_.seed, 1.0, drawn));
  ensemble.numbers = drawn.size();
  ensemble.ranged = ranged_numbers(document_).size();
  for (std::size_t m = 0; m < members.size(); ++m) append(ensemble, int(m), members[m]);
  return ensemble;
}

}  // namespace

Ensemble draw_ensemble(Value const& document, std::vector<CandidateSite> const& sites, EnsembleOptions const& options) {
  return Draw(document, sites, options)();
}

}  // namespace thermotwin::twin
