#include "twin/study/study_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "output/csv.h"
#include "output/json_text.h"

namespace thermotwin::twin {
namespace {

using Json = nlohmann::ordered_json;

/// A column of the terminal's table.
struct Column {
  std::string_view title, figure;
  int width, decimals;
  bool with_interval;
};

constexpr auto columns = std::to_array<Column>({
    {"self RMSE", "self.rmse", 9, 2, false},
    {"cross RMSE", "cross.rmse", 15, 2, true},
    {"MAE", "cross.mae", 7, 2, false},
    {"max", "cross.max", 7, 2, false},
    {"R2", "cross.r_squared", 6, 3, false},
    {"MAPE %", "cross.mape", 6, 1, false},
    {"better %", "improvement", 8, 1, false},
    {"valid.", "validation.rmse", 7, 2, false},
    {"S", "S", 6, 2, false},
    {"Mn", "Mn", 14, 2, true},
    {"Sd", "Sd", 14, 2, true},
    {"verif. Mn", "verification.Mn", 9, 2, false},
    {"Sd", "verification.Sd", 6, 2, false},
});

constexpr auto selection_columns = std::to_array<Column>({
    {"sensors", "count", 8, 1, false},
    {"regret", "regret", 14, 2, true},
    {"informative", "informative", 11, 1, false},
    {"found", "found", 6, 1, false},
    {"rank corr.", "rank_correlation", 14, 2, true},
    {"switches", "switches", 8, 2, false},
});

/// Padded by what is seen, not by bytes: "±" is two.
std::string right(std::string const& text, int width) {
  auto const seen = std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; });
  return std::string(std::size_t(std::max<std::ptrdiff_t>(0, width - seen)), ' ') + text;
}

std::string cell(Figures const& figures, Column const& column) {
  auto of = interval(values_of(figures, std::string(column.figure)));
  if (!column.with_interval) of.values = std::min(of.values, 1);
  return "  " + right(text_of(of, column.decimals), column.width);
}

template <class Columns, class Rows>
std::vector<Column> used(Columns const& all, Rows const& rows) {
  std::vector<Column> result;
  for (auto const& column : all)
    if (std::any_of(rows.begin(), rows.end(),
                    [&](auto const* row) { return row->figures.contains(std::string(column.figure)); }))
      result.push_back(column);
  return result;
}

std::string head(std::string_view first, std::size_t width, std::vector<Column> const& shown) {
  std::string line = fmt::format("  {:<{}}", first, width);
  for (auto const& column : shown) line += fmt::format("  {:>{}}", column.title, column.width);
  return line + "\n";
}

template <class Row>
std::vector<Row const*> of_world(std::vector<Row> const& rows, std::string const& world) {
  std::vector<Row const*> result;
  for (auto const& row : rows)
    if (row.world == world) result.push_back(&row);
  return result;
}

double rank_of(Combination const& row, std::string const& figure) {
  double const mean = interval(values_of(row.figures, figure)).mean;
  return std::isfinite(mean) ? mean : INFINITY;
}

constexpr std::size_t room_for_chosen = 40;

/// Sensors of the best combination with a selection; empty where its name says which, or there is no room for them.
std::string chosen_text(StudyReport const& report, SelectionFigures const& selection) {
  if (selection.selection == "all" || selection.selection.starts_with("sensors ")) return {};
  Combination const* best = nullptr;
  for (auto const& row : report.rows)
    if (row.world == selection.world && row.selection == selection.selection && !row.sensors.empty() &&
        row.refused.empty() && (!best || rank_of(row, "cross.rmse") < rank_of(*best, "cross.rmse")))
      best = &row;
  if (!best) return {};
  auto const text = fmt::format("{}", fmt::join(best->sensors, " "));
  return text.size() > room_for_chosen ? "" : text;
}

bool names_chosen(StudyReport const& report) {
  return std::any_of(report.selections.begin(), report.selections.end(),
                     [&](auto const& row) { return !chosen_text(report, row).empty(); });
}

std::string selection_table(StudyReport const& report, std::string const& world) {
  auto const rows = of_world(report.selections, world);
  auto const shown = used(selection_columns, rows);
  std::size_t width = 9;
  for (auto const* row : rows) width = std::max(width, row->selection.size());
  std::string text = head("selection", width, shown);
  for (auto const* row : rows) {
    text += fmt::format("  {:<{}}", row->selection, width);
    for (auto const& column : shown) text += cell(row->figures, column);
    auto const chosen = chosen_text(report, *row);
    text += (chosen.empty() ? "" : "  chosen: " + chosen) + (row->remark.empty() ? "" : "  " + row->remark) + "\n";
  }
  return text;
}

