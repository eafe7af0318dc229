#include "twin/error_model_file.h"

#include <fmt/format.h>
#include <limits>
#include <string_view>

#include "thermal/error.h"
#include "twin/axis_record.h"
#include "twin/file_kind.h"
#include "twin/study/judgement.h"
#include "twin/study/study_file.h"

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

struct ObserverTable {
  double heat_noise = required, sensor_noise = required, longest_step = required;

  template <class Fields>
  static void fields(Fields& f) {
    f("heat_noise", &ObserverTable::heat_noise, dimensionless, "what a node errs by after one second [K/s^0.5]",
      Range{0.0, 1.0});
    f("sensor_noise", &ObserverTable::sensor_noise, dimensionless, "what a reading errs by, times root time [K s^0.5]",
      Range{0.0, 100.0, true});
    f("longest_step", &ObserverTable::longest_step, thermal::dimension::time, "of the integration",
      Range{0.0, 3600.0, true});
  }
};

struct ModelTable {
  std::string method, remark;
  std::vector<std::string> inputs;
  std::vector<double> lowest, highest;
  double sample_period = 0, parameters = 0;
  std::optional<LinearTable> linear;
  std::optional<KernelTable> kernel;
  std::optional<NetworkTable> network;
  std::optional<ObserverTable> observer;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("method", &ModelTable::method,
           "name in the catalogue; \"twin ridge\" of what the twin errs by, \"twin\", \"twin observer\"");
    f("inputs", &ModelTable::inputs, "sensors in the order of the coefficients");
    f("lowest_K", &ModelTable::lowest, dimensionless, "change of each input since the first row that the fit saw");
    f("highest_K", &ModelTable::highest, dimensionless, "likewise; beyond, the model extrapolates");
    f("sample_period", &ModelTable::sample_period, thermal::dimension::time, "that lags count in", Range{0, 1e6});
    f("parameters", &ModelTable::parameters, dimensionless, "numbers that the fit determined");
    f("remark", &ModelTable::remark, "what the fit found out");
    f("linear", &ModelTable::linear, "one of the three forms; the twin alone has none");
    f("kernel", &ModelTable::kernel, "likewise");
    f("network", &ModelTable::network, "likewise");
    f("observer", &ModelTable::observer, "in their place, of \"twin observer\"");
  }
};

struct RunTable {
  std::string file, machine, fingerprint;
  int rows = 0;
  double rmse = required, largest = required;
  std::vector<double> zero;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("file", &RunTable::file, "that the model was fitted to");
    f("machine", &RunTable::machine, "that was run or measured");
    f("fingerprint", &RunTable::fingerprint, "of times, temperatures and errors");
    f("rows", &RunTable::rows, "that the model claims to predict", Range{0, 1e9});
    f("rmse", &RunTable::rmse, dimensionless, "there [unit of the error]");
    f("largest", &RunTable::largest, dimensionless, "there [unit of the error]");
    f("zero_degC", &RunTable::zero, dimensionless, "temperatures of the inputs where the error is zero");
  }
};

struct TwinTable {
  std::string machine, fingerprint;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("machine", &TwinTable::machine, "machine file, relative to this one");
    f.name("fingerprint", &TwinTable::fingerprint, "of its text");
  }
};

struct FitTable {
  std::string version, commit;
  std::optional<double> sampling;
  std::vector<RunTable> runs;

  template <class Fields>
  static void fields(Fields& f) {
    f("version", &FitTable::version, "of the program");
    f("commit", &FitTable::commit, "of the program");
    f("sampling", &FitTable::sampling, thermal::dimension::time, "over which rows were averaged", Range{0, 1e6});
    f("run", &FitTable::runs, "what the model was fitted to");
  }
};

struct PredictsTable {
  std::string error, unit = "um", title;
  std::optional<double> zero_position;

  template <class Fields>
  static void fields(Fields& f) {
    f.name("error", &PredictsTable::error, "displacement channel, or \"slope z\"");
    f.choice("unit", &PredictsTable::unit, {"um", "urad", "um/m"}, "of the error");
    f("title", &PredictsTable::title, "of the channel");
    f("zero_position", &PredictsTable::zero_position, thermal::dimension::length, "of a slope");
  }
};

