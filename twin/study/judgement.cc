#include "twin/study/judgement.h"

#include <algorithm>
#include <cmath>

#include "models/batch_statistics.h"
#include "models/feed_axis.h"
#include "models/metrics.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Named = std::map<std::string, double>;

/// What a prediction is held against: cross-validation chooses, and whoever chooses does not know the truth.
VectorXd const& answer_to(Asked const& asked) {
  return asked.role == Role::validation ? asked.batch.error : asked.truth;
}

/// Truths and predictions of one part, one below the other.
struct Pool {
  std::vector<double> truth, prediction;

  void add(VectorXd const& t, VectorXd const& p) {
    truth.insert(truth.end(), t.begin(), t.end());
    prediction.insert(prediction.end(), p.begin(), p.end());
  }
};

void put(Named& figures, std::string const& part, models::Metrics const& m) {
  figures[part + ".rmse"] = m.rmse;
  figures[part + ".mae"] = m.mae;
  figures[part + ".max"] = m.max;
  figures[part + ".r_squared"] = m.r_squared;
  figures[part + ".mape"] = m.mape;
}

void put(Named& figures, std::string const& part, Pool const& pool) {
  if (pool.truth.empty()) return;
  auto const n = Index(pool.truth.size());
  put(figures, part,
      models::metrics(Eigen::Map<VectorXd const>(pool.truth.data(), n),
                      Eigen::Map<VectorXd const>(pool.prediction.data(), n)));
}

/// The last instants of a stretch, without those that the model does not claim; it may claim none.
VectorXd claimed(VectorXd const& all, Asked const& asked, int unclaimed) {
  Index const end = asked.first + asked.count, first = std::clamp(Index(unclaimed), asked.first, end);
  return all.segment(first, end - first);
}

void put_spread(Named& figures, std::string const& name, VectorXd const& values) {
  figures[name] = values.mean();
  figures[name + ".least"] = values.minCoeff();
  figures[name + ".most"] = values.maxCoeff();
}

/// Models of single runs.
void put_statistics(Judgement& judgement, std::vector<Answer> const& fits,
                    std::vector<std::vector<VectorXd>> const& predictions) {
  std::vector<VectorXd> errors;
  for (auto const& asked : fits.front().asked()) errors.push_back(asked.batch.error);
  std::vector<double> parameters;
  for (auto const& fit : fits) parameters.push_back(fit.parameters());
  judgement.deviations = models::deviation_matrix(errors, predictions, parameters);
  auto const s = models::batch_statistics(judgement.deviations);
  auto& figures = judgement.figures;
  if (!fits.front().has_twin()) put_spread(figures, "S", s.S);
  put_spread(figures, "Mn", s.Mn);
  put_spread(figures, "Sd", s.Sd);
  if (s.verification_Mn.size() == 0) return;
  put_spread(figures, "verification.Mn", s.verification_Mn);
  put_spread(figures, "verification.Sd", s.verification_Sd);
}

/// One model of all training runs.
void put_statistics(Named& figures, Answer const& fit, std::vector<VectorXd> const& predictions) {
  Pool training;
  std::vector<double> tests;
  auto const& asked = fit.asked();
  for (std::size_t k = 0; k < asked.size(); ++k) {
    VectorXd const measured = claimed(asked[k].batch.error, asked[k], fit.unclaimed_instants());
    if (asked[k].role == Role::self)
      training.add(measured, predictions[k]);
    else if (measured.size() > 0)
      tests.push_back(models::residual_deviation(measured, predictions[k]));
  }
  auto const n = Index(training.truth.size());
  if (!fit.has_twin())
    figures["S"] =
        models::residual_deviation(Eigen::Map<VectorXd const>(training.truth.data(), n),
                                   Eigen::Map<VectorXd const>(training.prediction.data(), n), fit.parameters());
  if (tests.empty()) return;
  Eigen::Map<VectorXd const> const deviations(tests.data(), Index(tests.size()));
  figures["Mn"] = deviations.mean();
  if (tests.size() > 1)
    figures["Sd"] = std::sqrt((deviations.array() - deviations.mean()).square().sum() / double(tests.size() - 1));
}

}  // namespace

