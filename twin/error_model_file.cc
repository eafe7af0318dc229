#include "twin/error_model_file.h"

#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>

#include "output/atomic_file.h"
#include "thermal/error.h"
#include "twin/file/schema.h"

namespace thermotwin::twin {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using models::ErrorModel;
using models::KernelForm;
using models::LinearForm;
using models::NetworkForm;
using thermal::dimension::dimensionless;

constexpr double required = std::numeric_limits<double>::quiet_NaN();

// --- what the file holds
// ----------------------------------------------------------------------------------------------

struct LagTable {
  int samples = 0;
  std::vector<double> coefficients;

  template <class Fields>
  static void fields(Fields& f) {
    f("samples", &LagTable::samples, "how many samples ago", Range{0, 1e6});
    f("coefficients", &LagTable::coefficients, dimensionless, "of each input [um/K]");
  }
};

struct LinearTable {
  double intercept = required;
  int unfitted = 0;
  std::vector<LagTable> lag;

  template <class Fields>
  static void fields(Fields& f) {
    f("intercept", &LinearTable::intercept, dimensionless, "[um]");
    f("unfitted", &LinearTable::unfitted, "first samples that were only history in the fit", Range{0, 1e6});
    f("lag", &LinearTable::lag, "readings and their coefficients, latest first");
  }
};

/// What kernel and network share: x = (ΔT − offset)/scale, y = offset + scale f.
struct ScalingTable {
  std::vector<double> input_offset, input_scale;
  double target_offset = required, target_scale = required;

  template <class Table, class Fields>
  static void fields_of(Fields& f) {
    f("input_offset", &Table::input_offset, dimensionless, "of each input [K]");
    f("input_scale", &Table::input_scale, dimensionless, "of each input [K]");
    f("target_offset", &Table::target_offset, dimensionless, "[um]");
    f("target_scale", &Table::target_scale, dimensionless, "[um]");
  }
};

struct SupportTable {
  double weight = required;
  std::vector<double> x;

  template <class Fields>
  static void fields(Fields& f) {
    f("weight", &SupportTable::weight, dimensionless, "");
    f("x", &SupportTable::x, dimensionless, "scaled inputs");
  }
};

struct KernelTable : ScalingTable {
  double g = required, intercept = required;
  std::vector<SupportTable> support;

  template <class Fields>
  static void fields(Fields& f) {
    f("g", &KernelTable::g, dimensionless, "of exp(-g |x - x'|^2)");
    f("intercept", &KernelTable::intercept, dimensionless, "");
    fields_of<KernelTable>(f);
    f("support", &KernelTable::support, "support vectors");
  }
};

struct NodeTable {
  double threshold = required, output_weight = required;
  std::vector<double> weights;

  template <class Fields>
  static void fields(Fields& f) {
    f("threshold", &NodeTable::threshold, dimensionless, "");
    f("output_weight", &NodeTable::output_weight, dimensionless, "");
    f("weights", &NodeTable::weights, dimensionless, "of each input");
  }
};

struct NetworkTable : ScalingTable {
  double output_threshold = required;
  std::vector<NodeTable> node;

  template <class Fields>
  static void fields(Fields& f) {
    f("output_threshold", &NetworkTable::output_threshold, dimensionless, "");
    fields_of<NetworkTable>(f);
    f("node", &NetworkTable::node, "hidden nodes");
  }
};

struct ModelTable {
  std::string method, remark;
  std::vector<std::string> inputs;
  double sample_period = 0, parameters = 0;
  std::optional<LinearTable> linear;
  std::optional<KernelTable> kernel;
  std::optional<NetworkTable> network;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("method", &ModelTable::method, "name in the catalogue");
    f("inputs", &ModelTable::inputs, "sensors in the order of the coefficients");
    f("sample_period", &ModelTable::sample_period, thermal::dimension::time, "that lags count in", Range{0, 1e6});
    f("parameters", &ModelTable::parameters, dimensionless, "numbers that the fit determined");
    f("remark", &ModelTable::remark, "what the fit found out");
    f("linear", &ModelTable::linear, "");
    f("kernel", &ModelTable::kernel, "");
    f("network", &ModelTable::network, "");
  }
};

// --- writing
// ----------------------------------------------------------------------------------------------------------

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
  std::string operator()(LinearForm const& form) const {
    std::string text = fmt::format("\n[model.linear]\nintercept = {}\nunfitted = {}\nlag = [\n", number(form.intercept),
                                   form.unfitted);
    for (std::size_t l = 0; l < form.lags.size(); ++l)
      text += fmt::format("  {{ samples = {}, coefficients = {} }},\n", form.lags[l],
                          list(form.coefficients.col(Index(l))));
    return text + "]\n";
  }
  std::string operator()(KernelForm const& form) const {
    std::string text = fmt::format("\n[model.kernel]\ng = {}\nintercept = {}\n{}support = [\n", number(form.g),
                                   number(form.intercept), scaling_text(form));
    for (Index k = 0; k < form.weights.size(); ++k)
      text += fmt::format("  {{ weight = {}, x = {} }},\n", number(form.weights(k)), list(form.support.row(k)));
    return text + "]\n";
  }
  std::string operator()(NetworkForm const& form) const {
    std::string text = fmt::format("\n[model.network]\noutput_threshold = {}\n{}node = [\n",
                                   number(form.output_threshold), scaling_text(form));
    for (Index k = 0; k < form.thresholds.size(); ++k)
      text += fmt::format("  {{ threshold = {}, output_weight = {}, weights = {} }},\n", number(form.thresholds(k)),
                          number(form.output_weights(k)), list(form.weights.row(k)));
    return text + "]\n";
  }
};

