#include "twin/error_prediction.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "models/metrics.h"
#include "output/json_text.h"
#include "thermal/error.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Json = nlohmann::ordered_json;

/// The run knows what the observer tells, where there is one.
MatrixXd predicted_of(SavedErrorModel const& saved, std::optional<TwinObserver> const& observer,
                      RecordedRun const& recorded, ErrorModelRun& run) {
  try {
    if (observer) run.observed = observed_change(*observer, recorded, run);
    return saved.predict(run);
  } catch (std::invalid_argument const& error) {
    throw thermal::InputError(error.what());
  }
}

void remark_machine(SavedErrorModel const& saved, std::string const& machine, std::vector<std::string>& remarks) {
  std::vector<std::string> fitted;
  for (auto const& run : saved.runs)
    if (!run.machine.empty() && std::find(fitted.begin(), fitted.end(), run.machine) == fitted.end())
      fitted.push_back(run.machine);
  if (machine.empty() || fitted.empty() || std::find(fitted.begin(), fitted.end(), machine) != fitted.end()) return;
  remarks.push_back(fmt::format("of '{}'; the model was fitted to '{}'", machine, fmt::join(fitted, "', '")));
}

void remark_extrapolation(ModelPart const& part, ErrorModelRun const& run, std::string const& of,
                          std::vector<std::string>& remarks) {
  auto const batch = part.beside_twin ? run.less_twin() : run.batch;
  for (std::size_t j = 0; j < part.ranges.size(); ++j) {
    auto const changes = batch.temperature_rise.col(Index(j));
    auto const& range = part.ranges[j];
    Index const beyond = std::count_if(changes.begin(), changes.end(), [&](double x) { return range.left_by(x); });
    if (beyond == 0) continue;
    bool const above = changes.maxCoeff() - range.highest > range.lowest - changes.minCoeff();
    remarks.push_back(
        fmt::format("extrapolation{} in {} of {} rows: {}", of, beyond, changes.size(),
                    range_left_text(part.model.inputs[j], above ? changes.maxCoeff() : changes.minCoeff(), range)));
  }
}

Index rows_of(ErrorPrediction const& prediction) {
  return std::max<Index>(0, prediction.predicted.rows() - prediction.unclaimed);
}

/// How large an error is, or what is left of it.
struct ErrorSize {
  models::Metrics metrics;
  double bias = 0.0;  ///< mean of true less predicted
};

struct ErrorSizes {
  ErrorSize error, left;
};

ErrorSize size_of(MatrixXd const& truth, MatrixXd const& said) {
  return {models::metrics(truth.reshaped(), said.reshaped()), (truth - said).mean()};
}

/// Of a run that shows the error and has rows.
ErrorSizes sizes_of(ErrorPrediction const& prediction) {
  MatrixXd const shown = prediction.shown().bottomRows(rows_of(prediction));
  return {size_of(shown, MatrixXd::Zero(shown.rows(), shown.cols())),
          size_of(shown, prediction.predicted.bottomRows(shown.rows()))};
}

std::string size_line(std::string const& name, std::size_t width, Index rows, ErrorSize const& size,
                      std::string const& unit) {
  double const bias = std::round(100.0 * size.bias) / 100.0 + 0.0;  // no "-0.00"
  return fmt::format("{:<{}}{:>6}{:>10.2f}{:>10.2f}{:>10.2f}{:>10.2f}  {}\n", name, width, rows, size.metrics.rmse,
                     size.metrics.mae, bias, size.metrics.max, unit);
}

Json size_json(ErrorSize const& size) {
  return {{"rmse", size.metrics.rmse}, {"mae", size.metrics.mae}, {"bias", size.bias}, {"largest", size.metrics.max}};
}

Json prediction_json(ErrorPrediction const& prediction) {
  Json json = {{"run", prediction.run.batch.name}, {"rows", rows_of(prediction)}, {"unit", prediction.unit}};
  if (prediction.run.shown && rows_of(prediction) > 0) {
    auto const sizes = sizes_of(prediction);
    json["error"] = size_json(sizes.error);
    json["less_prediction"] = size_json(sizes.left);
  }
  json["fitted_to_these_data"] = prediction.seen_before;
  json["remarks"] = prediction.remarks;
  return json;
}

}  // namespace

