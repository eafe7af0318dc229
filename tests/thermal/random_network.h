#pragma once

#include <cmath>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "tests/thermal/function_course.h"
#include "tests/thermal/verification.h"
#include "thermal/laws.h"
#include "thermal/network.h"

namespace thermotwin::thermal {

/// q = c (|T₁ − T₀|² + ε²)^{1/6} (T₁ − T₀): natural convection.
struct RandomFilm {
  static constexpr std::string_view name = "random film";
  static constexpr int ports = 2, coefficients = 1, inputs = 0;
  static constexpr bool conservative = true;
  template <class S>
  static void flows(S const* T, S const* c, double const*, S* q) {
    exchange<S>(c[0] * smooth_power<S>(T[1] - T[0], 1.0 / 3.0) * (T[1] - T[0]), q);
  }
};

/// q = c (T₁⁴ − T₀⁴).
struct RandomRadiation {
  static constexpr std::string_view name = "random radiation";
  static constexpr int ports = 2, coefficients = 1, inputs = 0;
  static constexpr bool conservative = true;
  template <class S>
  static void flows(S const* T, S const* c, double const*, S* q) {
    S const a = T[0] * T[0], b = T[1] * T[1];
    exchange<S>(c[0] * (b * b - a * a), q);
  }
};

/// Friction that falls with the mean temperature of two rings, split between them: c = {P [W], B [1/K], share}, u =
/// {n}.
struct RandomFriction {
  static constexpr std::string_view name = "random friction";
  static constexpr int ports = 2, coefficients = 3, inputs = 1;
  static constexpr bool conservative = false;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    using std::exp;
    S const heat = u[0] * c[0] * exp(-c[1] * (0.5 * (T[0] + T[1]) - 293.15));
    q[0] = c[2] * heat;
    q[1] = (1.0 - c[2]) * heat;
  }
};

/// Evaporation: c = {W/K}; only above 20 °C, smoothly.
struct RandomSink {
  static constexpr std::string_view name = "random sink";
  static constexpr int ports = 1, coefficients = 1, inputs = 0;
  static constexpr bool conservative = false;
  template <class S>
  static void flows(S const* T, S const* c, double const*, S* q) {
    q[0] = -c[0] * smooth_positive<S>(T[0] - 293.15, 0.1);
  }
};

/// A network of random topology with every kind of part that the core knows. What is drawn depends on the seed alone.
struct RandomNetwork {
  Network network;
  std::vector<double> start;  ///< [K]
  double coldest, warmest;    ///< of the start and of all boundaries
};

struct RandomNetworkOptions {
  bool averages = true;  ///< an average heats all its nodes alike, even one that is hotter: it bounds nothing
  bool sources = true;   ///< friction, heat, evaporation
  bool change_start = true;
  double scale = 1.0;  ///< of all conductances: a parameter to differentiate by
};

