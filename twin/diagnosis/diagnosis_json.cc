#include "twin/diagnosis/diagnosis_json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "output/json_text.h"
#include "thermal/units.h"
#include "twin/diagnosis/separation.h"

namespace thermotwin::twin {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(Finding const& finding, std::size_t group) {
  Json keys = Json::object();
  for (auto const& [key, text] : finding.hypothesis.keys) keys[key] = text;
  return {{"group", group},
          {"effect", finding.hypothesis.effect->name},
          {"site", finding.hypothesis.site},
          {"body", finding.hypothesis.body},
          {"parameter", finding.hypothesis.trial->amplitude},
          {"amplitude", finding.amplitude},
          {"low", finding.low()},
          {"high", finding.high()},
          {"unit", thermal::unit_of(finding.hypothesis.dimension())},
          {"keys", keys},
          {"weight", finding.weight},
          {"strength", finding.strength}};
}

Json json_of(DetectionLimit const& limit) {
  auto const& hypothesis = limit.hypothesis;
  return {{"effect", hypothesis.effect->name},
          {"site", hypothesis.site},
          {"body", hypothesis.body},
          {"parameter", hypothesis.trial->amplitude},
          {"amplitude", limit.amplitude},
          {"unit", thermal::unit_of(hypothesis.dimension())},
          {"any_size", limit.any_size},
          {"channel", limit.channel},
          {"swing", in_unit(limit.unit, limit.swing)},
          {"swing_unit", limit.unit}};
}

Json json_of(FreeHeat const& heat) {
  Json runs = Json::array();
  for (std::size_t r = 0; r < heat.heat.size(); ++r) {
    Eigen::VectorXd error = heat.standard_error(r);
    for (Eigen::Index k = 0; k < error.size(); ++k) error[k] = whole_error(error[k], heat.heat[r][k]);
    runs.push_back({{"time_s", std::vector<double>(heat.knots[r].begin(), heat.knots[r].end())},
                    {"watts", std::vector<double>(heat.heat[r].begin(), heat.heat[r].end())},
                    {"standard_error", std::vector<double>(error.begin(), error.end())}});
  }
  auto const mean = heat.mean_of_all();
  Json json = {{"body", heat.site.body},
               {"watts", mean.mean},
               {"standard_error", mean.standard_error},
               {"gain", heat.gain},
               {"runs", runs}};
  if (heat.site.is_air()) json["watts_per_kelvin_of_air"] = heat.per_kelvin;
  return json;
}

Json json_of(FoundZero const& zero) {
  return {{"run", zero.run},
          {"channel", zero.channel},
          {"from_s", zero.from},
          {"change", in_unit(zero.unit, zero.change)},
          {"standard_error", in_unit(zero.unit, zero.standard_error)},
          {"unit", zero.unit}};
}

Json json_of(std::vector<ChannelGap> const& gaps) {
  Json list = Json::array();
  for (auto const& gap : gaps) {
    list.push_back({{"run", gap.run},
                    {"channel", gap.channel},
                    {"unit", gap.unit},
                    {"before", in_unit(gap.unit, gap.before)},
                    {"calibrated", in_unit(gap.unit, gap.calibrated)},
                    {"after", in_unit(gap.unit, gap.after)}});
  }
  return list;
}

Json json_of(std::vector<Disagreement> const& cells) {
  Json list = Json::array();
  for (auto const& cell : cells)
    list.push_back({{"run", cell.run},
                    {"channel", cell.channel},
                    {"unit", cell.unit},
                    {"cut", cell.cut},
                    {"part", cell.part},
                    {"mean", in_unit(cell.unit, cell.mean)},
                    {"rms", in_unit(cell.unit, cell.rms)},
                    {"power", cell.power},
                    {"p_value", cell.p_value},
                    {"significant", cell.significant}});
  return list;
}

}  // namespace

