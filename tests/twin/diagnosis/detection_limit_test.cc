#include "twin/diagnosis/detection_limit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <optional>
#include <random>
#include <set>

#include "tests/twin/diagnosis/diagnosis_bench.h"

namespace thermotwin::twin {
namespace {

constexpr double asked = 11.0;
constexpr int rows = 60, unknowns = 4;

/// r = s ψ − J x + noise, with x drawn from its prior N(0, 1) each time: in how many of so many records the evidence
/// for s exceeds what is asked.
double share_told(Hypothesis const& hypothesis, double scale, double of_limit, int records) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  auto const draw = [&](Eigen::Index n, Eigen::Index m) -> Eigen::MatrixXd {
    return Eigen::MatrixXd::NullaryExpr(n, m, [&] { return normal(random); });
  };
  Eigen::MatrixXd const J = draw(rows, unknowns), signature = scale * draw(rows, 1) + J * draw(unknowns, 1);
  Fit fit;
  fit.jacobian = Jacobian(J, Eigen::VectorXd::Ones(unknowns));
  fit.information = J.transpose() * J + Eigen::MatrixXd::Identity(unknowns, unknowns);
  fit.residual = Eigen::VectorXd::Zero(rows + unknowns);
  double const information = Remainder(fit, signature).scores({hypothesis})[0].information;
  double const amplitude = of_limit * detectable(information, hypothesis, asked);
  int told = 0;
  for (int record = 0; record < records; ++record) {
    Eigen::VectorXd const data = amplitude * signature - J * draw(unknowns, 1) + draw(rows, 1);
    Eigen::VectorXd const x = -fit.information.llt().solve(J.transpose() * data);
    fit.residual << data + J * x, x;
    told += evidence_of(Remainder(fit, signature).scores({hypothesis})[0], hypothesis) > asked;
  }
  return double(told) / records;
}

/// Of 4000 records the share is known to 0.0035.
TEST(DetectionLimit, IsToldIn95Of100Records) {
  for (bool const either_sign : {true, false}) {
    Trial const trial{.largest = 1.0, .either_sign = either_sign};
    Hypothesis const hypothesis{nullptr, &trial, "", "", {}, 4.0, 1.0};
    for (double const scale : {2.0, 5.0}) {
      EXPECT_NEAR(share_told(hypothesis, scale, 1.0, 4000), 0.95, 0.012) << either_sign << scale;
      EXPECT_LT(share_told(hypothesis, scale, 0.5, 1000), 0.2) << either_sign << scale;
    }
  }
}

/// What the best of machines has is told of none.
TEST(DetectionLimit, IsBeyondWhatIsOrdinary) {
  Trial const contact{.largest = 0.3, .ordinary = 0.03};
  Hypothesis const hypothesis{nullptr, &contact, "", "", {}, 4.0, 0.3};
  EXPECT_NEAR(detectable(1e12, hypothesis, asked), 0.1, 1e-5);
  EXPECT_NEAR(share_told(hypothesis, 40.0, 1.0, 4000), 0.95, 0.012);
}

TEST(DetectionLimit, IsInfiniteWhereTheDataSayNothing) {
  Trial const trial{.largest = 1.0};
  EXPECT_EQ(detectable(0.0, {nullptr, &trial, "", "", {}, 4.0, 1.0}, asked), INFINITY);
}

/// What the twin of a v450 makes of two speeds in a swinging room.
struct Twin {
  explicit Twin(Value const& truth = tests::v450()) : run(tests::measured(truth, tests::two_speeds())) {
    tests::add_noise(run, 0.03, 0.1e-6, 8);
    data.push_back(bin(run, 300.0));
    estimation.emplace(tests::v450(), data, tests::channels_of(run), tests::noise_of(run, 0.03, 0.1e-6));
    fit = estimation->fit(estimation->prior_mean());
    all = hypotheses(tests::v450(), Machine::build(tests::v450()));
    Eigen::MatrixXd const raw = signatures(*estimation, fit, all);
    Eigen::MatrixXd whitened = raw;
    estimation->whiten(whitened);
    scores = Remainder(fit, whitened).scores(all);
    limits = detection_limits(*estimation, fit, all, raw, scores, asked);
  }
  [[nodiscard]] DetectionLimit const& limit_of(std::string const& label) const {
    return *std::find_if(limits.begin(), limits.end(),
                         [&](auto const& limit) { return limit.hypothesis.label() == label; });
  }
  /// Of an effect in that shape.
  [[nodiscard]] double evidence_for(Hypothesis const& hypothesis) const {
    auto const it = std::find_if(all.begin(), all.end(), [&](Hypothesis const& h) {
      return h.effect == hypothesis.effect && h.keys == hypothesis.keys;
    });
    return evidence_of(scores[std::size_t(it - all.begin())], *it);
  }

  MeasuredRun run;
  std::vector<BinnedRun> data;
  std::optional<Estimation> estimation;
  Fit fit;
  std::vector<Hypothesis> all;
  std::vector<Score> scores;
  std::vector<DetectionLimit> limits;
};

Twin const& healthy() {
  static Twin const once;
  return once;
}

/// The largest heat that could hide moves what two machines differ by, one of which has it; twice as much is told, half
/// as much is not.
TEST(DetectionLimit, OfHeatIsWhatItMovesAndWhatIsToldBeyond) {
  for (std::string const label : {"heat at motor", "heat at rear_ring"}) {
    DetectionLimit const& limit = healthy().limit_of(label);
    ASSERT_FALSE(limit.any_size) << label;
    auto const hidden = [&](Value const& document, double share) {
      return with_hypothesis(document, limit.hypothesis, "hidden", share * limit.amplitude);
    };
    Value const calibrated = healthy().estimation->document_at(healthy().fit.x);
    auto const shown = [&](Value const& document) {
      return LinearisedRun(Machine::build(document), healthy().data[0]).prediction();
    };
    Eigen::MatrixXd const more = shown(hidden(calibrated, 1.0)) - shown(calibrated);
    double swing = 0.0;
    for (std::size_t c = 0; c < healthy().run.channels.size(); ++c)
      if (healthy().run.channels[c].name == limit.channel)
        swing = more.col(Eigen::Index(c)).maxCoeff() - more.col(Eigen::Index(c)).minCoeff();
    EXPECT_NEAR(limit.swing, swing, 0.03 * swing) << label;
    EXPECT_GT(Twin(hidden(tests::v450(), 2.0)).evidence_for(limit.hypothesis), asked) << label;
    EXPECT_LT(Twin(hidden(tests::v450(), 0.5)).evidence_for(limit.hypothesis), asked) << label;
  }
}

TEST(DetectionLimit, OnePerEffectAndSiteLargestFirstAndNoneOfASensor) {
  std::set<std::string> labels;
  double last = INFINITY;
  for (auto const& limit : healthy().limits) {
    EXPECT_TRUE(labels.insert(limit.hypothesis.label()).second) << limit.hypothesis.label();
    EXPECT_LE(limit.swing, last);
    EXPECT_EQ(limit.unit, "um");
    EXPECT_FALSE(limit.hypothesis.is_about("sensor"));
    EXPECT_LE(limit.amplitude, limit.hypothesis.largest);
    last = limit.swing;
  }
  EXPECT_GT(labels.size(), 100u);
}

}  // namespace
}  // namespace thermotwin::twin
