#include "twin/diagnosis/score.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <optional>

#include "tests/twin/diagnosis/diagnosis_bench.h"
#include "tests/twin/diagnosis/normal_matrix.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using tests::normal;
using tests::v450;

/// z = −J x + noise, three unknowns with priors; fitted.
struct Toy {
  static constexpr Index rows = 40, unknowns = 3;

  explicit Toy(Eigen::Vector3d const& priors = {1.0, 2.0, 0.5}) : J(rows + unknowns, unknowns) {
    J << normal(rows, unknowns, 1), MatrixXd(priors.asDiagonal());
    VectorXd const start = normal(rows + unknowns, 1, 2);
    fit.residual = start + J * refitted(start, J);
    fit.cost = fit.residual.squaredNorm();
    tell(fit, J);
  }
  /// What a fit knows of this.
  static void tell(Fit& fit, MatrixXd const& J) {
    fit.jacobian = Jacobian(J.topRows(J.rows() - J.cols()), J.bottomRows(J.cols()).diagonal());
    fit.information = J.transpose() * J;
  }
  /// x that makes |r + J x|² smallest.
  static VectorXd refitted(VectorXd const& r, MatrixXd const& J) {
    return -(J.transpose() * J).eval().ldlt().solve(J.transpose() * r);
  }
  /// The cost when the machine has an effect of this signature besides, and everything is fitted anew; its amplitude.
  [[nodiscard]] std::pair<double, double> with(VectorXd const& signature) const {
    MatrixXd all(rows + unknowns, unknowns + 1);
    all << J, VectorXd::Zero(rows + unknowns);
    all.col(unknowns).head(rows) = -signature;
    VectorXd const x = refitted(fit.residual, all);
    return {(fit.residual + all * x).squaredNorm(), x[unknowns]};
  }

  MatrixXd J;  ///< of the residual, priors included
  Fit fit;
  Trial const any{.amplitude = "power", .largest = 1.0, .either_sign = true};
  Trial const positive{.amplitude = "power", .largest = 1.0, .either_sign = false};
};

TEST(Score, IsWhatTheCostWouldFallByIfTheEffectWereFitted) {
  Toy const toy;
  MatrixXd const signatures = normal(Toy::rows, 20, 3);
  std::vector<Hypothesis> const hypotheses(20, Hypothesis{nullptr, &toy.any, "", "", {}});
  auto const scores = Remainder(toy.fit, signatures).scores(hypotheses);
  for (std::size_t k = 0; k < scores.size(); ++k) {
    auto const [cost, amplitude] = toy.with(signatures.col(Index(k)));
    EXPECT_NEAR(scores[k].statistic, toy.fit.cost - cost, 1e-9 * toy.fit.cost);
    EXPECT_NEAR(scores[k].amplitude, amplitude, 1e-9);
    EXPECT_GT(scores[k].information, 0.0);
    EXPECT_LT(scores[k].information, signatures.col(Index(k)).squaredNorm());
  }
}

TEST(Score, IsNothingForTheForbiddenSign) {
  Toy const toy;
  VectorXd const along = toy.fit.residual.head(Toy::rows);
  MatrixXd signatures(Toy::rows, 2);
  signatures << along, -along;
  std::vector<Hypothesis> const hypotheses(2, Hypothesis{nullptr, &toy.positive, "", "", {}});
  auto const scores = Remainder(toy.fit, signatures).scores(hypotheses);
  EXPECT_GT(scores[0].statistic, 0.0);
  EXPECT_LT(scores[1].amplitude, 0.0);
  EXPECT_EQ(scores[1].statistic, 0.0);
}

TEST(Score, IsNothingWhereTheUnknownsExplainEverything) {
  Toy const toy(Eigen::Vector3d::Zero());
  MatrixXd signatures(Toy::rows, 2);
  signatures << toy.J.topRows(Toy::rows) * Eigen::Vector3d(1.0, -2.0, 0.3), VectorXd::Zero(Toy::rows);
  std::vector<Hypothesis> const hypotheses(2, Hypothesis{nullptr, &toy.any, "", "", {}});
  for (auto const& s : Remainder(toy.fit, signatures).scores(hypotheses)) {
    EXPECT_EQ(s.statistic, 0.0);
    EXPECT_LT(s.information, 1e-9);
  }
}

