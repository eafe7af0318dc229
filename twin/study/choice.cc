#include "twin/study/choice.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>

namespace thermotwin::twin {
namespace {

using Eigen::Index;

models::Selection every_sensor(Index count) {
  models::Selection all{std::vector<Index>(std::size_t(count)), Eigen::VectorXd::Zero(count), ""};
  std::iota(all.sensors.begin(), all.sensors.end(), Index{0});
  return all;
}

/// Those of that name, all as good as each other. std::invalid_argument for one that models do not get to see.
models::Selection given_sensors(std::vector<std::string> const& names, Question const& question,
                                WorldData const& data) {
  std::vector<std::string> known;
  for (auto const column : question.columns) known.push_back(data.sensors[std::size_t(column)]);
  models::Selection given{{}, Eigen::VectorXd::Zero(Index(known.size())), ""};
  for (auto const& name : names) {
    auto const place = std::find(known.begin(), known.end(), name);
    if (place == known.end())
      throw std::invalid_argument(
          fmt::format("there is no sensor '{}' here, or it is left out; known: {}", name, fmt::join(known, ", ")));
    given.sensors.push_back(place - known.begin());
  }
  return given;
}

models::Selection selected(NamedSelection const& method, Question const& question, WorldData const& data,
                           ModeShapes const& modes, models::SelectionOptions options) {
  auto const moving = Index(question.columns.size());
  if (method.name == "all") return every_sensor(moving);
  if (!method.sensors.empty()) return given_sensors(method.sensors, question, data);
  options.count = method.count;
  if (method.name == modes_method) {
    if (!modes.refused.empty()) throw std::invalid_argument(modes.refused);
    options.mode_shapes = modes.sensors(question.columns, Eigen::all);
  }
  return models::selection_method(method.name).select(question.training, options);
}

}  // namespace

models::SelectionOptions selection_options(StudyScreening const& screening) {
  using models::BiasCorrection, models::BinCount, models::BinEdges, models::Normalisation;
  static std::map<std::string, BinCount> const counts = {{"cellucci", BinCount::cellucci},
                                                         {"sturges", BinCount::sturges},
                                                         {"square_root", BinCount::square_root},
                                                         {"freedman_diaconis", BinCount::freedman_diaconis}};
  static std::map<std::string, BiasCorrection> const biases = {{"shuffle_null", BiasCorrection::shuffle_null},
                                                               {"miller_madow", BiasCorrection::miller_madow},
                                                               {"none", BiasCorrection::none}};
  static std::map<std::string, Normalisation> const normalisations = {{"across_sensors", Normalisation::across_sensors},
                                                                      {"over_time", Normalisation::over_time},
                                                                      {"z_score", Normalisation::z_score}};
  models::SelectionOptions options;
  options.normalisation = normalisations.at(screening.normalisation);
  options.resolution = screening.resolution;
  options.information.count = counts.at(screening.bins);
  options.information.bias = biases.at(screening.bias);
  options.information.edges = screening.edges == "equal_width" ? BinEdges::equal_width : BinEdges::equal_frequency;
  options.information.permutations = screening.permutations;
  return options;
}

bool sees_error(NamedSelection const& method) {
  return method.name != "all" && method.sensors.empty() && models::selection_method(method.name).sees_error;
}

Choice choose(NamedSelection const& method, Question const& question, WorldData const& data, ModeShapes const& modes,
              models::SelectionOptions options) {
  Choice choice;
  try {
    auto const found = selected(method, question, data, modes, std::move(options));
    choice.selection.remark = found.remark;
    choice.selection.evidence = found.evidence;
    choice.selection.score = Eigen::VectorXd::Zero(Index(data.sensors.size()));
    for (std::size_t j = 0; j < question.columns.size(); ++j)
      choice.selection.score[question.columns[j]] = found.score[Index(j)];
    for (auto const sensor : found.sensors) choice.selection.sensors.push_back(question.columns[std::size_t(sensor)]);
    choice.columns = choice.selection.sensors;
    std::sort(choice.columns.begin(), choice.columns.end());
    if (choice.columns.empty()) choice.refused = "no sensor chosen";
  } catch (std::invalid_argument const& error) {
    choice.refused = error.what();
  }
  return choice;
}

SelectionTruth::SelectionTruth(WorldData const& data) {
  if (Index(data.sensors.size()) > models::largest_exhaustive) return;
  std::vector<models::Batch> runs;
  for (auto const* list : {&data.train.front(), &data.test.front()})
    for (auto const& run : *list) runs.push_back(run.truth ? *run.truth : run.seen);
  validation_ = std::make_unique<models::SubsetValidation>(runs);
}

void SelectionTruth::prepare(int count) {
  if (!validation_ || best_.contains(count) || count < 1 || count > validation_->sensors() ||
      count > validation_->largest_set())
    return;
  best_.emplace(count, models::best_subset(*validation_, count));
}

std::optional<ChoiceQuality> SelectionTruth::quality(Choice const& choice) const {
  auto const best = best_.find(int(choice.columns.size()));
  if (best == best_.end()) return std::nullopt;
  auto const& margin = best->second.margin;
  return ChoiceQuality{models::regret(choice.selection, *validation_, best->second),
                       models::score(choice.selection, margin.array() - margin.minCoeff())};
}

}  // namespace thermotwin::twin