/// Best first.
void sort_by(std::string const& figure, std::vector<Combination const*>& rows) {
  std::stable_sort(rows.begin(), rows.end(),
                   [&](auto const* a, auto const* b) { return rank_of(*a, figure) < rank_of(*b, figure); });
}

std::string combination_table(std::vector<Combination const*> rows) {
  sort_by("cross.rmse", rows);
  auto const shown = used(columns, rows);
  std::size_t width = 9;
  for (auto const* row : rows) width = std::max(width, row->name().size());
  std::string text = head("selection + model", width, shown);
  for (auto const* row : rows) {
    text += fmt::format("  {:<{}}", row->name(), width);
    if (!row->refused.empty()) {
      text += "  refused: " + row->refused + "\n";
      continue;
    }
    for (auto const& column : shown) text += cell(row->figures, column);
    text += (row->remark.empty() ? "" : "  " + row->remark) + "\n";
  }
  return text;
}

/// The error over the axis at one instant, of those combinations that say it.
std::string instant_table(std::vector<Combination const*> rows, std::string const& name) {
  auto const rmse = name + ".rmse", mae = name + ".mae", most = name + ".max";
  std::vector<Column> const shown = {
      {"RMSE", rmse, 15, 2, true}, {"MAE", mae, 15, 2, true}, {"max", most, 15, 2, true}};
  std::erase_if(rows, [&](auto const* row) { return !row->figures.contains(rmse); });
  if (rows.empty()) return {};
  sort_by(rmse, rows);
  std::size_t width = name.size();
  for (auto const* row : rows) width = std::max(width, row->name().size());
  std::string text = "\n" + head(name, width, shown);
  for (auto const* row : rows) {
    text += fmt::format("  {:<{}}", row->name(), width);
    for (auto const& column : shown) text += cell(row->figures, column);
    text += "\n";
  }
  return text;
}

std::string_view name_of(ClaimVerdict::Answer answer) {
  switch (answer) {
    case ClaimVerdict::Answer::holds:
      return "holds";
    case ClaimVerdict::Answer::fails:
      return "does not hold";
    case ClaimVerdict::Answer::undecided:
      return "undecided";
    case ClaimVerdict::Answer::refused:
      break;
  }
  return "cannot be judged";
}

/// "12 runs, 34 selections with 6 screens and clusterings, 56 fits, each made once".
std::string words_of(StudyWork const& work) {
  auto const counted = [](std::size_t count, std::string const& what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
  };
  std::string text = counted(work.runs, "run") + ", " + counted(work.selections, "selection");
  if (work.clusterings > 0) text += fmt::format(" with {} screens and clusterings", work.clusterings);
  if (work.twins > 0) text += ", " + counted(work.twins, "calibrated twin");
  return text + ", " + counted(work.fits, "fit") + ", each made once";
}

/// Of the intervals, of "better %" and of what was chosen, where the tables have them.
std::string legend(StudyReport const& report) {
  std::vector<std::string> words;
  if (std::any_of(report.repetitions.begin(), report.repetitions.end(), [](int count) { return count > 1; }))
    words.push_back("intervals: 95 % over the seeds");
  if (std::any_of(report.rows.begin(), report.rows.end(),
                  [](auto const& row) { return row.figures.contains("improvement"); }))
    words.push_back(fmt::format("better: {} of cross-prediction against {}", report.description.metric,
                                report.description.reference));
  if (names_chosen(report)) words.emplace_back("chosen: for the first training set, with the first seed");
  return words.empty() ? "" : fmt::format("{}\n", fmt::join(words, "; "));
}

std::string number(double x) { return std::isfinite(x) ? fmt::format("{:.9g}", x) : ""; }

Json json_of(Figures const& figures) {
  Json json = Json::object();
  for (auto const& [name, values] : figures) {
    auto const of = interval(values);
    json[name] = {{"mean", of.mean}, {"half_width_95", of.half}, {"values", values}};
  }
  return json;
}

Json json_of(std::vector<models::Evidence> const& evidence) {
  Json json = Json::array();
  for (auto const& one : evidence) {
    Json figures = {{"of", one.of}};
    for (auto const& [name, value] : one.figures) figures[name] = value;
    json.push_back(figures);
  }
  return json;
}

Json json_of(Eigen::MatrixXd const& matrix) {
  Json json = Json::array();
  for (auto const& row : matrix.rowwise()) json.push_back(std::vector<double>(row.begin(), row.end()));
  return json;
}