inline RandomNetwork random_network(unsigned seed, RandomNetworkOptions const& options = {}) {
  std::mt19937 draw(seed);
  auto const uniform = [&](double low, double high) { return low + (high - low) * (draw() / 4294967296.0); };
  auto const integer = [&](int low, int high) { return low + int(draw() % unsigned(high - low + 1)); };
  NetworkBuilder builder;
  int const part = builder.part("network"), friction = builder.part("friction"), sink = builder.part("sink");
  int const bodies = integer(1, 5);
  std::vector<Port> nodes;
  std::vector<std::vector<Port>> by_body;
  for (int b = 0; b < bodies; ++b) {
    std::vector<double> capacities;
    int const count = integer(1, 9);
    for (int i = 0; i < count; ++i) capacities.push_back(std::pow(10.0, uniform(1.0, 4.5)));
    Port const first =
        builder.add_body("body" + std::to_string(b), capacities, integer(0, 1) == 0 ? 0.0 : uniform(-1e-3, 2e-3));
    auto& own = by_body.emplace_back();
    for (int i = 0; i < count; ++i) own.push_back({Port::Kind::node, first.index + i});
    nodes.insert(nodes.end(), own.begin(), own.end());
  }
  double const room_offset = uniform(-10.0, 10.0), floor_offset = uniform(-10.0, 10.0);
  Port const room = builder.add_boundary({"room", T0 + room_offset, {{builder.channel("swing"), 1.0}}});
  Port const floor = builder.add_boundary({"floor", T0 + floor_offset, {}});
  auto const any = [&] { return nodes[std::size_t(integer(0, int(nodes.size()) - 1))]; };
  auto const conductance = [&] { return options.scale * std::pow(10.0, uniform(-1.0, 2.0)); };
  auto const link = [&](Port a, Port b) {
    switch (integer(0, 3)) {
      case 0:
        return builder.add<TemperatureDependentConductance>(part, {a, b}, {conductance(), uniform(-1e-3, 1e-3)});
      case 1:
        return builder.add<RandomFilm>(part, {a, b}, {conductance()});
      case 2:
        return builder.add<RandomRadiation>(part, {a, b}, {1e-8 * conductance()});
      default:
        return builder.connect(part, a, b, conductance());
    }
  };
  for (auto const& own : by_body)
    for (std::size_t i = 1; i < own.size(); ++i) builder.connect(part, own[i - 1], own[i], conductance());
  for (auto const& own : by_body) builder.connect(part, own[0], integer(0, 1) == 0 ? room : floor, conductance());
  for (int i = integer(0, 12); i > 0; --i) {
    Port const a = any(), b = any();
    if (a.index != b.index) link(a, b);
  }
  for (int i = integer(0, 5); i > 0; --i) link(any(), integer(0, 1) == 0 ? room : floor);
  std::vector<Port> averages;
  for (int i = options.averages ? integer(0, 3) : 0; i > 0; --i) {
    auto const& own = by_body[std::size_t(integer(0, bodies - 1))];
    Average average;
    average.name = "average" + std::to_string(i);
    double sum = 0.0;
    for (Port node : own) {
      average.nodes.push_back(node.index);
      sum += average.weights.emplace_back(uniform(0.1, 1.0));
    }
    for (double& w : average.weights) w /= sum;
    if (integer(0, 2) == 0) {
      average.from_channel = average.to_channel = builder.channel("position");
      average.window = uniform(0.2, 0.5);
      for (std::size_t k = 0; k <= own.size(); ++k) average.edges.push_back(double(k) / double(own.size()));
    }
    averages.push_back(builder.add_average(average));
    link(averages.back(), any());
    if (integer(0, 1) == 0) link(averages.back(), room);
  }
  if (averages.size() > 1) link(averages[0], averages[1]);
  double const heat_rate = uniform(10.0, 100.0);
  builder.add<Advection>(part, {room, nodes[0]}, {heat_rate}, {builder.channel("flow")});
  builder.add<Advection>(part, {nodes[0], floor}, {heat_rate}, {builder.channel("flow")});
  if (options.sources) {
    for (int i = integer(1, 3); i > 0; --i) {
      Port const a = averages.empty() ? any() : averages[0], b = any();
      builder.add<RandomFriction>(friction, {a, b}, {uniform(1.0, 300.0), uniform(0.0, 0.03), uniform(0.2, 0.8)},
                                  {builder.channel("speed")});
    }
    builder.add<RandomSink>(sink, {any()}, {uniform(0.1, 5.0)});
  }
  double coldest = std::min(room_offset - 3.0, floor_offset), warmest = std::max(room_offset + 3.0, floor_offset);
  RandomNetwork result{builder.build(), {}, 0.0, 0.0};
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    double const theta = uniform(-10.0, 20.0);
    result.start.push_back(T0 + (options.change_start ? theta : 0.0));
    coldest = std::min(coldest, theta);
    warmest = std::max(warmest, theta);
  }
  result.coldest = T0 + coldest;
  result.warmest = T0 + warmest;
  return result;
}

/// Two jumps, a swing of the room by 3 K, a part that moves.
inline FunctionCourse random_course() {
  return {{"swing", "position", "flow", "speed"},
          [](double t, std::span<double> u) {
            u[0] = 3.0 * std::sin(t / 700.0);
            u[1] = 0.5 + 0.2 * std::sin(t / 60.0);
            u[2] = t < 1200.0 ? 0.3 : 0.0;
            u[3] = t < 600.0 ? 1.0 : t < 1200.0 ? 0.2 : 0.7;
          },
          {600.0, 1200.0}};
}

}  // namespace thermotwin::thermal
