#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "output/json_text.h"
#include "twin/placement/sensor_placement.h"

namespace thermotwin::twin {
namespace {

using Json = nlohmann::ordered_json;

/// By how much a part is more than the whole; nothing smaller than what is printed, which would be "-0.0".
double percent(double part, double whole) {
  double const more = whole > 0.0 ? 100.0 * (part / whole - 1.0) : 0.0;
  return std::abs(more) < 0.05 ? 0.0 : more;
}

/// In millimetres; the air has no place.
std::string position_text(SetFigures::Sensor const& sensor) {
  Eigen::Vector3d const p = 1e3 * sensor.position;
  if (sensor.site.at == std::vector<std::string>{"ambient"}) return "room air";
  return fmt::format("{:.0f} {:.0f} {:.0f}", p.x(), p.y(), p.z());
}

std::string idle(SetFigures::Sensor const&) { return "idle"; }

/// `idle_text`: what a sensor is there for without which the error hardly changes.
template <class Text>
std::string set_table(SetFigures const& set, Text idle_text) {
  std::size_t width = 4;
  for (auto const& sensor : set.sensors) width = std::max(width, sensor.site.name.size());
  std::string text = fmt::format("  {:<3} {:<{}}  {:>22}  {:>5}  {:>16}\n", "", "site", width, "position [mm]", "cost",
                                 "error without it");
  int number = 0;
  for (auto const& sensor : set.sensors)
    text += fmt::format("  {:<3} {:<{}}  {:>22}  {:>5g}  {:>8.2f} um {:+4.0f} %{}\n", ++number, sensor.site.name, width,
                        position_text(sensor), sensor.site.cost, sensor.error_without_um,
                        percent(sensor.error_without_um, set.model_um), sensor.idle ? "  " + idle_text(sensor) : "");
  text += fmt::format("\n  {:<14} {:>14} {:>14} {:>14}\n", "error [um]", "no sensor", "predicted 1s", "unseen rms");
  for (auto const& channel : set.channels)
    text += fmt::format("  {:<14} {:>14.2f} {:>14.2f} {:>14.2f}\n", channel.name, channel.prior_um,
                        channel.predicted_um, channel.unseen_um);
  return text;
}

std::string teacher_text(Teacher teacher) {
  return teacher == Teacher::family
             ? "one estimate for all of them, before the machine is there (--trained: each has its own)"
             : "each has an estimate of its own, trained on itself: the other of its spectra judges";
}

std::string numbers_text(PlacementReport const& report) {
  std::string const by_kind =
      "by 20 % (coefficients, films, powers, friction) or 10 % (capacities, weights of the loop)";
  auto const numbers = [](std::size_t count) { return count == 1 ? "1 number" : fmt::format("{} numbers", count); };
  if (report.ranged == 0) return fmt::format("{} drawn {}", numbers(report.numbers), by_kind);
  return fmt::format("{} drawn within the file's own ranges, {} {}", numbers(report.ranged),
                     report.numbers - report.ranged, by_kind);
}

double degrees(double angle) { return angle * 180.0 / std::numbers::pi; }

/// How much wider the angle of another set of so many could be.
std::string widest_text(Distinction const& d, std::size_t count) {
  return d.proved ? fmt::format("no set of {} has a wider one: all were looked at\n", count)
                  : fmt::format("sets of {} are too many to look at all: another may have a wider one\n", count);
}

std::string distinction_text(Distinction const& d, std::size_t count) {
  std::string text = fmt::format(
      "\ntelling {} missing effects apart: smallest angle between the signatures of two\n"
      "  recommended      {:6.2f} degrees ({} and {})\n"
      "  for displacement {:6.2f} degrees: the set that would be chosen for the smallest error\n",
      d.effects, degrees(d.recommended), d.first, d.second, degrees(d.for_displacement));
  if (d.fewer) text += fmt::format("  widest of {:<6} {:6.2f} degrees\n", count - 1, degrees(*d.fewer));
  if (d.more) text += fmt::format("  widest of {:<6} {:6.2f} degrees\n", count + 1, degrees(*d.more));
  if (d.proposed) text += fmt::format("  proposed         {:6.2f} degrees\n", degrees(*d.proposed));
  return text +
         fmt::format(
             "  all candidates   {:6.2f} degrees\n"
             "{} pairs; {} more that even all candidates take for each other (cosine beyond 0.6) are left out\n",
             degrees(d.of_all), d.pairs, d.alike) +
         widest_text(d, count);
}

Json to_json(Distinction const& d) {
  Json json = {{"effects", d.effects},
               {"pairs", d.pairs},
               {"pairs_alike_to_all_candidates", d.alike},
               {"recommended_deg", degrees(d.recommended)},
               {"for_displacement_deg", degrees(d.for_displacement)},
               {"all_candidates_deg", degrees(d.of_all)},
               {"closest", {d.first, d.second}},
               {"idle", d.idle},
               {"all_sets_looked_at", d.proved}};
  if (d.fewer) json["one_fewer_deg"] = degrees(*d.fewer);
  if (d.more) json["one_more_deg"] = degrees(*d.more);
  if (d.proposed) json["proposed_deg"] = degrees(*d.proposed);
  return json;
}

/// What sensors leave of all displacements together, a line for each set.
class ErrorTable {
 public:
  explicit ErrorTable(PlacementReport const& report) : report_(report) {
    auto const count = report.recommended.sensors.size();
    std::string const best = report.distinction ? "for displacement" : "best";
    if (report.fewer) sets_.emplace_back(fmt::format("{} {}", best, count - 1), &*report.fewer);
    sets_.emplace_back(fmt::format("recommended {}", count), &report.recommended);
    if (report.more) sets_.emplace_back(fmt::format("{} {}", best, count + 1), &*report.more);
    if (auto const& proposed = report.proposed) {
      if (proposed->fewer) sets_.emplace_back("proposed, no " + proposed->without, &*proposed->fewer);
      sets_.emplace_back(fmt::format("proposed {}", proposed->set.sensors.size()), &proposed->set);
      if (proposed->more) sets_.emplace_back("proposed + " + proposed->with, &*proposed->more);
    }
    for (auto const& [name, set] : sets_) width_ = std::max(width_, name.size());
  }

