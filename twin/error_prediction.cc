#include "twin/error_prediction.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <regex>
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
    double const step = reading_step(run.batch.temperature_rise.col(Index(j)));
    Index const beyond =
        std::count_if(changes.begin(), changes.end(), [&](double x) { return range.left_by(x, step); });
    if (beyond == 0) continue;
    bool const above = changes.maxCoeff() - range.highest > range.lowest - changes.minCoeff();
    remarks.push_back(
        fmt::format("extrapolation{} in {} of {} rows: {}", of, beyond, changes.size(),
                    range_left_text(part.model.inputs[j], above ? changes.maxCoeff() : changes.minCoeff(), range)));
  }
}

/// An error that begins after the run's first row counts from what the model says to have changed by then.
void count_from_prediction(ErrorPrediction& prediction) {
  auto& run = prediction.run;
  Index const first = run.first_with_error();
  if (!run.shown || first == 0) return;
  double const change = prediction.predicted(first, 0) - prediction.predicted(0, 0);
  run.batch.error.array() += change;
  run.batch.error(run.without_error).setZero();
  prediction.remarks.push_back(fmt::format(
      "{}: the error begins in row {}; it counts from the {:.2f} {} that the model says to have changed by then",
      run.batch.name, run.rows[std::size_t(first)] + 1, change, prediction.unit));
}

Index rows_of(ErrorPrediction const& prediction) {
  return std::max<Index>(0, prediction.predicted.rows() - prediction.unclaimed);
}

/// Rows that the model claims to predict and that show the error.
std::vector<Index> judged_rows(ErrorPrediction const& prediction) {
  std::vector<Index> judged;
  if (!prediction.run.shown) return judged;
  auto const shown = prediction.shown();
  for (Index i = prediction.unclaimed; i < prediction.predicted.rows(); ++i)
    if (shown.row(i).allFinite()) judged.push_back(i);
  return judged;
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

/// Of rows in which the run shows the error.
ErrorSizes sizes_of(ErrorPrediction const& prediction, std::vector<Index> const& rows) {
  MatrixXd const shown = prediction.shown()(rows, Eigen::all);
  return {size_of(shown, MatrixXd::Zero(shown.rows(), shown.cols())),
          size_of(shown, prediction.predicted(rows, Eigen::all))};
}

constexpr double share_of_bias = 0.9, times_the_fit = 3.0, share_at_once = 0.5, share_of_error = 0.01;
constexpr std::size_t fewest_judged_rows = 5;

/// An outlier in the row from which all changes count shifts all others by as much, the next one too; what a model
/// misses grows from there.
void remark_outlier(SavedErrorModel const& saved, ErrorPrediction& prediction) {
  auto const& run = prediction.run;
  if (run.axis || saved.runs.empty()) return;
  auto rows = judged_rows(prediction);
  std::erase(rows, run.first_with_error());
  if (rows.size() < fewest_judged_rows) return;
  auto const [error, left] = sizes_of(prediction, rows);
  double const bias = std::abs(left.bias);
  if (bias < share_of_bias * left.metrics.rmse || bias < times_the_fit * saved.rmse() ||
      bias < share_of_error * error.metrics.rmse)
    return;
  double const next = run.batch.error[rows.front()] - prediction.predicted(rows.front(), 0);
  if (next / left.bias < share_at_once) return;
  prediction.remarks.push_back(fmt::format(
      "{}: all rows are off by about {:.2f} {}, from the next one on: row {}, from which changes count, may be an "
      "outlier",
      run.batch.name, left.bias, prediction.unit, run.rows[std::size_t(run.first_with_error())] + 1));
}

std::string number_or_empty(double value) { return std::isfinite(value) ? fmt::format("{}", value) : std::string(); }

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
  auto const judged = judged_rows(prediction);
  json["judged"] = judged.size();
  if (!judged.empty()) {
    auto const sizes = sizes_of(prediction, judged);
    json["error"] = size_json(sizes.error);
    json["less_prediction"] = size_json(sizes.left);
  }
  json["fitted_to_these_data"] = prediction.seen_before;
  json["remarks"] = prediction.remarks;
  return json;
}

}  // namespace

MatrixXd ErrorPrediction::shown() const {
  if (run.axis) return run.axis->error;
  MatrixXd error = run.batch.error;
  error(run.without_error, 0).setConstant(std::nan(""));
  return error;
}

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
  count_from_prediction(result);
  remark_outlier(saved, result);
  return result;
}

std::string prediction_text(ErrorPrediction const& prediction) {
  auto const& name = prediction.run.batch.name;
  Index const rows = rows_of(prediction);
  if (rows == 0) return fmt::format("{}: fewer rows than the model's lags reach back\n", name);
  if (!prediction.run.shown) return fmt::format("{}: {} rows predicted; the run does not show the error\n", name, rows);
  auto const judged = judged_rows(prediction);
  if (judged.empty()) return fmt::format("{}: {} rows predicted; none of them shows the error\n", name, rows);
  auto const sizes = sizes_of(prediction, judged);
  auto const width = std::max<std::size_t>(18, name.size() + 2);
  std::string text =
      fmt::format("{:<{}}{:>6}{:>10}{:>10}{:>10}{:>10}\n", name, width, "rows", "RMSE", "MAE", "bias", "largest");
  text += size_line("error", width, Index(judged.size()), sizes.error, prediction.unit);
  text += size_line("less prediction", width, Index(judged.size()), sizes.left, prediction.unit);
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
      if (run.shown) text += "," + number_or_empty(shown(i, q));
      text += fmt::format(",{}\n", i < prediction.unclaimed ? "" : number_or_empty(prediction.predicted(i, q)));
    }
  return text;
}

bool is_prediction_header(std::string const& line) {
  static std::regex const own("time_s(,position_mm)?(,error_\\w+)?,predicted_\\w+");
  return std::regex_match(line, own);
}

}  // namespace thermotwin::twin
