#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "twin/diagnosis/detection_limit.h"
#include "twin/diagnosis/estimation.h"
#include "twin/diagnosis/finding.h"
#include "twin/diagnosis/score.h"
#include "twin/diagnosis/zero_search.h"

namespace thermotwin::twin {

struct DiagnosisOptions {
  std::vector<std::string> without;  ///< effects that are not tried
  /// 2 ln of the evidence that an effect must have, times the fourth power of the Birge ratio of the fit that has it,
  /// at most four; heat of free course needs as much beside effects (and a tenth of what the strongest on heat has),
  /// and more alone. See docs/diagnosis_record.md for how often chance alone reaches it.
  double threshold = 11.0;
  /// What a further effect must have of the strongest one's evidence: what is left of an effect whose shape is not
  /// quite right looks like others.
  double least_share = 0.02;
  /// Seed of the numbers and lags that the first fit starts from, drawn from their priors; none: from their means.
  /// What is found must not depend on it.
  std::optional<std::uint64_t> start;
  std::function<void(std::string const&)> progress;
  FitWatch watch{};  ///< of all fits
};

/// What comes nearest where no effect is evident.
struct Suspicion {
  Explanation explanation;
  double asked = 0.0;  ///< what it would need to be evident [2 ln]
};

/// Which effects a machine lacks, beside all its uncertain numbers: forward selection by evidence, with a backward
/// check and an exchange of each for what could stand in its place (physics.md 8.5, 8.6).
class EffectSearch {
 public:
  /// Calibrates, and hears the noise that the calibrated machine leaves. `hypotheses`: all that are tried, those of
  /// some size, too. `start`: which of those of start.h; instead of the first, what the options ask for. `runs` must
  /// outlive this.
  EffectSearch(Value const& document, std::vector<BinnedRun> const& runs, std::vector<Hypothesis> hypotheses,
               DiagnosisOptions const& options, std::size_t start = 0);

  /// Tries the hypotheses, beside the effects found so far.
  void operator()();
  /// Takes an effect that was found back, and tries it no more, wherever it stands in `explanations`.
  void reject(std::size_t effect);

  /// Of the machine without any effect, with the noise heard first.
  [[nodiscard]] Estimation const& plain() const { return plain_.value(); }
  [[nodiscard]] Fit const& calibrated() const { return calibrated_; }
  /// Before any was heard.
  [[nodiscard]] std::vector<ChannelNoise> const& expected_noise() const { return expected_; }
  /// With the effects found; the fit has the best alternative of each explanation.
  [[nodiscard]] Estimation const& estimation() const { return estimation_.value(); }
  [[nodiscard]] Fit const& fit() const { return fit_; }
  /// Amplitudes as they were when each was found.
  [[nodiscard]] std::vector<Explanation> const& explanations() const { return explanations_; }
  /// −2 ln of the evidence for the machine with the effects found, whatever noise was heard.
  [[nodiscard]] double misfit() const;
  /// Where none was found: what has half of the evidence that it would need, or more.
  [[nodiscard]] std::optional<Suspicion> const& suspicion() const { return suspicion_; }
  /// What heat of free course must have to be evident, beside the effects found if there are any [2 ln].
  [[nodiscard]] double evident_beside() const;
  /// How much more model error than expected was heard in each channel; 1: no more.
  [[nodiscard]] std::vector<std::pair<std::string, double>> noise_heard() const;
  /// How many hypotheses would be seen at half of their largest amplitude, as far as `--plan` wants it.
  [[nodiscard]] std::size_t visible() const { return visible_; }
  /// Of all that was not found, beside what was; what moves the tool most first.
  [[nodiscard]] std::vector<DetectionLimit> detection_limits() const;

 private:
  struct Refit;

  void search();
  bool acquit_sensor();
  void say(std::string const& what) const {
    if (options_.progress) options_.progress(what);
  }
  /// What a further effect needs of the strongest one's evidence.
  [[nodiscard]] double share_of_strongest() const;
  [[nodiscard]] double strictness_of_name() const;
  [[nodiscard]] double asked_of_name() const;
  [[nodiscard]] bool add_effect(int round);
  [[nodiscard]] Eigen::Index place_of(std::size_t effect) const;
  struct Candidates;
  [[nodiscard]] Candidates candidates(std::optional<std::size_t> in_place_of = std::nullopt) const;
  [[nodiscard]] std::vector<Refit> refits(Fit const& about, std::vector<std::size_t> const& chosen,
                                          Candidates const& candidates, std::vector<Score> const& scores) const;
  [[nodiscard]] std::vector<std::size_t> most_promising(Candidates const& candidates, std::vector<Score> const& scores,
                                                        double threshold) const;
  [[nodiscard]] std::vector<Refit> instead_of(std::size_t effect, double strength,
                                              std::set<std::string> const& rivals) const;
  [[nodiscard]] bool explains_away(Hypothesis const& effect, Eigen::MatrixXd const& signature) const;
  [[nodiscard]] std::vector<Refit> refits_in_place_of(std::size_t effect, double strength,
                                                      std::vector<std::size_t> const& chosen,
                                                      std::vector<Hypothesis> const& tried,
                                                      std::vector<Score> const& scores) const;
  void linearise();
  [[nodiscard]] Explanation explanation_of(std::vector<Refit> const& refits) const;
  bool free_zeros();
  void open_loops();
  void open_laws();
  [[nodiscard]] Fitted fitted(Estimation const& other) const;
  bool open(Fitted other, double lead, std::function<bool(Hypothesis const&)> const& rivals);
  [[nodiscard]] bool any_exceeds(double evidence, std::function<bool(Hypothesis const&)> const& rivals);
  void listen_to_noise();
  [[nodiscard]] std::vector<double> strengths_beside_others() const;
  [[nodiscard]] Estimation with_effects(std::vector<Hypothesis> const& effects) const;
  bool drop_superfluous();
  bool exchange();

  DiagnosisOptions options_;
  thermal::Geometry geometry_;
  std::vector<ChannelNoise> expected_;
  std::vector<Hypothesis> hypotheses_;
  /// Of the hypotheses about the fit, or before noise was listened to for the last time; empty: not asked yet.
  Eigen::MatrixXd signatures_;
  std::optional<Estimation> plain_;
  std::optional<Estimation> estimation_;
  std::size_t visible_ = 0;
  Fit calibrated_, fit_;
  std::vector<Explanation> explanations_;
  std::optional<Suspicion> suspicion_;
};

/// A search that has tried all hypotheses: of several, the one whose explanation has the most evidence, where a machine
/// has no drawings. Its first fit has many optima, and what is named depends on where it ends.
[[nodiscard]] EffectSearch best_search(Value const& document, std::vector<BinnedRun> const& runs,
                                       std::vector<Hypothesis> const& hypotheses, DiagnosisOptions const& options);

}  // namespace thermotwin::twin