  [[nodiscard]] std::string text() const {
    std::string text = fmt::format("  {:<{}} {:>8} {:>13} {:>12}  {:>16} {:>11}", "all displacements [um]", width_,
                                   "model", "predicted 1s", "unseen rms", "80 % of machines", "over rec.");
    if (report_.dead > 0) text += fmt::format("  {:>12}", fmt::format("any {} dead", report_.dead));
    text += fmt::format("\n  {:<{}} {:>8.2f}\n", "no sensor", width_, report_.prior_um);
    for (auto const& [name, set] : sets_) text += line(name, *set);
    return text + fmt::format("  {:<{}} {:>8.2f} {:>13} {:>12}  {:>16} {}\n", fmt::format("all {}", report_.candidates),
                              width_, report_.floor_um, "", "", "", over_recommended(report_.floor_um));
  }

 private:
  [[nodiscard]] std::string over_recommended(double model_um) const {
    return fmt::format("{:>+9.1f} %", percent(model_um, report_.recommended.model_um));
  }
  [[nodiscard]] std::string line(std::string const& name, SetFigures const& set) const {
    return fmt::format("  {:<{}} {:>8.2f} {:>13.2f} {:>12.2f}  {:>6.2f} .. {:<6.2f} {}{}\n", name, width_, set.model_um,
                       set.predicted_um, set.unseen_um, set.unseen_low_um, set.unseen_high_um,
                       over_recommended(set.model_um),
                       report_.dead > 0 ? fmt::format("  {:>12.2f}", set.worst_um) : "");
  }

