#include <map>
#include <memory>
#include <optional>

#include "thermal/error.h"
#include "thermal/natural_convection.h"
#include "thermal/rotating_surface.h"
#include "twin/assembly.h"
#include "twin/effect.h"
#include "twin/effects/part_time_motion.h"
#include "twin/effects/sized_surface.h"
#include "twin/file/document.h"

namespace thermotwin::twin {
namespace {

/// q = G (T_fluid − T_surface), G = A/(1/(f h) + r). Ports: surface cell, fluid. c = {A, r, size, coefficient,
/// emissivity, f}, u = {ω}; of what turns, those of part_time_motion.h, and G is the mean over motion and rest. The
/// correlation gives h from the temperatures, the speed and what else it needs.
template <class Correlation>
struct FilmLaw {
  static constexpr std::string_view name = Correlation::name;
  static constexpr int ports = 2, coefficients = 6, inputs = Correlation::turns ? 2 : 1;
  static constexpr bool conservative = true, in_lanes = true;
  template <class S>
  static void flows(S const* T, S const* c, double const* u, S* q) {
    auto const at = [&](double speed) { return conductance(T, c, speed); };
    if constexpr (Correlation::turns)
      q[0] = mean_over_motion(u, at) * (T[1] - T[0]);
    else
      q[0] = at(u[0]) * (T[1] - T[0]);
    q[1] = -q[0];
  }

