#pragma once

#include <map>
#include <string>
#include <vector>

#include "models/error_model.h"
#include "twin/study/question.h"

namespace thermotwin::twin {

/// A model fitted for a question, or why it was not.
struct FittedModel {
  models::ErrorModel model;
  std::string refused;                      ///< empty if it was fitted
  std::vector<Eigen::VectorXd> observed{};  ///< by an observer, of each run that is asked about: the model adds nothing
};

/// The model that adds nothing to what the twin says, called twin_alone: every reading counts nothing.
[[nodiscard]] models::ErrorModel nothing_more(std::vector<std::string> const& sensors);

/// On the question's sensors `columns` (of the world's, ascending). The twin alone adds nothing to what it says.
[[nodiscard]] FittedModel fit_model(NamedModel const& named, Question const& question,
                                    std::vector<Eigen::Index> const& columns, std::uint64_t seed);

/// The mean of what models predict. Questions may differ only in what a twin has answered before.
struct Answer {
  struct Part {
    Question const* question;
    models::ErrorModel const* model;
    std::vector<Eigen::VectorXd> const* observed = nullptr;  ///< in place of what the question's twin says
  };
  std::vector<Part> parts;  ///< at least one

  [[nodiscard]] std::vector<Asked> const& asked() const { return parts.front().question->asked; }
  /// Of the k-th stretch that is asked for: the whole run.
  [[nodiscard]] Eigen::VectorXd predict(std::size_t k) const;
  /// The first instants that one of them does not claim.
  [[nodiscard]] int unclaimed_instants() const;
  /// Whether a twin has a part in it, whose numbers `parameters` does not count.
  [[nodiscard]] bool has_twin() const;
  /// Effective ones: the trace of a mean of smoothers is the mean of theirs.
  [[nodiscard]] double parameters() const;
};

/// Figures of one combination in one repetition, by name; none of the answers may be refused.
///
///   self.*, cross.*                 rmse, mae, max [µm], r_squared [1], mape [%] of the pooled predictions against the
///                                   true errors (metrics.h), but for the first `unclaimed` instants of each run, the
///                                   same for all that are compared (ErrorModel::unclaimed_instants)
///   validation.*                    the same against the measured errors: whoever chooses by them has no others
///   S, Mn, Sd                       batch_statistics.h, mean over the models, against the measured errors as in paper
///                                   004, but for what the model itself does not claim; of a single model, S over the
///                                   training runs, Mn and Sd over the test runs. No S where a twin has a part in it
///   Mn.least, Mn.most, Sd.least …   over the models, where each is of one run
///   verification.Mn, .Sd            over the test runs, where models are of single runs
struct Judgement {
  std::map<std::string, double> figures;
  Eigen::MatrixXd deviations;  ///< where models are of single runs: each of all runs (models::deviation_matrix) [µm]
};
[[nodiscard]] Judgement judged(std::vector<Answer> const& fits, std::vector<Answer> const& validations,
                               std::size_t train_runs, int unclaimed);

/// rmse, mae, max over the judged positions of a laser at the world's instants: "feed_8000 at 60 min.rmse". The zero
/// position is fitted to what the laser showed in the training runs; judged is against the true errors.
[[nodiscard]] std::map<std::string, double> judged_instants(StudyWorld const& world, WorldData const& data,
                                                            int repetition, models::ErrorModel const& slope);

}  // namespace thermotwin::twin