/// A fit without its last unknowns is one that never had them, about the others where they are.
TEST(Score, WithoutUnknownsIsThatOfAFitThatNeverHadThem) {
  Toy toy;
  toy.fit.x = Eigen::Vector3d(0.7, -0.4, 1.3);
  MatrixXd const signatures = normal(Toy::rows, 10, 5);
  std::vector<Hypothesis> const hypotheses(10, Hypothesis{nullptr, &toy.any, "", "", {}});
  for (Index const first : {1, 2, 3}) {
    Index const gone = Toy::unknowns - first;
    Fit fewer;
    Toy::tell(fewer, toy.J.topLeftCorner(Toy::rows + first, first));
    fewer.residual = (toy.fit.residual - toy.J.rightCols(gone) * toy.fit.x.tail(gone)).head(Toy::rows + first);
    auto const expected = Remainder(fewer, signatures).scores(hypotheses);
    Fit fit = toy.fit;
    for (Index unknown = first; unknown < Toy::unknowns; ++unknown) fit = without(fit, unknown);
    auto const actual = Remainder(fit, signatures).scores(hypotheses);
    for (std::size_t k = 0; k < actual.size(); ++k) {
      EXPECT_NEAR(actual[k].statistic, expected[k].statistic, 1e-9 * toy.fit.cost) << first;
      EXPECT_NEAR(actual[k].amplitude, expected[k].amplitude, 1e-9) << first;
    }
  }
}

/// T less what the prior takes, from the Gaussian integral over ψ.
TEST(Score, EvidenceIsAnIntegralOverTheAmplitude) {
  Toy const toy;
  double const a = 8.0, amplitude = 0.9, deviation = amplitude_deviation;
  auto const evidence = [&](Trial const& trial, double from) {
    double sum = 0.0, prior = 0.0;
    for (double psi = from; psi < 6.0; psi += 1e-4) {
      double const weight = std::exp(-0.5 * psi * psi / (deviation * deviation));
      prior += weight;
      sum += weight * std::exp(a * psi * amplitude - 0.5 * a * psi * psi);
    }
    EXPECT_NEAR(evidence_of({a * amplitude * amplitude, amplitude, a}, {nullptr, &trial, "", "", {}}),
                2.0 * std::log(sum / prior), trial.either_sign ? 1e-6 : 0.1);
  };
  evidence(toy.any, -6.0);
  evidence(toy.positive, 0.0);
  EXPECT_EQ(evidence_of({}, {nullptr, &toy.any, "", "", {}}), 0.0);
}

/// Nobody believes in an effect of three times its largest size: it explains what it does at 1.25 of it.
TEST(Score, EvidenceOfAnImplausibleAmplitudeIsThatOfThePlausibleOne) {
  Toy const toy;
  double const a = 8.0, amplitude = 3.0, deviation = amplitude_deviation, most = most_of_largest;
  double const gain = 2.0 * a * amplitude * most - (a + 1.0 / (deviation * deviation)) * most * most;
  EXPECT_NEAR(evidence_of({a * amplitude * amplitude, amplitude, a}, {nullptr, &toy.any, "", "", {}}),
              gain - std::log1p(a * deviation * deviation), 1e-12);
}

/// The best of sensors reads 3 % of the air: no evidence of a fault where the data allow that, T as ever beyond.
TEST(Score, AnOrdinaryAmplitudeIsNoEvidence) {
  Trial const contact{.largest = 0.3, .ordinary = 0.03};
  Hypothesis const hypothesis{nullptr, &contact, "", "", {}, 4.0, 0.3};
  auto const evidence = [&](double share, double standard_error) {
    double const a = std::pow(0.3 / standard_error, 2.0), amplitude = share / 0.3;
    return evidence_of({a * amplitude * amplitude, amplitude, a}, hypothesis);
  };
  EXPECT_EQ(evidence(0.04, 0.006), -4.0);  // 0.04 less 1.96 of 0.006 is 0.028
  EXPECT_GT(evidence(0.04, 0.004), 80.0);  // T is 100
  EXPECT_EQ(evidence(0.029, 1e-4), -4.0);  // surely ordinary
}

/// A machine that hides 30 W, and the fit of its twin that does not know of it.
struct Hidden {
  explicit Hidden(std::string const& table)
      : run(tests::measured(tests::with_table(v450(), table), tests::two_speeds())) {
    tests::add_noise(run, kelvin, metres, 8);
    data.push_back(bin(run, 300.0));
    estimation.emplace(v450(), data, tests::channels_of(run), tests::noise_of(run, kelvin, metres));
    fit = estimation->fit(estimation->prior_mean());
    all = hypotheses(v450(), Machine::build(v450()));
    columns = signatures(*estimation, fit, all);
    estimation->whiten(columns);
    scores = Remainder(fit, columns).scores(all);
  }
  [[nodiscard]] std::size_t best() const {
    return std::size_t(std::max_element(scores.begin(), scores.end(),
                                        [](auto const& a, auto const& b) { return a.statistic < b.statistic; }) -
                       scores.begin());
  }

