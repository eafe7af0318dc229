#include "twin/challenge/hidden_world.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <set>

#include "thermal/error.h"
#include "thermal/nearest_name.h"
#include "thermal/units.h"
#include "twin/challenge/challenge_runs.h"
#include "twin/challenge/refined_form.h"
#include "twin/file/document.h"
#include "twin/instruments/correlated_noise.h"
#include "twin/run.h"
#include "twin/uncertain_range.h"

namespace thermotwin::twin {
namespace {

using thermal::InputError;

constexpr double coefficient_spread = 0.2, capacity_spread = 0.1;
constexpr double least_amplitude = 0.15, most_amplitude = 0.8;  // shares of the largest plausible one
constexpr double least_displacement = 1e-6, least_rise = 0.4;   // that a hidden effect causes [m, K]
constexpr double most_rise = 25.0;                              // beyond it nobody would call it an effect [K]
constexpr int attempts = 60;

std::array<std::string, 5> const kind_names = {"one", "none", "outside", "two", "sensor"};

/// Draws one factor for a key of a table, if the table has it as a number: lognormal, or evenly within the range that
/// the file states.
class Variation {
 public:
  Variation(Value const& document, RandomStream& stream, double spread, std::map<std::string, double>& drawn)
      : ranges_(ranged_numbers(document)), stream_(stream), spread_(spread), drawn_(drawn) {}

  bool operator()(Value& table, std::string const& path, std::string const& key, thermal::Dimension dimension,
                  double spread, double highest = INFINITY) {
    auto const nominal = number_in(table, key, dimension);
    if (!nominal || *nominal == 0.0) return false;
    auto const name = path + "." + key;
    auto const range = std::find_if(ranges_.begin(), ranges_.end(), [&](auto& r) { return r.number.path == name; });
    double const normal = stream_.normal();
    double const value = range != ranges_.end() ? within(*range, normal)
                                                : std::min(*nominal * std::exp(spread_ * spread * normal), highest);
    drawn_[name] = value / *nominal;
    if (dimension == thermal::dimension::dimensionless)
      set_key(table, key, value);
    else
      set_key(table, key, thermal::format_quantity(value, dimension));
    return true;
  }

  /// What the file states a range of and nothing else draws.
  void rest(Value& document) {
    for (auto const& range : ranges_) {
      if (drawn_.contains(range.number.path)) continue;
      double const value = within(range, stream_.normal());
      drawn_[range.number.path] = value / range.number.value;
      set_number(document, range.number, value);
    }
  }

 private:
  /// Even over the range, as the normal number is over its quantiles; without spread the file's own.
  [[nodiscard]] double within(RangedNumber const& range, double normal) const {
    double const share = 0.5 * std::erfc(-normal / std::numbers::sqrt2);
    return std::lerp(range.number.value, std::lerp(range.low, range.high, share), spread_);
  }