struct FileTables {
  std::optional<PredictsTable> predicts;
  std::optional<TwinTable> twin;
  std::optional<FitTable> fit;
  std::optional<ModelTable> model;
  std::vector<ModelTable> parts;

  template <class Fields>
  static void fields(Fields& f) {
    f("predicts", &FileTables::predicts, "what the model tells");
    f("twin", &FileTables::twin, "the twin of a model that is called so");
    f("fit", &FileTables::fit, "what it was fitted to; absent: nobody knows");
    f("model", &FileTables::model, "inputs and numbers");
    f("part", &FileTables::parts, "in place of [model]: models whose mean it is, all of the same inputs");
  }
};

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

NamedModel method_of(std::string const& method, Value const& table) {
  try {
    return named_model(method);
  } catch (thermal::InputError const& error) {
    throw FileError(table.find("method")->where, error.what());
  }
}

ModelPart observing_part_of(ModelTable const& read, Value const& table) {
  if (read.linear || read.kernel || read.network)
    throw FileError(table.where, "an observer has no form: what it tells is the twin's");
  return observing_part(read.inputs, {.heat_noise = read.observer->heat_noise,
                                      .sensor_noise = read.observer->sensor_noise,
                                      .longest_step = read.observer->longest_step});
}

ErrorModel model_of(ModelTable const& read, std::string const& method, Value const& table) {
  auto const forms = read.linear.has_value() + read.kernel.has_value() + read.network.has_value();
  if (forms != (method.empty() ? 0 : 1))
    throw FileError(table.where, method.empty() ? "the twin alone has no form: it adds nothing to what it says"
                                                : "exactly one of 'linear', 'kernel' and 'network' is due");
  if (method.empty()) return nothing_more(read.inputs);
  auto const place = [&](char const* key) { return TablePlace{table.find(key)->where, Index(read.inputs.size())}; };
  ErrorModel model{method, read.inputs, read.sample_period, read.parameters, {}, read.remark};
  if (read.linear) {
    auto const form = form_of(*read.linear, place("linear"));
    place("linear").check(form.lags.back() == 0 || read.sample_period > 0.0,
                          "lags count samples, and 'sample_period' of the model is missing or 0");
    model.form = form;
  }
  if (read.kernel) model.form = form_of(*read.kernel, place("kernel"));
  if (read.network) model.form = form_of(*read.network, place("network"));
  return model;
}

/// A slope has a zero position and its own unit, a displacement neither.
void check_predicts(FileTables const& read, Value const& document) {
  if (!read.predicts)
    throw FileError(document.where,
                    "no table [predicts]: an error model of an earlier version, which does not say what it predicts; "
                    "fit it anew");
  auto const& predicts = *read.predicts;
  bool const slope = predicts.error.starts_with(slope_prefix);
  auto const where = document.find("predicts")->where;
  if (slope != (predicts.unit == "um/m"))
    throw FileError(where, fmt::format("the unit of '{}' is {}, not '{}'", predicts.error,
                                       slope ? "'um/m'" : "'um' or 'urad'", predicts.unit));
  if (slope != predicts.zero_position.has_value())
    throw FileError(where, slope ? "'zero_position' of the slope is missing; write for example \"0.018 m\""
                                 : "'zero_position' is of a slope only");
  if (slope && read.twin) throw FileError(document.find("twin")->where, "a slope stands beside no twin");
}

std::vector<InputRange> ranges_of(ModelTable const& read, Value const& table) {
  auto const inputs = read.inputs.size();
  if (read.lowest.empty() && read.highest.empty()) return {};
  if (read.lowest.size() != inputs || read.highest.size() != inputs)
    throw FileError(table.where, fmt::format("'lowest_K' has {} numbers and 'highest_K' {}; the model has {} input{}",
                                             read.lowest.size(), read.highest.size(), inputs, inputs == 1 ? "" : "s"));
  std::vector<InputRange> ranges;
  for (std::size_t j = 0; j < inputs; ++j) {
    if (read.lowest[j] > read.highest[j])
      throw FileError(table.find("lowest_K")->where,
                      fmt::format("'lowest_K' {} is above 'highest_K' {}", read.lowest[j], read.highest[j]));
    ranges.push_back({read.lowest[j], read.highest[j]});
  }
  return ranges;
}