  static constexpr double kelvin = 0.03, metres = 0.1e-6;
  MeasuredRun run;
  std::vector<BinnedRun> data;
  std::optional<Estimation> estimation;
  Fit fit;
  std::vector<Hypothesis> all;
  MatrixXd columns;
  std::vector<Score> scores;
};

Hidden const& hidden_at_the_motor() {
  static Hidden const once(R"(
    [[heat]]
    name = "hidden"
    at = "motor"
    power = "30 W")");
  return once;
}

TEST(Score, OfHiddenHeatIsHighestAtItsPlace) {
  auto const& hidden = hidden_at_the_motor();
  auto const best = hidden.best();
  EXPECT_EQ(hidden.all[best].body, "motor") << hidden.all[best].label();
  EXPECT_GT(hidden.scores[best].statistic, 20.0);
}

/// One site of every effect: its response is that of the machine which has a little of it. What a lag adds to another
/// lag is far from linear.
TEST(Score, SignaturesAreDifferencesOfWholeRuns) {
  auto const& hidden = hidden_at_the_motor();
  auto const& estimation = *hidden.estimation;
  Value const document = estimation.document_at(hidden.fit.x);
  auto const shown = [&](Hypothesis const& hypothesis, double amplitude) {
    auto const machine = Machine::build(with_hypothesis(document, hypothesis, "trial", amplitude * hypothesis.largest));
    VectorXd prediction = LinearisedRun(machine, hidden.data[0]).prediction().reshaped();
    estimation.whiten(prediction);
    return prediction;
  };
  std::map<std::string, int> seen;
  int felt = 0;
  for (std::size_t k = 0; k < hidden.all.size(); ++k) {
    auto const& hypothesis = hidden.all[k];
    if (seen[hypothesis.effect->name]++ != 1) continue;
    double const step = 0.02;
    VectorXd const expected = (shown(hypothesis, 1e-8 + step) - shown(hypothesis, 1e-8)) / step;
    double const allowed = hypothesis.effect->name == "sensor_lag" ? 0.5 : 0.1;
    EXPECT_LE((hidden.columns.col(Index(k)) - expected).norm(), allowed * expected.norm()) << hypothesis.label();
    if (expected.norm() > 0.0) ++felt;
  }
  EXPECT_GT(felt, 15);
}

/// A lag of 7.5 min: its response per second is not that of a lag of one second.
TEST(Score, SignatureOfSomeSizeIsADifferenceOfThatSize) {
  auto const& hidden = hidden_at_the_motor();
  auto const& estimation = *hidden.estimation;
  auto const lag = with_those_of_some_size(hidden.all).back();
  ASSERT_EQ(lag.about, 0.5);
  MatrixXd columns = signatures(estimation, hidden.fit, {lag});
  Value const document = estimation.document_at(hidden.fit.x);
  auto const shown = [&](Value const& of) -> VectorXd {
    return LinearisedRun(Machine::build(of), hidden.data[0]).prediction().reshaped();
  };
  VectorXd const expected = (shown(with_hypothesis(document, lag, "trial", 0.5 * lag.largest)) - shown(document)) / 0.5;
  EXPECT_LE((columns.col(0) - expected).norm(), 1e-9 * expected.norm());
  Hypothesis slope = lag;
  slope.about = 0.0;
  EXPECT_GT((signatures(estimation, hidden.fit, {slope}).col(0) - expected).norm(), 0.05 * expected.norm());
}

/// What is told of an effect is what its evidence was computed for: with its prior, and no more than is plausible.
TEST(Score, ProbableAmplitudeHasItsPriorAndIsPlausible) {
  Score const weak{.statistic = 1.0, .amplitude = 1.0, .information = 1.0};
  double const precision = 1.0 + 1.0 / (amplitude_deviation * amplitude_deviation);
  EXPECT_DOUBLE_EQ(probable_amplitude(weak), 1.0 / precision);
  EXPECT_DOUBLE_EQ(probable_error(weak), 1.0 / std::sqrt(precision));
  Score const large{.statistic = 30.0, .amplitude = 2.75, .information = 4.0};
  EXPECT_DOUBLE_EQ(probable_amplitude(large), most_of_largest);
}

}  // namespace
}  // namespace thermotwin::twin