  std::vector<RangedNumber> ranges_;
  RandomStream& stream_;
  double spread_;
  std::map<std::string, double>& drawn_;
};

bool is_plate(Value const& table) { return name_in(table).ends_with("_plate"); }

void vary_capacities(Value& document, Variation& vary) {
  for (auto const& [kind, key, dimension] :
       {std::tuple("lump", "mass", dimension::mass), std::tuple("lump", "heat_capacity", dimension::heat_capacity),
        std::tuple("block", "solidity", dimension::dimensionless)})
    for (auto* table : tables_of(document, kind))
      if (!is_plate(*table))
        vary(*table, fmt::format("{}.{}", kind, name_in(*table)), key, dimension, capacity_spread,
             std::string(key) == "solidity" ? 1.0 : INFINITY);
}

/// What a drawing does not show of them: a factor, 1 where the file has none, from a stream of its own.
void vary_factor(Value& document, std::vector<std::string> const& kinds, std::string const& key, RandomStream stream,
                 std::map<std::string, double>& drawn) {
  Variation vary(document, stream, 1.0, drawn);
  for (auto const& kind : kinds)
    for (auto* table : tables_of(document, kind)) {
      if (!table->find(key)) set_key(*table, key, 1.0);
      vary(*table, fmt::format("{}.{}", kind, name_in(*table)), key, dimension::dimensionless, capacity_spread);
    }
}

bool is_coefficient(FieldRecord const& field) {
  static std::set<std::string> const others = {"grease_factor", "torque_load",     "drag_torque",
                                               "preload",       "constant_torque", "resistance"};
  return field.dimension == dimension::conductance || field.dimension == dimension::film_coefficient ||
         field.dimension == dimension::power || field.dimension == dimension::volume_flow || others.contains(field.key);
}

/// Conductances, film coefficients, powers, friction; of a film without a coefficient, and of nothing else, the area.
void vary_parts(Value& document, Variation& vary) {
  for (auto const& entry : effect_catalogue())
    for (auto* table : tables_of(document, entry.name)) {
      auto const path = fmt::format("{}.{}", entry.name, name_in(*table));
      bool varied = false;
      for (auto const& field : entry.parameters)
        if (is_coefficient(field)) varied |= vary(*table, path, field.key, field.dimension, coefficient_spread);
      if (!varied) vary(*table, path, "area", dimension::area, coefficient_spread);
    }
}

void vary_loops(Value& document, Variation& vary) {
  for (std::string const kind : {"displacement", "rotation"})
    for (auto* table : tables_of(document, kind)) {
      erase_key(*table, "closure");
      for (std::string const list : {"segment", "influence"}) {
        int index = 0;
        for (auto* segment : tables_of(*table, list)) {
          if (!segment->find("weight")) set_key(*segment, "weight", 1.0);
          vary(*segment, fmt::format("{}.{}.{}.{}", kind, name_in(*table), list, index++), "weight",
               dimension::dimensionless, capacity_spread);
        }
      }
    }
}

void draw_sensors(Value& document, RandomStream& stream, std::map<std::string, double>& drawn) {
  for (auto* table : tables_of(document, "temperature_sensor")) {
    auto const set = [&](std::string const& key, double value, std::string const& text) {
      drawn[fmt::format("temperature_sensor.{}.{}", name_in(*table), key)] = value;
      set_key(*table, key, text);
    };
    auto const kelvin = [&](std::string const& key, double value) { set(key, value, fmt::format("{:.9g} K", value)); };
    double const lag = stream.log_uniform(10.0, 60.0), stem = stream.uniform(0.01, 0.03);
    kelvin("offset", stream.within(0.15, 0.45));
    kelvin("self_heating", stream.uniform(0.0, 0.02));
    kelvin("noise", stream.uniform(0.005, 0.02));
    set("lag", lag, fmt::format("{:.9g} s", lag));
    set_key(*table, "stem_loss", stem);
    set_key(*table, "gain", 0.0);
    set_key(*table, "drift", std::string("0 K/s"));
    set_key(*table, "correlated_noise", std::string("0.1 K"));
    set_key(*table, "correlation_time", std::string("10 min"));
  }
}

/// What a sensor does is a fault, not an effect of the machine.
bool about_sensor(Hypothesis const& hypothesis) {
  auto const& sites = hypothesis.trial->sites;
  return std::any_of(sites.begin(), sites.end(), [](auto const& site) { return site.kind == "sensor"; });
}

/// What the nominal machine shows, without instruments.
struct Shown {
  output::Dataset dataset;