MatrixXd ErrorPrediction::shown() const { return run.axis ? run.axis->error : MatrixXd(run.batch.error); }

ErrorPrediction predict_error(SavedErrorModel const& saved, std::filesystem::path const& run) {
  auto const twin = saved.twin ? std::optional(twin_of(*saved.twin)) : std::nullopt;
  auto const observer = twin ? observer_of(saved, *twin) : std::nullopt;
  auto recorded = read_recorded_run(run, saved.sampling, twin ? &*twin : nullptr);
  if (observer) recorded.admit_observer(twin->name);
  recorded.believe_still(saved.inputs());
  ErrorPrediction result;
  result.run = error_model_run(recorded, saved.inputs(), saved.error, false);
  if (result.run.shown && result.run.unit != saved.unit)
    throw thermal::InputError(fmt::format("{} shows {} in {}; the model predicts {}", recorded.file, saved.error,
                                          result.run.unit, saved.unit));
  result.predicted = predicted_of(saved, observer, recorded, result.run);
  result.unclaimed = saved.unclaimed_instants();
  result.unit = result.run.axis ? "um" : saved.unit;
  result.seen_before = std::any_of(saved.runs.begin(), saved.runs.end(),
                                   [&](auto const& fitted) { return fitted.fingerprint == result.run.fingerprint; });
  remark_machine(saved, recorded.machine, recorded.remarks);
  for (auto const& part : saved.parts)
    remark_extrapolation(part, result.run, saved.parts.size() > 1 ? " of " + part.name() : "", recorded.remarks);
  for (auto const& remark : recorded.remarks) result.remarks.push_back(recorded.file + ": " + remark);
  return result;
}

std::string prediction_text(ErrorPrediction const& prediction) {
  auto const& name = prediction.run.batch.name;
  Index const rows = rows_of(prediction);
  if (rows == 0) return fmt::format("{}: fewer rows than the model's lags reach back\n", name);
  if (!prediction.run.shown) return fmt::format("{}: {} rows predicted; the run does not show the error\n", name, rows);
  auto const sizes = sizes_of(prediction);
  auto const width = std::max<std::size_t>(18, name.size() + 2);
  std::string text =
      fmt::format("{:<{}}{:>6}{:>10}{:>10}{:>10}{:>10}\n", name, width, "rows", "RMSE", "MAE", "bias", "largest");
  text += size_line("error", width, rows, sizes.error, prediction.unit);
  text += size_line("less prediction", width, rows, sizes.left, prediction.unit);
  if (prediction.seen_before) text += "the model was fitted to these very data: this is no test of it\n";
  return text;
}

std::string predictions_json(SavedErrorModel const& saved, std::vector<ErrorPrediction> const& predictions) {
  Json runs = Json::array();
  for (auto const& prediction : predictions) runs.push_back(prediction_json(prediction));
  return output::json_text({{"model", error_model_json(saved)}, {"runs", runs}});
}

std::string prediction_csv(ErrorPrediction const& prediction) {
  auto const& run = prediction.run;
  auto const shown = prediction.shown();
  std::string text = fmt::format("time_s{}{},predicted_{}\n", run.axis ? ",position_mm" : "",
                                 run.shown ? ",error_" + prediction.unit : "", prediction.unit);
  for (Index i = 0; i < prediction.predicted.rows(); ++i)
    for (Index q = 0; q < prediction.predicted.cols(); ++q) {
      text += fmt::format("{}", run.batch.time[i]);
      if (run.axis) text += fmt::format(",{}", 1e3 * run.axis->position[q]);
      if (run.shown) text += fmt::format(",{}", shown(i, q));
      text += fmt::format(",{}\n", prediction.predicted(i, q));
    }
  return text;
}

}  // namespace thermotwin::twin
