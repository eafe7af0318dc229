#include "twin/diagnosis/seen_form.h"

#include <cmath>
#include <fmt/format.h>
#include <string>

#include "thermal/units.h"
#include "twin/file/document.h"

namespace thermotwin::twin {
namespace {

std::vector<double> amounts(Estimation const& estimation, Unknown::Kind kind, std::size_t count,
                            std::vector<std::size_t> const& unknowns, Eigen::VectorXd const& x) {
  std::vector<double> result(count, 0.0);
  for (std::size_t const u : unknowns)
    if (auto const& unknown = estimation.unknowns()[u]; unknown.kind == kind)
      result[unknown.index] = x[Eigen::Index(u)];
  return result;
}

std::string list_text(std::vector<std::string> const& texts) {
  return fmt::format("[\"{}\"]", fmt::join(texts, "\", \""));
}

std::string list_text(std::vector<double> const& numbers) {
  std::vector<std::string> texts;
  for (double const number : numbers) texts.push_back(thermal::format_number(std::round(1e4 * number) / 1e4));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

}  // namespace

SeenForm::SeenForm(Estimation const& estimation, std::vector<std::size_t> const& unknowns, Eigen::VectorXd const& x) {
  auto const of = [&](Unknown::Kind kind, std::size_t count) { return amounts(estimation, kind, count, unknowns, x); };
  auto const& places = estimation.places();
  auto const& gaps = estimation.gaps();
  sensors_ = placed_sensors(estimation.document(), places, of(Unknown::Kind::place, places.size()));
  loops_ = loops_beyond(estimation.document(), gaps, of(Unknown::Kind::loop, gaps.size()));
}

void SeenForm::put_into(Value& document) const {
  for (auto* table : tables_of(document, "temperature_sensor"))
    for (auto const& sensor : sensors_)
      if (name_in(*table) == sensor.name) put(*table, sensor);
  for (auto const& [channel, text] : loops_) {
    Value const beyond = parse_toml("beyond = " + text, document.where.file);
    auto const [table, key] = find_parameter(document, channel + ".beyond");
    set_key(*table, key, std::get<Value::List>(beyond.find("beyond")->content));
  }
}

std::vector<ChangedValue> SeenForm::changes() const {
  std::vector<ChangedValue> changes;
  for (auto const& [name, at, shares] : sensors_) {
    std::string const path = "temperature_sensor." + name;
    changes.push_back({path + ".at", at.size() == 1 ? at[0] : list_text(at), "as the data show it"});
    if (!shares.empty()) changes.push_back({path + ".shares", list_text(shares), "of each place"});
  }
  for (auto const& [channel, text] : loops_) changes.push_back({channel + ".beyond", text, "as the data show it"});
  return changes;
}

std::vector<std::size_t> seen_of_form(Estimation const& estimation, Fit const& fit) {
  std::vector<std::size_t> seen;
  for (std::size_t u = 0; u < estimation.unknowns().size(); ++u) {
    auto const kind = estimation.unknowns()[u].kind;
    auto const i = Eigen::Index(u);
    if (kind == Unknown::Kind::place && !estimation.places()[estimation.unknowns()[u].index].can_be_written) continue;
    bool const of_form = kind == Unknown::Kind::place || kind == Unknown::Kind::loop;
    bool const open = kind == Unknown::Kind::loop && estimation.has_open_loops();
    if (of_form && (open || std::abs(fit.x[i]) > std::sqrt(fit.covariance(i, i)))) seen.push_back(u);
  }
  return seen;
}

}  // namespace thermotwin::twin
