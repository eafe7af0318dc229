#pragma once

#include <Eigen/Core>
#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "models/selection.h"
#include "twin/study/figure.h"
#include "twin/study/study_file.h"

namespace thermotwin::twin {

/// A row of the table.
struct Combination {
  std::string world, selection, model;
  Figures figures;                   ///< judgement.h, and "improvement" [%] over the reference
  std::vector<std::string> sensors;  ///< chosen in the first repetition for the first training set
  std::string refused;               ///< why there are no figures
  std::string remark;                ///< what the fit of the first repetition found out
  Eigen::MatrixXd deviations{};      ///< models of single runs × runs, as in paper 004, in the first repetition [µm]

  [[nodiscard]] std::string name() const { return combination_name(selection, model); }
};

/// What a selection is worth, whatever the model.
struct SelectionFigures {
  std::string world, selection;
  Figures figures;  ///< regret, informative, found, rank_correlation, switches, count; none where it was refused once
  std::string remark;
  std::vector<models::Evidence> evidence{};  ///< in the first repetition, for the first training set
};

/// A claim, and what the figures say of it: the two figures and their difference, or the figure.
struct ClaimVerdict {
  StudyClaim claim;
  std::string world;  ///< that it was judged in
  enum class Answer { holds, fails, undecided, refused } answer = Answer::refused;
  std::string words;
};

/// What a study made for its combinations, which share it.
struct StudyWork {
  std::size_t runs = 0;         ///< simulated or read
  std::size_t selections = 0;   ///< each for one training set
  std::size_t clusterings = 0;  ///< and screens, which selections share
  std::size_t twins = 0;        ///< calibrated
  std::size_t fits = 0;         ///< of models, each for one set of sensors and one training set
};

/// Everything a study found.
struct StudyReport {
  StudyDescription description;
  std::vector<std::string> units;  ///< of the errors, per world
  std::vector<int> repetitions;    ///< per world
  std::vector<Combination> rows;   ///< world by world, in the order of named_combinations()
  std::vector<Combination> means;  ///< over the worlds, where there are several: self.rmse, cross.rmse, validation.rmse
  std::vector<SelectionFigures> selections;
  std::vector<ClaimVerdict> claims;
  std::vector<std::string> verdict;  ///< sentences
  std::vector<std::string> remarks;  ///< with the worlds: sensors left out, what measured runs lack
  StudyWork work{};
};

/// Of a combination, and "selection." of what its selection is worth.
[[nodiscard]] Figures figures_of(StudyReport const& report, Combination const& row);

struct StudyOptions {
  std::function<void(std::string const&, double)> progress;  ///< what is being done, and the share done
  std::atomic<bool> const* stop = nullptr;
};

/// Every data set once, every selection once per training set (screens and clusters once for all selections that share
/// them; what does not look at the error once for all errors), every model once per set of sensors and training set;
/// all of it in parallel, the same bytes whatever the threads.
[[nodiscard]] StudyReport run_study(Study const& study, StudyOptions const& options = {});

}  // namespace thermotwin::twin