  /// Largest difference of a tool displacement [m] and of a temperature at a sensor [K].
  [[nodiscard]] std::pair<double, double> largest_difference(Shown const& other) const {
    auto const largest = [](auto const& a, auto const& b, std::string const& unit) {
      double difference = 0.0;
      for (std::size_t c = 0; c < a.size(); ++c)
        if (a[c].unit == unit) difference = std::max(difference, (a[c].values - b[c].values).cwiseAbs().maxCoeff());
      return difference;
    };
    return {1e-6 * largest(dataset.truth_displacements, other.dataset.truth_displacements, "um"),
            largest(dataset.truth_readings, other.dataset.truth_readings, "degC")};
  }
};

Shown show(Value const& document, scenarios::Experiment const& experiment) {
  RunOptions options;
  options.integration.relative_tolerance = options.integration.absolute_tolerance = 1e-5;
  return {run(Machine::build(document), experiment, options).dataset};
}

/// Draws effects one after another, each at a site and of a size that shows on the held-out run.
class EffectDraw {
 public:
  EffectDraw(Value const& nominal, RefinedForm const& form, RandomStream& stream, std::uint64_t seed)
      : nominal_(nominal),
        form_(form),
        stream_(stream),
        machine_(Machine::build(nominal)),
        hardest_(challenge_runs(machine_.limits, seed).front()),
        held_out_(challenge_runs(machine_.limits, seed).back()),
        all_(hypotheses(nominal, machine_)) {
    std::erase_if(all_, [](Hypothesis const& h) { return h.stands || !h.trial->if_changes.empty(); });
  }

  /// Adds the effect to the document of the hidden world.
  HiddenEffect draw(Value& document, std::vector<HiddenEffect> const& others);
  /// The hidden world's document with the effect; a source on a block takes a part of it. InputError if it cannot be
  /// there.
  [[nodiscard]] Value with(Value const& document, HiddenEffect const& effect, std::string const& name);

 private:
  [[nodiscard]] HiddenEffect pick(std::vector<Hypothesis const*> const& candidates);
  [[nodiscard]] bool matters(HiddenEffect const& effect);
  [[nodiscard]] std::string part_of_block(std::string const& block);