models::ErrorModel nothing_more(std::vector<std::string> const& sensors) {
  models::LinearForm form;
  form.coefficients = Eigen::MatrixXd::Zero(Index(sensors.size()), 1);
  models::ErrorModel model;
  model.method = twin_alone;
  model.inputs = sensors;
  model.form = form;
  return model;
}

FittedModel fit_model(NamedModel const& named, Question const& question, std::vector<Index> const& columns,
                      std::uint64_t seed) {
  std::vector<Index> own;
  for (auto const column : columns)
    own.push_back(std::find(question.columns.begin(), question.columns.end(), column) - question.columns.begin());
  std::vector<models::Batch> batches;
  for (auto const& batch : question.training) batches.push_back(models::with_sensors(batch, own));
  if (named.method.empty()) return {nothing_more(batches.front().sensors), ""};
  try {
    return {models::model_method(named.method).fit(batches, {.seed = seed}), ""};
  } catch (std::invalid_argument const& error) {
    return {{}, error.what()};
  }
}

VectorXd Answer::predict(std::size_t k) const {
  VectorXd sum = VectorXd::Zero(asked()[k].batch.time.size());
  for (auto const& [question, model, observed] : parts) {
    auto const& own = question->asked[k];
    auto const& said = observed ? (*observed)[k] : own.said_by_twin;
    VectorXd const answer = model->predict(own.batch);
    sum += said.size() > 0 ? VectorXd(said + answer) : answer;
  }
  return sum / double(parts.size());
}

int Answer::unclaimed_instants() const {
  int most = 0;
  for (auto const& part : parts) most = std::max(most, part.model->unclaimed_instants());
  return most;
}

bool Answer::has_twin() const {
  return std::any_of(parts.begin(), parts.end(), [](Part const& part) {
    return part.observed || part.question->asked.front().said_by_twin.size() > 0;
  });
}

double Answer::parameters() const {
  double sum = 0.0;
  for (auto const& part : parts) sum += part.model->parameters;
  return sum / double(parts.size());
}

Judgement judged(std::vector<Answer> const& fits, std::vector<Answer> const& validations, std::size_t train_runs,
                 int unclaimed) {
  Judgement judgement;
  auto& figures = judgement.figures;
  std::map<Role, Pool> pools;
  std::vector<std::vector<VectorXd>> predictions;
  for (auto const* answers : {&fits, &validations})
    for (auto const& answer : *answers) {
      auto& own = predictions.emplace_back();
      for (std::size_t k = 0; k < answer.asked().size(); ++k) {
        auto const& asked = answer.asked()[k];
        VectorXd const prediction = answer.predict(k);
        own.push_back(claimed(prediction, asked, answer.unclaimed_instants()));
        pools[asked.role].add(claimed(answer_to(asked), asked, unclaimed), claimed(prediction, asked, unclaimed));
      }
    }
  predictions.resize(fits.size());
  put(figures, "self", pools[Role::self]);
  put(figures, "cross", pools[Role::cross]);
  put(figures, "validation", pools[Role::validation]);
  if (fits.size() > 1 && fits.size() == train_runs)
    put_statistics(judgement, fits, predictions);
  else
    put_statistics(figures, fits.front(), predictions.front());
  return judgement;
}

Named judged_instants(StudyWorld const& world, WorldData const& data, int repetition, models::ErrorModel const& slope) {
  Named figures;
  auto const& train = data.train[std::size_t(repetition)];
  auto const& test = data.test[std::size_t(repetition)];
  std::vector<models::AxisRecord> records;
  for (auto const& run : train) records.push_back(*run.axis);
  models::FeedAxisModel const model{slope, models::zero_position(records)};
  records.clear();
  for (auto const* list : {&train, &test})
    for (auto const& run : *list) records.push_back(*run.judged_axis);
  for (auto const& instant : world.instants)
    for (auto const& record : records) {
      if (record.name != instant.experiment) continue;
      Index row = 0;
      (record.time.array() - instant.time).abs().minCoeff(&row);
      auto const m = model.at_instant(record, row, record.position.minCoeff(), record.position.maxCoeff());
      auto const name = instant.name();
      figures[name + ".rmse"] = m.rmse;
      figures[name + ".mae"] = m.mae;
      figures[name + ".max"] = m.max;
    }
  return figures;
}

}  // namespace thermotwin::twin
