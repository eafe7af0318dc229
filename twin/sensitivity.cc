#include "twin/sensitivity.h"

#include <cmath>
#include <fmt/format.h>
#include <map>

#include "thermal/error.h"
#include "thermal/nearest_name.h"

namespace thermotwin::twin {
namespace {

constexpr double relative_step = 1e-4;

NodeWeights difference(NodeWeights const& plus, NodeWeights const& minus, double step) {
  std::map<int, double> sum;
  for (auto const& [node, weight] : plus) sum[node] += weight / (2.0 * step);
  for (auto const& [node, weight] : minus) sum[node] -= weight / (2.0 * step);
  return {sum.begin(), sum.end()};
}

}  // namespace

Parameter find_number(Value const& document, std::string_view path) {
  Value copy = document;
  auto const [table, key] = find_parameter(copy, path);
  Value const* value = table->find(key);
  if (!value)
    throw thermal::InputError(
        fmt::format("parameter '{}': '{}' is not given in the file; give it there or with --set; {}", path, key,
                    thermal::did_you_mean(key, table->keys())));
  if (double const* number = std::get_if<double>(&value->content)) return {std::string(path), *number, {}, false};
  if (auto const* whole = std::get_if<std::int64_t>(&value->content))
    return {std::string(path), double(*whole), {}, false};
  if (!value->is_text())
    throw thermal::InputError(fmt::format(
        "parameter '{}' is {}; only a number, with or without unit, has a sensitivity", path, value->kind()));
  auto const quantity = thermal::parse_quantity(std::get<std::string>(value->content));
  return {std::string(path), quantity.value, quantity.dimension, quantity.absolute_temperature};
}

void set_number(Value& document, Parameter const& parameter, double number) {
  auto const [table, key] = find_parameter(document, parameter.path);
  auto& content = table->find(key)->content;
  if (parameter.absolute_temperature)
    content = thermal::format_temperature(number);
  else if (std::holds_alternative<std::string>(content))
    content = thermal::format_quantity(number, parameter.dimension);
  else
    content = number;
}

Value with_number(Value document, Parameter const& parameter, double number) {
  set_number(document, parameter, number);
  return document;
}

MachineDerivative difference(Machine const& plus, Machine const& minus, double step) {
  MachineDerivative derivative;
  derivative.network = thermal::difference(plus.network(), minus.network(), step);
  for (std::size_t s = 0; s < plus.sensors.size(); ++s)
    derivative.sensors.push_back(difference(plus.sensors[s].weights, minus.sensors[s].weights, step));
  for (std::size_t d = 0; d < plus.linear_channels.size(); ++d)
    derivative.displacements.push_back(
        difference(plus.linear_channels[d].weights, minus.linear_channels[d].weights, step));
  return derivative;
}

MachineDerivative differentiate(Value const& document, std::string_view path) {
  Parameter const parameter = find_number(document, path);
  double const value = parameter.value;
  double const step = relative_step * (value != 0.0 ? std::abs(value) : 1.0);
  Machine const plus = Machine::build(with_number(document, parameter, value + step));
  Machine const minus = Machine::build(with_number(document, parameter, value - step));
  MachineDerivative derivative = difference(plus, minus, step);
  derivative.parameter = parameter;
  derivative.network.name = parameter.path;
  derivative.network.scale = value != 0.0 ? std::abs(value) : 1.0;
  return derivative;
}

}  // namespace thermotwin::twin
