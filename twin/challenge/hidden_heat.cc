#include "twin/challenge/hidden_heat.h"

#include <algorithm>
#include <cmath>

#include "scenarios/course.h"
#include "thermal/evaluation.h"
#include "thermal/physical_constant.h"

namespace thermotwin::twin {
namespace {

constexpr Eigen::Index stride = 5;
constexpr double least_heat = 1e-3;  // [W]

/// Heat into every node of a network, at the temperatures of a data set's row.
class NodeHeat {
 public:
  NodeHeat(Machine const& machine, scenarios::Experiment const& experiment, std::vector<std::string> const& names)
      : network_(machine.network()),
        course_(experiment, machine.limits),
        evaluation_(network_),
        state_(std::size_t(network_.nodes())),
        rate_(state_.size()) {
    std::map<std::string, Eigen::Index> columns;
    for (std::size_t i = 0; i < names.size(); ++i) columns[names[i]] = Eigen::Index(i);
    for (int i = 0; i < network_.nodes(); ++i) columns_.push_back(columns.at(network_.node_name(i)));
    auto const& given = course_.channels();
    for (int c = 0; c < network_.external_channels(); ++c) {
      auto const& name = network_.channel_names()[std::size_t(c)];
      auto const it = std::find_if(given.begin(), given.end(), [&](auto const& g) { return g.name == name; });
      inputs_.push_back(it == given.end() ? -1 : int(it - given.begin()));
    }
    all_.resize(given.size());
  }

  /// Per body.
  std::map<std::string, double> operator()(double t, Eigen::MatrixXf const& temperatures, Eigen::Index row) {
    course_.evaluate(t, all_);
    std::vector<double> input;
    for (int channel : inputs_) input.push_back(channel < 0 ? 0.0 : all_[std::size_t(channel)]);
    for (std::size_t i = 0; i < state_.size(); ++i)
      state_[i] = network_.state_of_temperature(int(i), double(temperatures(row, columns_[i])) + thermal::zero_celsius);
    evaluation_.rate(state_.data(), input.data(), rate_.data());
    std::map<std::string, double> heat;
    for (auto const& range : network_.ranges())
      for (int i = range.first; i < range.first + range.count; ++i)
        heat[range.name] += network_.capacity()[std::size_t(i)] * rate_[std::size_t(i)];
    return heat;
  }

 private:
  thermal::Network const& network_;
  scenarios::ExperimentCourse course_;
  thermal::Evaluation evaluation_;
  std::vector<double> state_, rate_, all_;
  std::vector<Eigen::Index> columns_;
  std::vector<int> inputs_;
};

bool moves(output::Dataset const& course, Eigen::Index row) {
  return std::any_of(course.inputs.begin(), course.inputs.end(),
                     [&](auto const& c) { return c.name.ends_with(".running") && c.values[row] > 0.5; });
}

}  // namespace

std::map<std::string, MeanHeat> hidden_heat(Machine const& with, Machine const& without,
                                            scenarios::Experiment const& experiment, output::Dataset const& course) {
  if (!with.network().relays().empty() || !course.node_temperatures) return {};
  NodeHeat heat_with(with, experiment, course.node_names), heat_without(without, experiment, course.node_names);
  std::map<std::string, MeanHeat> heat;
  int rows_moving = 0, rows_standing = 0;
  for (Eigen::Index row = 0; row < course.time_s.size(); row += stride) {
    bool const moving = moves(course, row);
    ++(moving ? rows_moving : rows_standing);
    auto const base = heat_without(course.time_s[row], *course.node_temperatures, row);
    for (auto const& [body, watts] : heat_with(course.time_s[row], *course.node_temperatures, row))
      if (auto const it = base.find(body); it != base.end())
        (moving ? heat[body].moving : heat[body].standing) += watts - it->second;
  }
  for (auto& [body, q] : heat) {
    q.mean = (q.moving + q.standing) / (rows_moving + rows_standing);
    q.moving /= std::max(1, rows_moving);
    q.standing /= std::max(1, rows_standing);
  }
  std::erase_if(heat, [](auto const& entry) {
    return std::max(std::abs(entry.second.moving), std::abs(entry.second.standing)) < least_heat;
  });
  return heat;
}

}  // namespace thermotwin::twin