// --- reading
// ----------------------------------------------------------------------------------------------------------

/// Puts a complaint where the table stands.
struct TablePlace {
  Location where;
  Index inputs;

  void check(bool holds, std::string const& complaint) const {
    if (!holds) throw FileError(where, complaint);
  }
  [[nodiscard]] VectorXd per_input(std::vector<double> const& values, std::string_view key) const {
    check(Index(values.size()) == inputs, fmt::format("'{}' has {} numbers; the model has {} input{}", key,
                                                      values.size(), inputs, inputs == 1 ? "" : "s"));
    return VectorXd::Map(values.data(), inputs);
  }
};

void read_scaling(ScalingTable const& table, TablePlace const& place, auto& form) {
  form.input_offset = place.per_input(table.input_offset, "input_offset");
  form.input_scale = place.per_input(table.input_scale, "input_scale");
  place.check(form.input_scale.minCoeff() > 0 && table.target_scale > 0, "a scale is not positive");
  form.target_offset = table.target_offset;
  form.target_scale = table.target_scale;
}

LinearForm form_of(LinearTable const& table, TablePlace const& place) {
  place.check(!table.lag.empty(),
              "'lag' is missing or empty; write for example lag = [{ samples = 0, coefficients = "
              "[0.5] }]");
  LinearForm form{table.intercept, {}, MatrixXd(place.inputs, Index(table.lag.size())), table.unfitted};
  for (auto const& lag : table.lag) {
    place.check(form.lags.empty() || lag.samples > form.lags.back(),
                fmt::format("the lag of {} samples comes after one of {}; lags ascend", lag.samples,
                            form.lags.empty() ? 0 : form.lags.back()));
    form.coefficients.col(Index(form.lags.size())) = place.per_input(lag.coefficients, "coefficients");
    form.lags.push_back(lag.samples);
  }
  return form;
}

KernelForm form_of(KernelTable const& table, TablePlace const& place) {
  place.check(!table.support.empty(), "'support' is missing or empty");
  KernelForm form;
  read_scaling(table, place, form);
  form.g = table.g;
  form.intercept = table.intercept;
  form.support.resize(Index(table.support.size()), place.inputs);
  form.weights.resize(Index(table.support.size()));
  for (Index k = 0; k < form.weights.size(); ++k) {
    auto const& support = table.support[std::size_t(k)];
    form.weights(k) = support.weight;
    form.support.row(k) = place.per_input(support.x, "x").transpose();
  }
  return form;
}

NetworkForm form_of(NetworkTable const& table, TablePlace const& place) {
  place.check(!table.node.empty(), "'node' is missing or empty");
  NetworkForm form;
  read_scaling(table, place, form);
  form.output_threshold = table.output_threshold;
  auto const nodes = Index(table.node.size());
  form.weights.resize(nodes, place.inputs);
  form.thresholds.resize(nodes);
  form.output_weights.resize(nodes);
  for (Index k = 0; k < nodes; ++k) {
    auto const& node = table.node[std::size_t(k)];
    form.thresholds(k) = node.threshold;
    form.output_weights(k) = node.output_weight;
    form.weights.row(k) = place.per_input(node.weights, "weights").transpose();
  }
  return form;
}

void check_method(std::string const& method, Value const& table) {
  std::vector<std::string> known;
  for (auto const& entry : models::model_methods()) known.emplace_back(entry.name);
  if (std::find(known.begin(), known.end(), method) == known.end())
    throw FileError(table.find("method")->where,
                    fmt::format("unknown method '{}'; {}", method, thermal::did_you_mean(method, known)));
}

}  // namespace

void write_error_model(std::filesystem::path const& path, ErrorModel const& model) {
  std::vector<std::string> inputs;
  for (auto const& input : model.inputs) inputs.push_back(toml_text(input));
  std::string const head =
      fmt::format("[model]\nmethod = {}\ninputs = [{}]\nsample_period = \"{} s\"\nparameters = {}\nremark = {}\n",
                  toml_text(model.method), fmt::join(inputs, ", "), number(model.sample_period),
                  number(model.parameters), toml_text(model.remark));
  output::write_atomically(path, head + std::visit(FormText{}, model.form));
}

ErrorModel read_error_model(std::filesystem::path const& path) {
  auto const document = read_toml(path);
  auto const* table = document.find("model");
  if (!table || !table->is_table())
    throw FileError(document.where, "no table [model]: this is not the file of an error model");
  ModelTable read;
  read_fields(*table, read);
  check_method(read.method, *table);
  if (read.inputs.empty()) throw FileError(table->where, "'inputs' is missing or empty");
  if (read.linear.has_value() + read.kernel.has_value() + read.network.has_value() != 1)
    throw FileError(table->where, "exactly one of [model.linear], [model.kernel] and [model.network] is due");
  auto const place = [&](char const* key) { return TablePlace{table->find(key)->where, Index(read.inputs.size())}; };
  ErrorModel model{read.method, read.inputs, read.sample_period, read.parameters, {}, read.remark};
  if (read.linear) model.form = form_of(*read.linear, place("linear"));
  if (read.kernel) model.form = form_of(*read.kernel, place("kernel"));
  if (read.network) model.form = form_of(*read.network, place("network"));
  return model;
}

}  // namespace thermotwin::twin