 private:
  template <class S>
  static S conductance(S const* T, S const* c, double speed) {
    S const h = c[5] * Correlation::template film<S>(T[0], T[1], c[2], c[3], c[4], speed);
    return c[0] * h / (1.0 + c[1] * h);
  }
};

/// Forced and free convection of a horizontal cylinder together.
template <class S>
S with_free_cylinder(S const& forced, S const& surface, S const& fluid, S const& diameter) {
  return thermal::assisting_convection<S>(forced, thermal::horizontal_cylinder_film<S>(surface, fluid, diameter));
}

template <class S, class Nusselt>
S forced_cylinder(S const& surface, S const& fluid, S const& diameter, double speed, Nusselt nusselt) {
  auto const air = thermal::properties(thermal::Air{}, S(0.5 * (surface + fluid)));
  S const reynolds = thermal::cylinder_reynolds<S>(S(speed), diameter, air.kinematic_viscosity);
  return nusselt(reynolds, air.prandtl) * air.conductivity / diameter;
}

template <class S>
S jungnickel_plate(S const& surface, S const& fluid, S const& height) {
  auto const air = thermal::properties(thermal::Air{}, S(0.5 * (surface + fluid)));
  S const rayleigh = thermal::rayleigh<S>(air, surface - fluid, height);
  return thermal::jungnickel_vertical_plate_nusselt<S>(rayleigh) * air.conductivity / height;
}

#define THERMOTWIN_CORRELATION(Name, title, does_turn, expression)                                            \
  struct Name {                                                                                               \
    static constexpr std::string_view name = title;                                                           \
    static constexpr bool turns = does_turn;                                                                  \
    template <class S>                                                                                        \
    static S film(S const& surface, S const& fluid, S const& size, S const& coefficient, S const& emissivity, \
                  double speed) {                                                                             \
      (void)surface, (void)fluid, (void)size, (void)coefficient, (void)emissivity, (void)speed;               \
      return expression;                                                                                      \
    }                                                                                                         \
  };
THERMOTWIN_CORRELATION(Constant, "constant film", false, coefficient)
THERMOTWIN_CORRELATION(Room, "room film", false, (thermal::room_film<S>(surface, fluid, emissivity)))
THERMOTWIN_CORRELATION(Fan, "film under a fan", false,
                       (speed > 0.0 ? coefficient : thermal::room_film<S>(surface, fluid, emissivity)))
THERMOTWIN_CORRELATION(RotatingCylinder, "rotating cylinder", true,
                       (thermal::rotating_cylinder_film<S>(surface, fluid, size, S(speed))))
THERMOTWIN_CORRELATION(RotatingDisc, "rotating disc", true,
                       (thermal::rotating_disc_film<S>(surface, fluid, 0.5 * size, S(speed))))
THERMOTWIN_CORRELATION(JungnickelCylinder, "rotating cylinder after Jungnickel", true,
                       (with_free_cylinder<S>(thermal::jungnickel_cylinder_film<S>(S(speed), 0.5 * size), surface,
                                              fluid, size)))
THERMOTWIN_CORRELATION(AndersonSaundersCylinder, "rotating cylinder after Anderson and Saunders", true,
                       (with_free_cylinder<S>(forced_cylinder<S>(surface, fluid, size, speed,
                                                                 [](S const& Re, S const&) {
                                                                   return thermal::anderson_saunders_nusselt<S>(Re);
                                                                 }),
                                              surface, fluid, size)))
THERMOTWIN_CORRELATION(SlowCylinder, "slowly rotating cylinder", true,
                       (with_free_cylinder<S>(forced_cylinder<S>(surface, fluid, size, speed,
                                                                 [](S const& Re, S const& Pr) {
                                                                   return thermal::slow_cylinder_nusselt<S>(Re, Pr);
                                                                 }),
                                              surface, fluid, size)))
THERMOTWIN_CORRELATION(JungnickelDisc, "rotating disc after Jungnickel", true,
                       (thermal::jungnickel_disc_film<S>(S(speed), 0.5 * size)))
THERMOTWIN_CORRELATION(JungnickelPlate, "vertical plate after Jungnickel", false,
                       (jungnickel_plate<S>(surface, fluid, size)))
THERMOTWIN_CORRELATION(VerticalPlate, "vertical plate", false, (thermal::vertical_plate_film<S>(surface, fluid, size)))
THERMOTWIN_CORRELATION(PlateUp, "horizontal plate facing up", false,
                       (thermal::horizontal_plate_film<S>(thermal::Facing::up, surface, fluid, size)))
THERMOTWIN_CORRELATION(PlateDown, "horizontal plate facing down", false,
                       (thermal::horizontal_plate_film<S>(thermal::Facing::down, surface, fluid, size)))
THERMOTWIN_CORRELATION(HorizontalCylinder, "horizontal cylinder", false,
                       (thermal::horizontal_cylinder_film<S>(surface, fluid, size)))
#undef THERMOTWIN_CORRELATION

std::map<std::string, std::shared_ptr<thermal::Law const>> const& correlations() {
  static std::map<std::string, std::shared_ptr<thermal::Law const>> const laws = {
      {"constant", thermal::law_of<FilmLaw<Constant>>()},
      {"room", thermal::law_of<FilmLaw<Room>>()},
      {"fan", thermal::law_of<FilmLaw<Fan>>()},
      {"rotating_cylinder", thermal::law_of<FilmLaw<RotatingCylinder>>()},
      {"rotating_disc", thermal::law_of<FilmLaw<RotatingDisc>>()},
      {"rotating_cylinder_jungnickel", thermal::law_of<FilmLaw<JungnickelCylinder>>()},
      {"rotating_cylinder_anderson", thermal::law_of<FilmLaw<AndersonSaundersCylinder>>()},
      {"rotating_cylinder_slow", thermal::law_of<FilmLaw<SlowCylinder>>()},
      {"rotating_disc_jungnickel", thermal::law_of<FilmLaw<JungnickelDisc>>()},
      {"vertical_plate_jungnickel", thermal::law_of<FilmLaw<JungnickelPlate>>()},
      {"vertical_plate", thermal::law_of<FilmLaw<VerticalPlate>>()},
      {"plate_facing_up", thermal::law_of<FilmLaw<PlateUp>>()},
      {"plate_facing_down", thermal::law_of<FilmLaw<PlateDown>>()},
      {"horizontal_cylinder", thermal::law_of<FilmLaw<HorizontalCylinder>>()}};
  return laws;
}

std::vector<std::string> correlation_names() {
  std::vector<std::string> names;
  for (auto const& entry : correlations()) names.push_back(entry.first);
  return names;
}

struct Film {
  std::string name, to = "ambient", correlation = "room";
  std::vector<std::string> on;
  std::optional<double> area, coefficient, diameter, height;
  double emissivity = thermal::painted_emissivity, factor = 1.0;
  std::string speed = "spindle.speed";

  template <class Fields>
  static void fields(Fields& f) {
    f.name("name", &Film::name, "unique among the films");
    f("on", &Film::on, "surface; several: they share the area as drawn");
    f("to", &Film::to, "\"ambient\", the room air at each cell's height, or the body of a fluid");
    f.choice("correlation", &Film::correlation, correlation_names(), "how the coefficient is found");
    f("area", &Film::area, dimension::area, "default: that of the surface; a lump has none of its own", plausible_area);
    f("coefficient", &Film::coefficient, dimension::film_coefficient, "of a constant film or one under a fan",
      Range{1.0, 2e4});
    f("diameter", &Film::diameter, dimension::length, "of a cylinder or disc", plausible_diameter.above_zero());
    f("height", &Film::height, dimension::length, "of a vertical plate; area over perimeter of a horizontal one",
      plausible_length.above_zero());
    f("emissivity", &Film::emissivity, dimension::dimensionless, "of a room film", Range{0.05, 1.0}.up_to(1.0));
    f("factor", &Film::factor, dimension::dimensionless, "of the surface's coefficient over the correlation's",
      Range{0.1, 10.0});
    f("speed", &Film::speed, "input channel with the speed of rotation, or what runs the fan");
  }