  Value const& nominal_;
  RefinedForm const& form_;
  RandomStream& stream_;
  Machine machine_;
  scenarios::Experiment hardest_, held_out_;
  std::vector<Hypothesis> all_;
  std::optional<Shown> without_;
};

/// An effect by lot, then one of its sites and shapes by lot: frequent effects are those of few sites as well.
HiddenEffect EffectDraw::pick(std::vector<Hypothesis const*> const& candidates) {
  std::set<std::string> names;
  for (auto const* candidate : candidates) names.insert(candidate->effect->name);
  auto name = names.begin();
  std::advance(name, int(stream_.uniform() * double(names.size())));
  std::vector<Hypothesis const*> of_effect;
  for (auto const* candidate : candidates)
    if (candidate->effect->name == *name) of_effect.push_back(candidate);
  Hypothesis chosen = *of_effect[std::size_t(stream_.uniform() * double(of_effect.size()))];
  if (chosen.trial->hidden_up_to > 0.0) chosen.largest = chosen.trial->hidden_up_to;
  double amplitude = chosen.largest * stream_.log_uniform(least_amplitude, most_amplitude);
  if (chosen.trial->either_sign && stream_.uniform() < 0.5) amplitude = -amplitude;
  return {chosen, amplitude};
}

bool EffectDraw::matters(HiddenEffect const& effect) {
  if (!without_) without_ = show(nominal_, held_out_);
  auto const with = show(with_hypothesis(nominal_, effect.hypothesis, "hidden", effect.amplitude), held_out_);
  auto const [displacement, rise] = with.largest_difference(*without_);
  return (displacement >= least_displacement || rise >= least_rise) && rise <= most_rise;
}

HiddenEffect EffectDraw::draw(Value& document, std::vector<HiddenEffect> const& others) {
  std::vector<Hypothesis const*> candidates;
  for (auto const& hypothesis : all_)
    if (!about_sensor(hypothesis) && std::none_of(others.begin(), others.end(), [&](auto const& other) {
          return other.hypothesis.effect == hypothesis.effect;
        }))
      candidates.push_back(&hypothesis);
  for (int attempt = 0; attempt < attempts && !candidates.empty(); ++attempt) {
    auto effect = pick(candidates);
    try {
      if (!matters(effect)) continue;
      Value changed = with(document, effect, fmt::format("hidden_{}", others.size() + 1));
      show(changed, hardest_);
      document = std::move(changed);
      return effect;
    } catch (InputError const&) {
      continue;  // not on this form of the machine
    } catch (thermal::IntegrationError const&) {
      continue;  // it runs away
    }
  }
  throw InputError("the machine has no site where a hidden effect would show");
}

/// A box of between half and all of each edge.
std::string EffectDraw::part_of_block(std::string const& block) {
  Eigen::Vector3d const size = form_.box(block).sizes();
  std::vector<std::string> extents;
  for (int d = 0; d < 3; ++d) {
    double const length = size[d] * stream_.uniform(0.5, 1.0), low = stream_.uniform(0.0, size[d] - length);
    extents.push_back(fmt::format("{:.6g} mm .. {:.6g} mm", low * 1e3, (low + length) * 1e3));
  }
  return fmt::format("{}[{}]", block, fmt::join(extents, ", "));
}

Value EffectDraw::with(Value const& document, HiddenEffect const& effect, std::string const& name) {
  Value table = make_table({document.where.file, 1'000'000, 1}, table_of(effect.hypothesis, name, effect.amplitude));
  auto const at = texts_of(table, "at");
  Value on_part = table;
  if (at.size() == 1 && form_.is_block(at[0])) set_key(on_part, "at", part_of_block(at[0]));
  for (auto const& attempt : {on_part, table}) {
    Value changed = document;
    form_.append(changed, effect.hypothesis.effect->name, attempt);
    try {
      Machine const possible = Machine::build(changed);
      return changed;
    } catch (InputError const&) {
      continue;
    }
  }
  throw InputError(fmt::format("{} cannot act on the other form of the machine", effect.hypothesis.label()));
}

HiddenFault draw_fault(Value& document, RandomStream& stream) {
  std::vector<Value*> sensors;
  for (auto* table : tables_of(document, "temperature_sensor"))
    if (texts_of(*table, "at") != std::vector<std::string>{"ambient"}) sensors.push_back(table);
  if (sensors.empty()) throw InputError("the machine has no sensor that could be faulty");
  Value& table = *sensors[std::size_t(stream.uniform() * double(sensors.size()))];
  HiddenFault fault;
  fault.sensor = name_in(table);
  fault.kind =
      std::array<char const*, 5>{"drift", "lag", "contact", "stuck", "jumping"}[std::size_t(5 * stream.uniform())];
  double const sign = stream.uniform() < 0.5 ? -1.0 : 1.0;
  fault.from = stream.uniform(0.1, 0.6);
  if (fault.kind == "drift") {
    fault.amplitude = sign * stream.log_uniform(0.25, 0.5) / 86400.0;
    set_key(table, "drift", fmt::format("{:.9g} K/day", fault.amplitude * 86400.0));
  } else if (fault.kind == "lag") {
    fault.amplitude = stream.log_uniform(200.0, 900.0);
    set_key(table, "lag", fmt::format("{:.9g} s", fault.amplitude));
  } else if (fault.kind == "contact") {
    fault.amplitude = stream.log_uniform(0.1, 0.3);
    set_key(table, "stem_loss", fault.amplitude);
  } else if (fault.kind == "jumping") {
    fault.amplitude = sign * stream.uniform(0.7, 2.0);
  }
  return fault;
}

void break_sensor(output::Channel& channel, HiddenFault const& fault, std::uint64_t seed, std::string const& run) {
  Eigen::Index const rows = channel.values.size();
  if (fault.kind == "stuck") {
    auto const from = run == "0" ? Eigen::Index(fault.from * double(rows)) : 0;
    channel.values.tail(rows - from).setConstant(channel.values[from]);
    return;
  }
  if (fault.kind != "jumping") return;
  RandomStream stream(seed, fmt::format("jumps {}", run));
  bool off = false;
  double const mean_interval = double(rows) / 6.0;
  for (Eigen::Index r = 0, next = 0; r < rows; ++r) {
    if (r == next) {
      if (r > 0) off = !off;
      next = r + 1 + Eigen::Index(stream.uniform(0.4, 1.6) * mean_interval);
    }
    if (off) channel.values[r] += fault.amplitude;
  }
}

}  // namespace

CaseKind case_kind(std::string const& name) {
  auto const it = std::find(kind_names.begin(), kind_names.end(), name);
  if (it == kind_names.end())
    throw InputError(
        fmt::format("unknown kind '{}'; {}", name,
                    thermal::did_you_mean(name, std::vector<std::string>(kind_names.begin(), kind_names.end()))));
  return CaseKind(it - kind_names.begin());
}

std::string name_of(CaseKind kind) { return kind_names[std::size_t(kind)]; }

CaseKind case_kind(std::uint64_t seed) {
  constexpr std::array kinds = {CaseKind::one, CaseKind::none,    CaseKind::one, CaseKind::two,  CaseKind::one,
                                CaseKind::one, CaseKind::outside, CaseKind::one, CaseKind::none, CaseKind::sensor};
  return kinds[seed % kinds.size()];
}

Value vary_parameters(Value document, std::uint64_t seed, double spread, std::map<std::string, double>& drawn) {
  RandomStream stream(seed, "parameters");
  Variation vary(document, stream, spread, drawn);
  vary_capacities(document, vary);
  vary_parts(document, vary);
  vary_loops(document, vary);
  vary.rest(document);
  erase_key(document, "uncertain");  // what was drawn is known
  return document;
}

HiddenWorld draw_hidden_world(Value const& nominal, std::uint64_t seed, CaseKind kind) {
  HiddenWorld world;
  world.kind = kind;
  world.seed = seed;
  RefinedForm const form(nominal);
  world.healthy = vary_parameters(form.document(), seed, 1.0, world.drawn);
  vary_factor(world.healthy, {"bar", "hollow_cylinder"}, "capacity_factor", RandomStream(seed, "bars"), world.drawn);
  vary_factor(world.healthy, {"ball_screw"}, "growth_factor", RandomStream(seed, "screws"), world.drawn);
  RandomStream sensors(seed, "sensors"), effects(seed, "effects");
  draw_sensors(world.healthy, sensors, world.drawn);
  world.hidden = world.healthy;
  if (kind == CaseKind::none) return world;

  if (kind == CaseKind::sensor) {
    world.fault = draw_fault(world.hidden, effects);
    return world;
  }
  EffectDraw draw(nominal, form, effects, seed);
  for (int i = 0; i < (kind == CaseKind::two ? 2 : 1); ++i)
    world.effects.push_back(draw.draw(world.hidden, world.effects));
  return world;
}

void disturb(output::Dataset& dataset, HiddenWorld const& world, std::string const& run) {
  constexpr double correlation_time = 600.0, radians_per_metre = 2.0;
  for (auto& channel : dataset.displacements) {
    double const scale = channel.unit == "urad" ? radians_per_metre : 1.0;
    auto const name = fmt::format("{} {}", channel.name, run);
    CorrelatedNoise slow({world.seed, "slow " + name}, 0.3 * scale, correlation_time);
    RandomStream white(world.seed, "white " + name);
    for (Eigen::Index r = 0; r < channel.values.size(); ++r)
      channel.values[r] += slow.at(dataset.time_s[r]) + 0.1 * scale * white.normal();
  }
  for (auto& channel : dataset.inputs) {
    RandomStream white(world.seed, fmt::format("{} {}", channel.name, run));
    bool const speed = channel.name.ends_with(".speed") || channel.name.ends_with(".feed");
    if (speed)
      for (auto& value : channel.values) value *= 1.0 + 0.005 * white.normal();
    if (channel.name == "ambient.temperature")
      for (auto& value : channel.values) value += 0.1 * white.normal();
  }
  if (!world.fault) return;
  for (auto& channel : dataset.readings)
    if (channel.name == world.fault->sensor) break_sensor(channel, *world.fault, world.seed, run);
}

}  // namespace thermotwin::twin
