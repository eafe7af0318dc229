#include "twin/command_line_error_model.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>

#include "output/atomic_file.h"
#include "output/json_text.h"
#include "thermal/error.h"
#include "thermal/units.h"
#include "twin/command_line_list.h"
#include "twin/command_line_number.h"
#include "twin/error_model_file.h"
#include "twin/error_prediction.h"
#include "twin/file/output_path.h"
#include "twin/file_kind.h"
#include "twin/fit_error_model.h"

namespace thermotwin::twin {
namespace {

void print_json(SavedErrorModel const& saved, std::vector<std::string> const& remarks) {
  auto json = error_model_json(saved);
  json["remarks"] = remarks;
  fmt::print("{}", output::json_text(std::move(json)));
}

struct FitCommand {
  ErrorModelFit fit;
  std::string sampling, twin, output;
  bool json = false;

  void add_to(CLI::App& command);
  void operator()();
};

void FitCommand::add_to(CLI::App& command) {
  command.add_option("runs", fit.runs, "data sets (.h5), tables (.csv) or measurement files (.toml)")->required();
  command.add_option("--error", fit.error, "displacement to explain, or \"slope z\" of axis z's error")
      ->capture_default_str();
  take_list(*command.add_option("--sensors", fit.sensors,
                                "temperatures to explain it by; default: all that lack few readings"));
  command
      .add_option("--method", fit.method,
                  "linear, ridge, \"twin observer\", …; the mean of several: \"twin & ridge\"; docs/study.md")
      ->capture_default_str();
  command.add_option("--twin", twin,
                     "machine, file or name, best calibrated; a method that does not name it fits what it errs by");
  command.add_option("--sampling", sampling, "fit means over this time: \"1 min\"; default: the rows as they are");
  command.add_option("--seed", fit.seed, "of random starts")->capture_default_str();
  command.add_option("--output,-o", output, "error model to write (TOML)")->required();
  command.add_flag("--json", json, "print everything as JSON");
}

void FitCommand::operator()() {
  for (auto const& sensor : fit.sensors)
    if (std::count(fit.sensors.begin(), fit.sensors.end(), sensor) > 1)
      throw thermal::InputError(fmt::format("--sensors: '{}' is given twice", sensor));
  check_suffix(output, "an error model", {".toml"});
  if (!twin.empty()) fit.twin = machine_file(twin);
  refuse_to_overwrite(output, fit.twin.value_or(""), fit.runs);
  refuse_to_replace(output, FileKind::error_model);
  if (!sampling.empty()) fit.sampling = positive_quantity("--sampling", sampling, thermal::dimension::time);
  std::vector<std::string> remarks;
  auto const saved = fit_error_model(fit, remarks);
  write_error_model(output, saved);
  if (json) return print_json(saved, remarks);
  for (auto const& remark : remarks) fmt::print("{}\n", remark);
  fmt::print("{}", error_model_text(saved));
}

struct PredictCommand {
  std::string model, output;
  std::vector<std::filesystem::path> runs;
  bool json = false;

  void operator()() const;
};

void PredictCommand::operator()() const {
  check_suffix(output, "a table", {".csv"});
  auto read = runs;
  read.emplace_back(model);
  refuse_to_overwrite(output, {}, read);
  refuse_to_replace_other_table(output, "table of predictions", is_prediction_header);
  if (!output.empty() && runs.size() > 1)
    throw thermal::InputError(
        fmt::format("--output {} takes the prediction of one run; {} are given", output, runs.size()));
  auto const saved = read_error_model(model);
  if (!json) fmt::print("{}", error_model_text(saved));
  std::vector<ErrorPrediction> predictions;
  for (auto const& run : runs) {
    auto const& prediction = predictions.emplace_back(predict_error(saved, run));
    if (!output.empty()) output::write_atomically(output, prediction_csv(prediction));
    if (json) continue;
    fmt::print("\n");
    for (auto const& remark : prediction.remarks) fmt::print("{}\n", remark);
    fmt::print("{}", prediction_text(prediction));
  }
  if (json) fmt::print("{}", predictions_json(saved, predictions));
}

}  // namespace

void add_error_model_commands(CLI::App& app) {
  auto fit = std::make_shared<FitCommand>();
  auto* command = app.add_subcommand("fit", "fit an error model to runs and save it");
  fit->add_to(*command);
  command->callback([fit] { (*fit)(); });
  auto predict = std::make_shared<PredictCommand>();
  command = app.add_subcommand("predict", "what a saved error model says of other runs, and by how much it errs");
  command->add_option("model", predict->model, "error model (thermotwin fit)")->required();
  command->add_option("runs", predict->runs, "data sets (.h5), tables (.csv) or measurement files (.toml)")->required();
  command->add_option("--output,-o", predict->output, "table to write (CSV): error and prediction of every row");
  command->add_flag("--json", predict->json, "print everything as JSON");
  command->callback([predict] { (*predict)(); });
}

}  // namespace thermotwin::twin