  PlacementReport const& report_;
  std::vector<std::pair<std::string, SetFigures const*>> sets_;
  std::size_t width_ = 26;
};

/// Of the recommended.
std::string idle_in(PlacementReport const& report, SetFigures::Sensor const& sensor) {
  if (report.dead > 0) return "spare";
  auto const& distinction = report.distinction;
  if (!distinction || std::count(distinction->idle.begin(), distinction->idle.end(), sensor.site.name) > 0)
    return idle(sensor);
  return "for the effects";
}

/// "8 of 200 sites", or "8 sensors for 5 sites".
std::string sites_text(PlacementReport const& report, std::size_t count) {
  return count > report.candidates ? fmt::format("{} sensors for {} sites", count, report.candidates)
                                   : fmt::format("{} of {} sites", count, report.candidates);
}

Json to_json(SetFigures const& set, int dead) {
  Json sensors = Json::array(), channels = Json::array();
  for (auto const& sensor : set.sensors)
    sensors.push_back({{"name", sensor.site.name},
                       {"at", sensor.site.at},
                       {"position_m", {sensor.position.x(), sensor.position.y(), sensor.position.z()}},
                       {"cost", sensor.site.cost},
                       {"error_without_um", sensor.error_without_um},
                       {"idle", sensor.idle}});
  for (auto const& channel : set.channels)
    channels.push_back({{"name", channel.name},
                        {"without_sensors_um", channel.prior_um},
                        {"predicted_um", channel.predicted_um},
                        {"unseen_rms_um", channel.unseen_um}});
  Json json = {{"sensors", sensors},
               {"cost", set.cost},
               {"model_um", set.model_um},
               {"predicted_um", set.predicted_um},
               {"unseen_rms_um", set.unseen_um},
               {"unseen_machines_um", {{"10 %", set.unseen_low_um}, {"90 %", set.unseen_high_um}}},
               {"displacements", channels}};
  if (dead > 0) json["worst_with_dead_sensors_um"] = set.worst_um;
  return json;
}

/// What its author calls a site; empty: it is called by its place.
std::string own_name(CandidateSite const& site) {
  bool const by_place = site.name.starts_with(fmt::format("{}", fmt::join(site.at, " and ")));
  return by_place || site.name.find_first_of("\"\\") != std::string::npos ? "" : site.name;
}

/// Names that no sensor of the machine has, and no two of these.
std::vector<std::string> sensor_names(PlacementReport const& report) {
  auto const& sensors = report.recommended.sensors;
  auto taken = report.taken;
  std::vector<std::string> names;
  for (auto const& sensor : sensors) {
    auto const own = own_name(sensor.site);
    names.push_back(!own.empty() && taken.insert(own).second ? own : "");
  }
  int number = 0;
  for (auto& name : names)
    while (name.empty())
      if (auto const next = fmt::format("P{}", ++number); taken.insert(next).second) name = next;
  return names;
}

Json list_of(Eigen::VectorXd const& values) { return std::vector<double>(values.begin(), values.end()); }

}  // namespace

std::string placement_text(PlacementReport const& report) {
  auto const& best = report.recommended;
  auto const count = best.sensors.size();
  std::string text = fmt::format(
      "{} on {}; sensors with an error of {:g} K of their own\n"
      "{} machines that the file could stand for, {} spectra each; judged on {} others with other spectra\n"
      "{}\n{}\n\nrecommended\n\n{}\n",
      sites_text(report, count), report.machine, report.noise, report.members, report.experiments.size(),
      report.unseen_members, numbers_text(report), teacher_text(report.teacher),
      set_table(best, [&](auto const& sensor) { return idle_in(report, sensor); }));
  if (report.proposed) text += fmt::format("proposed\n\n{}\n", set_table(report.proposed->set, idle));
  text += ErrorTable(report).text();
  if (!report.remarks.empty()) text += "\n";
  for (auto const& remark : report.remarks) text += remark + "\n";
  if (report.dead > 0)
    text += fmt::format("\nwith any {} of them dead: at most {:.2f} um, {:.2f} times the error of all\n", report.dead,
                        best.worst_um, best.worst_um / best.model_um);
  if (report.distinction) return text + distinction_text(*report.distinction, count);
  text += report.proved
              ? fmt::format("\nno set of {} is better: all were looked at\n", count)
              : fmt::format("\nno set of {}{} has less than {:.2f} um: this one is at most {:.1f} % above the best\n",
                            count, report.dead > 0 ? ", all at work," : "", report.bound_um,
                            percent(best.model_um, report.bound_um));
  return text;
}

std::string placement_json(PlacementReport const& report) {
  Json json = {{"machine", report.machine},
               {"remarks", report.remarks},
               {"candidates", report.candidates},
               {"noise_K", report.noise},
               {"members", report.members},
               {"numbers_drawn", {{"within_stated_ranges", report.ranged}, {"all", report.numbers}}},
               {"experiments", report.experiments},
               {"unseen_members", report.unseen_members},
               {"unseen_experiments", report.unseen_experiments},
               {"dead", report.dead},
               {"trained_on_the_machine", report.teacher == Teacher::machine},
               {"no_sensor_um", report.prior_um},
               {"all_candidates_um", report.floor_um},
               {"bound_um", report.bound_um}};
  if (!report.distinction) json["above_bound"] = report.recommended.model_um / report.bound_um - 1.0;
  json["all_sets_looked_at"] = report.proved;
  json["recommended"] = to_json(report.recommended, report.dead);
  if (report.fewer) json["one_fewer"] = to_json(*report.fewer, report.dead);
  if (report.more) json["one_more"] = to_json(*report.more, report.dead);
  if (auto const& proposed = report.proposed) {
    json["proposed"] = to_json(proposed->set, report.dead);
    if (proposed->fewer)
      json["proposed_one_fewer"] = {{"without", proposed->without}, {"set", to_json(*proposed->fewer, report.dead)}};
    if (proposed->more)
      json["proposed_one_more"] = {{"with", proposed->with}, {"set", to_json(*proposed->more, report.dead)}};
  }
  if (report.distinction) json["distinction"] = to_json(*report.distinction);
  if (report.map)
    json["map"] = {{"alone_um", list_of(report.map->alone_um)}, {"beside_um", list_of(report.map->beside_um)}};
  return output::json_text(std::move(json));
}

std::string sensor_tables(PlacementReport const& report) {
  std::string text = fmt::format("# {} sensors for {}: predicted error {:.2f} um (1 sigma)\n",
                                 report.recommended.sensors.size(), report.machine, report.recommended.predicted_um);
  auto const names = sensor_names(report);
  auto name = names.begin();
  for (auto const& sensor : report.recommended.sensors) {
    text += fmt::format("\n[[temperature_sensor]]\nname = \"{}\"\n", *name++);
    text += sensor.site.at.size() == 1 ? fmt::format("at = \"{}\"\n", sensor.site.at[0])
                                       : fmt::format("at = [\"{}\"]\n", fmt::join(sensor.site.at, "\", \""));
  }
  return text;
}

}  // namespace thermotwin::twin
