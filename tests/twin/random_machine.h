#pragma once

#include <cmath>
#include <fmt/format.h>
#include <string>
#include <vector>

#include "twin/instruments/random_stream.h"

namespace thermotwin::twin {

/// A machine tool that nobody built, as a machine file: a structural loop of `in_loop` lumps, from a bed of some
/// hundred kilograms to a bearing ring, in a chain of joints, heated at its last three by the spindle; and `beside`
/// lumps that no displacement feels, motors, cabinets, tanks and pumps, each with a loss of its own that warms it by 5
/// to 40 K, and a joint to some other lump. Three displacements, each the growth of some parts of the loop. The same
/// seed, the same text.
class RandomMachine {
 public:
  explicit RandomMachine(std::uint64_t seed, int in_loop = 10, int beside = 14)
      : stream_(seed, "machine"), in_loop_(in_loop), beside_(beside) {
    text_ = fmt::format("name = \"random_{}\"\n\n[spindle]\nmaximum_speed = \"8000 rpm\"\n", seed);
    for (int i = 0; i < in_loop; ++i) add_loop_body(i);
    for (int i = 0; i < beside; ++i) add_body_beside(i);
    for (auto const* axis : {"X", "Y", "Z"}) add_displacement(axis);
  }

  [[nodiscard]] std::string const& text() const { return text_; }
  [[nodiscard]] std::vector<std::string> bodies() const {
    std::vector<std::string> names;
    for (int i = 0; i < in_loop_; ++i) names.push_back(fmt::format("loop_{}", i));
    for (int i = 0; i < beside_; ++i) names.push_back(fmt::format("beside_{}", i));
    return names;
  }

 private:
  /// A lump of cast iron with a film to the room; returns the film's conductance in still air, about 8 W/(m2 K).
  double add_lump(std::string const& name, double mass, double x) {
    double const area = 0.012 * std::pow(mass, 2.0 / 3.0) * stream_.log_uniform(1.5, 6.0);
    text_ += fmt::format(
        "\n[[lump]]\nname = \"{0}\"\nmaterial = \"GJL-300\"\nmass = \"{1:.6g} kg\"\n"
        "corner = [\"{2:.6g} mm\", \"0 mm\", \"0 mm\"]\nsize = [\"100 mm\", \"100 mm\", \"100 mm\"]\n"
        "\n[[film]]\nname = \"{0}\"\non = \"{0}\"\ncorrelation = \"room\"\narea = \"{3:.6g} m2\"\n",
        name, mass, 150.0 * x, area);
    return 8.0 * area;
  }
  void add_joint(std::string const& from, std::string const& to, double conductance) {
    text_ +=
        fmt::format("\n[[joint]]\nname = \"{0}_{1}\"\nfrom = \"{0}\"\nto = \"{1}\"\nconductance = \"{2:.6g} W/K\"\n",
                    from, to, conductance);
  }
  void add_spindle_heat(std::string const& at, double power) {
    double const eddy = stream_.uniform(0.1, 0.9) * power;
    text_ += fmt::format(
        "\n[[motor_loss]]\nname = \"{0}\"\nat = \"{0}\"\nhysteresis = \"{1:.6g} W\"\neddy = \"{2:.6g} W\"\n", at,
        power - eddy, eddy);
  }
  void add_loop_body(int i) {
    auto const name = fmt::format("loop_{}", i);
    double const mass = 600.0 * std::pow(600.0, -double(i) / double(in_loop_ - 1)) * stream_.log_uniform(0.6, 1.6);
    add_lump(name, mass, i);
    if (i > 0) add_joint(fmt::format("loop_{}", i - 1), name, stream_.log_uniform(3.0, 30.0));
    if (i >= in_loop_ - 3) add_spindle_heat(name, stream_.log_uniform(20.0, 150.0));
  }
  void add_body_beside(int i) {
    auto const name = fmt::format("beside_{}", i);
    double const film = add_lump(name, stream_.log_uniform(5.0, 80.0), in_loop_ + i);
    add_joint(fmt::format("loop_{}", int(stream_.uniform() * in_loop_)), name, stream_.log_uniform(0.2, 2.0));
    double const power = film * stream_.log_uniform(5.0, 40.0);
    constexpr char const* flags[] = {"machine.on", "servo.on", "coolant.on", "spindle.running"};
    if (auto const kind = std::size_t(5.0 * stream_.uniform()); kind < 4)
      text_ += fmt::format("\n[[heat]]\nname = \"{0}\"\nat = \"{0}\"\npower = \"{1:.6g} W\"\nwhile_on = \"{2}\"\n",
                           name, power, flags[kind]);
    else
      add_spindle_heat(name, power);
  }
  void add_displacement(std::string const& axis) {
    text_ += fmt::format("\n[[displacement]]\nname = \"E_{}\"\nsegment = [\n", axis);
    for (int i = 0; i < in_loop_; ++i)
      if (stream_.uniform() < 0.4 || i == in_loop_ - 1)
        text_ += fmt::format("  {{ of = \"loop_{}\", length = \"{:.6g} mm\", weight = {} }},\n", i,
                             stream_.log_uniform(50.0, 400.0), stream_.uniform() < 0.5 ? -1 : 1);
    text_ += "]\n";
  }

  RandomStream stream_;
  int in_loop_, beside_;
  std::string text_;
};

}  // namespace thermotwin::twin