  void check(Value const& table) const {
    auto const refuse = [&](char const* key) {
      if (table.find(key))
        throw FileError(where_of(table, key),
                        fmt::format("'{}' does nothing with correlation = \"{}\"", key, correlation));
    };
    if (!is_round()) refuse("diameter");
    if (!is_plate()) refuse("height");
  }

  void add_to(Assembly& assembly) const {
    if (on.empty()) throw thermal::InputError("film '" + name + "' needs a surface: on = \"head.x_max\"");
    std::vector<Place> places;
    double drawn = 0.0;
    for (auto const& text : on) drawn += places.emplace_back(assembly.surface(text)).area();
    for (auto const& place : places) {
      double const share = drawn > 0.0 ? place.area() / drawn : 1.0 / double(places.size());
      auto own = area;
      if (own) *own *= share;
      add_to(assembly, sized_surface(place, own, "film '" + name + "'"));
    }
  }

 private:
  void add_to(Assembly& assembly, Place const& place) const {
    // The speed of a film that does not rotate is asked from a channel that every course has.
    auto const inputs = correlation.starts_with("rotating")
                            ? assembly.friction_channels(speed)
                            : std::vector{assembly.channel(correlation == "fan" ? speed : "ambient.floor_temperature")};
    for (auto const& contact : place.site.contacts)
      assembly.network().add(correlations().at(correlation), assembly.part(),
                             {assembly.node(place, contact.node), fluid(assembly, contact.centre)},
                             {contact.area, contact.half_resistance, size(), needed(), emissivity, factor}, inputs);
  }
  [[nodiscard]] thermal::Port fluid(Assembly& assembly, Eigen::Vector3d const& point) const {
    return to == "ambient" ? assembly.air(point) : assembly.port(assembly.place(to, {"ambient"}));
  }
  [[nodiscard]] double size() const {
    if (!is_round() && !is_plate()) return 1.0;
    auto const& given = is_round() ? diameter : height;
    if (given) return *given;
    throw thermal::InputError("film '" + name + "': " + correlation + " needs a " +
                              (is_round() ? "diameter" : "height"));
  }
  [[nodiscard]] bool is_round() const {
    return correlation.find("cylinder") != std::string::npos || correlation.starts_with("rotating_disc");
  }
  [[nodiscard]] bool is_plate() const { return correlation.find("plate") != std::string::npos; }
  [[nodiscard]] double needed() const {
    bool const is_given = correlation == "constant" || correlation == "fan";
    if (is_given && !coefficient)
      throw thermal::InputError("film '" + name + "': correlation " + correlation + " needs a coefficient");
    if (coefficient && !is_given)
      throw thermal::InputError(
          "film '" + name + "': correlation " + correlation +
          " has its own coefficient; one that is given needs correlation = \"constant\" or \"fan\"");
    return coefficient.value_or(0.0);
  }
};

}  // namespace

Effect const& film_effect() {
  static Effect const effect = make_effect<Film>(
      {"film",
       "convection and radiation from a surface to the room or to a fluid",
       "q = f h A (T_fluid − T_surface), in series with the half cell of a discretised body; on a screw the mean over "
       "motion and rest. room: h = 1.7·1.3 "
       "|ΔT|^(1/3) + "
       "0.8 ε 4σ T_m³;  rotating_cylinder: Nu = (Nu_f³ + Nu_n³)^(1/3), Nu_f = 0.133 Re^(2/3) Pr^(1/3) (anderson: 0.10 "
       "Re^(2/3); slow: 0.683 Re^0.466 Pr^(1/3); jungnickel: h = 3.75 ω^0.7 R^0.4), Nu_n Churchill & Chu;  "
       "rotating_disc: "
       "Nu = 0.36 Re^(1/2), turbulent 0.015 Re^0.8 (jungnickel: h = 2.73 ω^0.8 R^0.6), 0 at rest;  vertical_plate: "
       "Churchill & Chu (jungnickel: 0.55 Ra^(1/4), 0.14 Ra^(1/3));  fan: constant while it runs, room film otherwise",
       "film",
       "any surface",
       "sink proportional to T − T_air; sets the slow time constants; a rotating surface cools with speed^0.67 and "
       "stops "
       "cooling when it stops",
       "physics.md 2.5, 2.6 (2.6), (2.8); Becker 1963; Anderson & Saunders 1953; Churchill & Chu 1975; Jungnickel "
       "2010",
       {3},
       {"channel_wall"},
       "two flows: what a pipe loses to the room is felt most at the slower one, and in the steady state"},
      {{.amplitude = "coefficient",
        .largest = 20.0,
        .sites = {{"on", "wetted wall"}},
        .shapes = {{{"correlation", "constant"}}}}});
  return effect;
}

}  // namespace thermotwin::twin