Json json_of(Combination const& row) {
  Json json = {{"world", row.world},
               {"selection", row.selection},
               {"model", row.model},
               {"sensors", row.sensors},
               {"refused", row.refused.empty() ? Json() : Json(row.refused)},
               {"remark", row.remark},
               {"figures", json_of(row.figures)}};
  if (row.deviations.size() > 0) json["deviations"] = json_of(row.deviations);
  return json;
}

}  // namespace

std::string study_text(StudyReport const& report) {
  std::string text = report.description.title + "\n";
  for (std::size_t w = 0; w < report.units.size(); ++w) {
    auto const& world = report.description.worlds[w];
    text += fmt::format("\n{}: {}{} [{}], {} run{} to train on{}, {} to test on, {}\n\n", world.name, world.error,
                        world.machine.empty() ? "" : " of " + world.machine, report.units[w], world.train.size(),
                        world.train.size() == 1 ? "" : "s", world.fit == "each" ? ", one model each" : "",
                        world.split ? 1 : world.test.size(),
                        report.repetitions[w] == 1 ? "measured once" : fmt::format("{} seeds", report.repetitions[w]));
    auto const rows = of_world(report.rows, world.name);
    text += selection_table(report, world.name) + "\n" + combination_table(rows);
    for (auto const& instant : world.instants) text += instant_table(rows, instant.name());
  }
  if (!report.means.empty())
    text += "\nmean of worlds\n\n" + combination_table(of_world(report.means, std::string(mean_of_worlds)));
  text += "\n" + legend(report) + words_of(report.work) + "\n";
  for (auto const& remark : report.remarks) text += remark + "\n";
  text += "\nverdict\n";
  for (auto const& sentence : report.verdict) text += "  " + sentence + "\n";
  for (auto const& claim : report.claims)
    text += fmt::format("  {}: \"{}\" {}: {}\n", claim.world, claim.claim.says, name_of(claim.answer), claim.words);
  return text;
}

std::string study_csv(StudyReport const& report) {
  std::set<std::string> names;
  std::vector<Combination> rows = report.rows;
  rows.insert(rows.end(), report.means.begin(), report.means.end());
  for (auto& row : rows) row.figures = figures_of(report, row);
  for (auto const& row : rows)
    for (auto const& [name, values] : row.figures) names.insert(name);
  std::string text = "world,selection,model,refused,sensors,remark";
  for (auto const& name : names) text += "," + output::csv_field(name) + "," + output::csv_field(name + " +-");
  text += "\n";
  for (auto const& row : rows) {
    std::vector<std::string> fields = {
        row.world, row.selection, row.model, row.refused, fmt::format("{}", fmt::join(row.sensors, " ")), row.remark};
    for (auto& field : fields) field = output::csv_field(field);
    text += fmt::format("{}", fmt::join(fields, ","));
    for (auto const& name : names) {
      auto const of = interval(values_of(row.figures, name));
      text += fmt::format(",{},{}", number(of.mean), of.values > 1 ? number(of.half) : "");
    }
    text += "\n";
  }
  return text;
}

std::string study_json(StudyReport const& report) {
  Json json = {{"title", report.description.title}, {"verdict", report.verdict}};
  json["claims"] = Json::array();
  for (auto const& claim : report.claims)
    json["claims"].push_back({{"says", claim.claim.says},
                              {"world", claim.world},
                              {"answer", name_of(claim.answer)},
                              {"words", claim.words}});
  json["remarks"] = report.remarks;
  json["work"] = {{"runs", report.work.runs},
                  {"selections", report.work.selections},
                  {"clusterings", report.work.clusterings},
                  {"twins", report.work.twins},
                  {"fits", report.work.fits}};
  json["worlds"] = Json::array();
  for (std::size_t w = 0; w < report.units.size(); ++w)
    json["worlds"].push_back({{"name", report.description.worlds[w].name},
                              {"machine", report.description.worlds[w].machine},
                              {"error", report.description.worlds[w].error},
                              {"unit", report.units[w]},
                              {"train", report.description.worlds[w].train},
                              {"test", report.description.worlds[w].test},
                              {"repetitions", report.repetitions[w]}});
  json["selections"] = Json::array();
  for (auto const& row : report.selections)
    json["selections"].push_back({{"world", row.world},
                                  {"selection", row.selection},
                                  {"remark", row.remark},
                                  {"figures", json_of(row.figures)},
                                  {"evidence", json_of(row.evidence)}});
  json["combinations"] = Json::array();
  for (auto const* rows : {&report.rows, &report.means})
    for (auto const& row : *rows) json["combinations"].push_back(json_of(row));
  return output::json_text(std::move(json));
}

}  // namespace thermotwin::twin