std::string report_json(DiagnosisReport const& report) {
  auto const& diagnosis = report.diagnosis;
  Json json = {{"verdict", name_of(diagnosis.verdict)}, {"headline", headline(diagnosis)}, {"effects", Json::array()}};
  for (std::size_t g = 0; g < diagnosis.explanations.size(); ++g)
    for (auto const& finding : diagnosis.explanations[g].alternatives) json["effects"].push_back(json_of(finding, g));
  if (auto const& suspicion = diagnosis.suspicion) {
    json["suspicion"] = {{"asked", suspicion->asked}, {"effects", Json::array()}};
    for (auto const& finding : suspicion->explanation.alternatives)
      json["suspicion"]["effects"].push_back(json_of(finding, 0));
  }
  if (diagnosis.unknown_heat) {
    json["heat"] = json_of(*diagnosis.unknown_heat);
    for (auto const& [name, watts] : diagnosis.unknown_heat_by_speed.mean)
      json["heat"]["by_speed"].push_back(
          {{"part", name}, {"watts", watts.mean}, {"standard_error", watts.standard_error}});
    json["heat"]["swing"] = diagnosis.unknown_heat_by_speed.swing;
  }
  if (diagnosis.verdict == Diagnosis::Verdict::sensor)
    json["sensor"] = {{"name", diagnosis.faulty_sensor  // what no body does is certain
                                   ? diagnosis.faulty_sensor->name
                                   : diagnosis.explanations[0].alternatives[0].hypothesis.body}};
  if (auto const& sensor = diagnosis.faulty_sensor)
    json["faulty_sensor"] = {{"name", sensor->name}, {"what", sensor->what}};
  json["zeros"] = Json::array();
  for (auto const& zero : diagnosis.zeros) json["zeros"].push_back(json_of(zero));
  if (diagnosis.vote) json["held_out_vote"] = *diagnosis.vote;
  json["tried"] = diagnosis.hypotheses.size();
  json["visible"] = diagnosis.visible;
  json["could_hide"] = Json::array();
  for (auto const& limit : diagnosis.could_hide) json["could_hide"].push_back(json_of(limit));
  for (auto const& [channel, times] : diagnosis.noise_heard) json["noise_heard"][channel] = times;
  json["where"] = Json::array();
  for (auto const& [body, regime] : diagnosis.where) json["where"].push_back({{"body", body}, {"regime", regime}});
  auto const gap = whole(report.held_out.empty() ? report.fitted : report.held_out);
  json["gap"] = {{"before", gap.before}, {"after", gap.after}};
  json["gaps"] = {{"fitted", json_of(report.fitted)}, {"held_out", json_of(report.held_out)}};
  json["disagreement"] = {{"before", json_of(diagnosis.disagreement)},
                          {"after", json_of(diagnosis.disagreement_left)},
                          {"held_out", json_of(diagnosis.disagreement_held_out)}};
  json["unaccounted_heat"] = Json::array();
  for (std::size_t i = 0; i < std::min<std::size_t>(3, diagnosis.scan.size()); ++i)
    json["unaccounted_heat"].push_back(json_of(diagnosis.scan[i]));
  json["heat_left"] = Json::array();
  for (std::size_t i = 0; i < std::min<std::size_t>(3, diagnosis.left.size()); ++i)
    json["heat_left"].push_back(json_of(diagnosis.left[i]));
  if (auto const* proposal = proposal_of(diagnosis)) {
    json["experiment"] = proposal->file.string();
    json["experiment_distance"] = proposal->distance;
    json["experiment_wanted_distance"] = wanted_distance;
    json["experiment_hours"] = proposal->hours;
  }
  json["proposals"] = Json::array();
  for (auto const& proposal : diagnosis.proposals) json["proposals"].push_back(json_of(proposal));
  json["estimates"] = Json::array();
  for (std::size_t u = 0; u < diagnosis.unknowns.size(); ++u) {
    auto const i = Eigen::Index(u);
    json["estimates"].push_back({{"name", diagnosis.unknowns[u].name},
                                 {"estimate", diagnosis.amended.x[i]},
                                 {"standard_error", std::sqrt(diagnosis.amended.covariance(i, i))},
                                 {"prior", diagnosis.unknowns[u].deviation}});
  }
  json["cautions"] = cautions(diagnosis);
  json["doubts"] = doubts_json(report.doubts);
  json["remarks"] = report.remarks;
  return output::json_text(std::move(json));
}

}  // namespace thermotwin::twin
