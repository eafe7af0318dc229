#include "twin/study/studied_world.h"

#include <algorithm>
#include <fmt/format.h>

namespace thermotwin::twin {
namespace {

/// What of a machine and its runs selections get to see that do not look at the error, but for the readings themselves.
bool read_alike(StudyWorld const& a, StudyWorld const& b) {
  return a.machine == b.machine && a.added == b.added && a.changes == b.changes && a.sampling == b.sampling;
}

Repetition asked_in(StudiedWorld const& world, int number, StudyDescription const& study,
                    Combinations const& combinations) {
  auto asked = questions(world.description, world.data, number, study.folds);
  Repetition repetition{number, std::move(asked.remarks), {}, asked.fits.size()};
  for (auto* list : {&asked.fits, &asked.validations})
    for (auto& question : *list) {
      auto& trial = repetition.trials.emplace_back(StudyTrial{std::move(question)});
      trial.choices.resize(combinations.selections.size());
      trial.fits.resize(combinations.models.size());
    }
  return repetition;
}

/// In the same repetition of the worlds before.
void find_alike(std::vector<StudiedWorld> const& before, StudiedWorld const& world, int number, StudyTrial& trial) {
  for (auto const& other : before) {
    if (number >= int(other.repetitions.size()) || !read_alike(other.description, world.description) ||
        other.data.sensors != world.data.sensors)
      continue;
    bool const same_error = other.description.error == world.description.error;
    for (auto const& first : other.repetitions[std::size_t(number)].trials) {
      if (!trial.read_alike && read_alike(first.question, trial.question))
        trial.read_alike = first.read_alike ? first.read_alike : &first;
      if (!trial.trained_alike && same_error && trained_alike(first.question, trial.question))
        trial.trained_alike = first.trained_alike ? first.trained_alike : &first;
    }
  }
}

}  // namespace

std::string StudiedWorld::in_some(std::string const& what, std::size_t of_repetitions) const {
  auto const all = repetitions.size();
  return of_repetitions == all ? what : fmt::format("in {} of {} repetitions, {}", of_repetitions, all, what);
}

int StudiedWorld::unclaimed_instants() const {
  int most = 0;
  for (auto const& repetition : repetitions)
    for (auto const& trial : repetition.trials)
      for (auto const& of_model : trial.fits)
        for (auto const& [columns, fit] : of_model)
          if (fit.refused.empty()) most = std::max(most, fit.model.unclaimed_instants());
  return most;
}

std::vector<StudiedWorld> studied_worlds(StudyDescription const& study, std::vector<WorldData> data,
                                         Combinations const& combinations) {
  std::vector<StudiedWorld> worlds;
  worlds.reserve(data.size());
  for (std::size_t w = 0; w < data.size(); ++w) {
    StudiedWorld world{study.worlds[w], std::move(data[w])};
    try {
      for (int r = 0; r < world.data.repetitions(); ++r) {
        world.repetitions.push_back(asked_in(world, r, study, combinations));
        for (auto& trial : world.repetitions.back().trials) find_alike(worlds, world, r, trial);
      }
    } catch (thermal::InputError const& error) {
      throw about(study.worlds[w], error.what());
    }
    worlds.push_back(std::move(world));
  }
  return worlds;
}

}  // namespace thermotwin::twin