/// An observer has what it believes, and no form; others the reverse.
ModelPart part_of(ModelTable const& read, Value const& table) {
  auto const named = method_of(read.method, table);
  if (read.inputs.empty()) throw FileError(table.where, "'inputs' is missing or empty");
  if (named.observes() != read.observer.has_value())
    throw FileError(read.observer ? table.find("observer")->where : table.where,
                    read.observer
                        ? fmt::format("'observer' is of the method \"twin observer\", not of '{}'", read.method)
                        : "'observer' of the twin observer is missing; write for example observer = "
                          "{ heat_noise = 5e-4, sensor_noise = 0.5, longest_step = \"30 s\" }");
  if (read.observer) return observing_part_of(read, table);
  return {model_of(read, named.method, table), named.twin, ranges_of(read, table)};
}

/// A twin has parts that stand beside it, and only then.
void check_twin(FileTables const& read, Value const& document, std::vector<ModelPart> const& parts) {
  auto const beside = std::find_if(parts.begin(), parts.end(), [](auto const& part) { return part.beside_twin; });
  if (read.twin && beside == parts.end())
    throw FileError(document.find("twin")->where,
                    "no model stands beside this twin; write for example method = "
                    "\"twin ridge\"");
  if (!read.twin && beside != parts.end())
    throw FileError(document.where, fmt::format("'{}' stands beside a twin, and [twin] is missing", beside->name()));
}

std::vector<ModelPart> parts_of(FileTables const& read, Value const& document) {
  if (read.model) return {part_of(*read.model, *document.find("model"))};
  auto const& tables = std::get<Value::List>(document.find("part")->content);
  std::vector<ModelPart> parts;
  int observers = 0;
  for (std::size_t k = 0; k < read.parts.size(); ++k) {
    parts.push_back(part_of(read.parts[k], tables[k]));
    if (read.parts[k].inputs != read.parts.front().inputs)
      throw FileError(tables[k].where, "other 'inputs' than those of the first [[part]]; all have the same");
    if (parts.back().observer && observers++ > 0)
      throw FileError(tables[k].where, "a second 'twin observer'; a mean has one at most");
  }
  return parts;
}

void take_fit(FitTable const& read, Value const& table, SavedErrorModel& saved) {
  saved.version = read.version;
  saved.commit = read.commit;
  saved.sampling = read.sampling;
  for (std::size_t i = 0; i < read.runs.size(); ++i) {
    auto const& run = read.runs[i];
    if (run.zero.size() != saved.inputs().size())
      throw FileError(std::get<Value::List>(table.find("run")->content)[i].where,
                      fmt::format("'zero_degC' has {} temperatures; the model has {} inputs", run.zero.size(),
                                  saved.inputs().size()));
    saved.runs.push_back({run.file, run.machine, run.fingerprint, run.rows, run.zero, run.rmse, run.largest});
  }
}

}  // namespace

SavedErrorModel read_error_model(std::filesystem::path const& path) {
  auto const document = read_toml(path);
  auto const* table = document.find("model");
  auto const* several = document.find("part");
  bool const one = table && table->is_table(), mean = several && several->is_list();
  if (!one && !mean) refuse_other_kind(document, FileKind::error_model);
  if (!one && !mean)
    throw FileError(document.where, "no table [model], nor [[part]]: this is not the file of an error model");
  if (one && mean) throw FileError(table->where, "a model and parts; the mean of several models has only [[part]]");
  FileTables read;
  read_fields(document, read);
  check_predicts(read, document);
  SavedErrorModel saved;
  saved.error = read.predicts->error;
  saved.unit = read.predicts->unit;
  saved.title = read.predicts->title;
  saved.zero_position = read.predicts->zero_position;
  saved.parts = parts_of(read, document);
  check_twin(read, document, saved.parts);
  if (read.twin) saved.twin = {path.parent_path() / read.twin->machine, read.twin->fingerprint};
  if (read.fit) take_fit(*read.fit, *document.find("fit"), saved);
  return saved;
}

std::vector<FieldRecord> error_model_fields() { return list_fields<FileTables>(); }

}  // namespace thermotwin::twin
