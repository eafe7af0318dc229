#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "output/atomic_file.h"
#include "thermal/error.h"
#include "twin/error_model_file.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;
using models::KernelForm;
using models::LinearForm;
using models::NetworkForm;

std::string toml_text(std::string_view text) {
  std::string result = "\"";
  for (char const c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c == '\n' || c == '\t' ? ' ' : c;
  }
  return result + '"';
}

std::string number(double value) {
  if (!std::isfinite(value)) throw thermal::InputError("an error model with a number that is not finite is not saved");
  return fmt::format("{}", value);
}

template <class Values>
std::string list(Values const& values) {
  std::vector<std::string> texts;
  for (double const value : values) texts.push_back(number(value));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

std::string scaling_text(auto const& form) {
  return fmt::format("input_offset = {}\ninput_scale = {}\ntarget_offset = {}\ntarget_scale = {}\n",
                     list(form.input_offset), list(form.input_scale), number(form.target_offset),
                     number(form.target_scale));
}

struct FormText {
  std::string_view table;  ///< that the form is of

  std::string operator()(LinearForm const& form) const {
    std::string text = fmt::format("\n[{}.linear]\nintercept = {}\nunfitted = {}\nlag = [\n", table,
                                   number(form.intercept), form.unfitted);
    for (std::size_t l = 0; l < form.lags.size(); ++l)
      text += fmt::format("  {{ samples = {}, coefficients = {} }},\n", form.lags[l],
                          list(form.coefficients.col(Index(l))));
    return text + "]\n";
  }
  std::string operator()(KernelForm const& form) const {
    std::string text = fmt::format("\n[{}.kernel]\ng = {}\nintercept = {}\n{}support = [\n", table, number(form.g),
                                   number(form.intercept), scaling_text(form));
    for (Index k = 0; k < form.weights.size(); ++k)
      text += fmt::format("  {{ weight = {}, x = {} }},\n", number(form.weights(k)), list(form.support.row(k)));
    return text + "]\n";
  }
  std::string operator()(NetworkForm const& form) const {
    std::string text = fmt::format("\n[{}.network]\noutput_threshold = {}\n{}node = [\n", table,
                                   number(form.output_threshold), scaling_text(form));
    for (Index k = 0; k < form.thresholds.size(); ++k)
      text += fmt::format("  {{ threshold = {}, output_weight = {}, weights = {} }},\n", number(form.thresholds(k)),
                          number(form.output_weights(k)), list(form.weights.row(k)));
    return text + "]\n";
  }
};

std::string predicts_text(SavedErrorModel const& saved) {
  std::string text = fmt::format("[predicts]\nerror = {}\nunit = {}\ntitle = {}\n", toml_text(saved.error),
                                 toml_text(saved.unit), toml_text(saved.title));
  if (saved.zero_position) text += fmt::format("zero_position = \"{} m\"\n", number(*saved.zero_position));
  return text;
}

std::string twin_text(TwinBeside const& twin, std::filesystem::path const& folder) {
  auto const machine = std::filesystem::proximate(std::filesystem::absolute(twin.machine), folder);
  return fmt::format("\n[twin]\nmachine = {}\nfingerprint = {}\n", toml_text(machine.string()),
                     toml_text(twin.fingerprint));
}

std::string ranges_text(std::vector<InputRange> const& ranges) {
  if (ranges.empty()) return {};
  std::vector<double> lowest, highest;
  for (auto const& range : ranges) {
    lowest.push_back(range.lowest);
    highest.push_back(range.highest);
  }
  return fmt::format("lowest_K = {}\nhighest_K = {}\n", list(lowest), list(highest));
}

std::string fit_text(SavedErrorModel const& saved) {
  std::string text =
      fmt::format("\n[fit]\nversion = {}\ncommit = {}\n", toml_text(saved.version), toml_text(saved.commit));
  if (saved.sampling) text += fmt::format("sampling = \"{} s\"\n", number(*saved.sampling));
  text += "run = [\n";
  for (auto const& run : saved.runs)
    text += fmt::format(
        "  {{ file = {}, machine = {}, fingerprint = {}, rows = {}, rmse = {}, largest = {}, zero_degC = {} }},\n",
        toml_text(run.file), toml_text(run.machine), toml_text(run.fingerprint), run.rows, number(run.rmse),
        number(run.largest), list(run.zero));
  return text + "]\n";
}

std::string observer_text(ObserverOptions const& options, std::string_view table) {
  return fmt::format("\n[{}.observer]\nheat_noise = {}\nsensor_noise = {}\nlongest_step = \"{} s\"\n", table,
                     number(options.heat_noise), number(options.sensor_noise), number(options.longest_step));
}

/// `head`: "[model]", "[[part]]"; `table`: what its form's table is of.
std::string part_text(ModelPart const& part, std::string_view head, std::string_view table) {
  auto const& model = part.model;
  std::vector<std::string> inputs;
  for (auto const& input : model.inputs) inputs.push_back(toml_text(input));
  std::string const text = fmt::format("\n{}\nmethod = {}\ninputs = [{}]\n{}", head, toml_text(part.name()),
                                       fmt::join(inputs, ", "), ranges_text(part.ranges));
  if (part.observer) return text + observer_text(*part.observer, table);
  if (!part.reads()) return text;
  return text +
         fmt::format("sample_period = \"{} s\"\nparameters = {}\nremark = {}\n", number(model.sample_period),
                     number(model.parameters), toml_text(model.remark)) +
         std::visit(FormText{table}, model.form);
}

std::string parts_text(std::vector<ModelPart> const& parts) {
  if (parts.size() == 1) return part_text(parts.front(), "[model]", "model");
  std::string text;
  for (auto const& part : parts) text += part_text(part, "[[part]]", "part");
  return text;
}

}  // namespace

void write_error_model(std::filesystem::path const& path, SavedErrorModel const& saved) {
  auto const folder = std::filesystem::absolute(path).parent_path();
  output::write_atomically(path, predicts_text(saved) + (saved.twin ? twin_text(*saved.twin, folder) : "") +
                                     (saved.runs.empty() ? "" : fit_text(saved)) + parts_text(saved.parts));
}

}  // namespace thermotwin::twin
