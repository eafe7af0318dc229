#include "twin/report/difference.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <vector>

#include "output/fields.h"
#include "thermal/error.h"
#include "thermal/growth_field.h"
#include "twin/diagnosis/prediction.h"
#include "twin/file/distinct_names.h"
#include "twin/machine.h"
#include "twin/report/carried_residual.h"
#include "twin/report/machine_section.h"
#include "twin/report/shown_run.h"

namespace thermotwin::twin {
namespace {

using output::Frame;
using thermal::InputError;

constexpr double same_place = 1e-9;  // m

bool is_data(std::filesystem::path const& path) { return path.extension() == ".h5" || path.extension() == ".csv"; }

bool same(thermal::Cell const& a, thermal::Cell const& b) {
  return a.index() == b.index() && (thermal::centre(a) - thermal::centre(b)).norm() < same_place &&
         std::abs(std::cbrt(thermal::volume(a)) - std::cbrt(thermal::volume(b))) < same_place;
}

/// A run with the machine that it was made with.
struct KnownRun {
  ShownRun const& run;
  Machine machine;

  [[nodiscard]] std::string name() const { return run.name.string(); }
};

thermal::BodyGeometry const& body_of(KnownRun const& known, std::string const& name, KnownRun const& other) {
  auto const& bodies = known.machine.geometry;
  auto const found = std::find_if(bodies.begin(), bodies.end(), [&](auto const& body) { return body.name == name; });
  if (found == bodies.end())
    throw InputError(fmt::format("only {} has the body '{}', {} has not: a difference needs the same bodies",
                                 other.name(), name, known.name()));
  return *found;
}

/// For each node with a place in the first run, the one of the second; −1: it has no place.
std::vector<int> matched_nodes(KnownRun const& first, KnownRun const& second) {
  for (auto const& body : second.machine.geometry) static_cast<void>(body_of(first, body.name, second));
  std::vector<int> nodes(std::size_t(first.machine.network().nodes()), -1);
  for (auto const& mine : first.machine.geometry) {
    auto const& theirs = body_of(second, mine.name, first);
    if (mine.cells.size() != theirs.cells.size())
      throw InputError(fmt::format("the body '{}' has {} cells in {} and {} in {}: a difference needs the same mesh",
                                   mine.name, mine.cells.size(), first.name(), theirs.cells.size(), second.name()));
    for (std::size_t i = 0; i < mine.cells.size(); ++i) {
      if (!same(mine.cells[i], theirs.cells[i]))
        throw InputError(
            fmt::format("cell {} of the body '{}' is another in {} than in {}: a difference needs the "
                        "same mesh",
                        i, mine.name, first.name(), second.name()));
      nodes[std::size_t(mine.first_node) + i] = theirs.first_node + int(i);
    }
  }
  return nodes;
}

void check_nodes(KnownRun const& known) {
  auto const held = known.run.data.node_temperatures->cols();
  if (held != known.machine.network().nodes())
    throw InputError(fmt::format("{} holds {} nodes, but the machine that it names has {}", known.name(), held,
                                 known.machine.network().nodes()));
}

Eigen::VectorXd temperatures_at(output::Dataset const& data, double time_s) {
  auto const next = std::lower_bound(data.time_s.begin(), data.time_s.end(), time_s) - data.time_s.begin();
  Eigen::VectorXd const after = data.node_temperatures->row(next).cast<double>();
  if (data.time_s[next] == time_s) return after;
  Eigen::VectorXd const before = data.node_temperatures->row(next - 1).cast<double>();
  double const share = (time_s - data.time_s[next - 1]) / (data.time_s[next] - data.time_s[next - 1]);
  return before + share * (after - before);
}

Eigen::Matrix3Xd grown(KnownRun const& known, Eigen::VectorXd const& temperatures) {
  Eigen::VectorXd const rise = temperatures - temperatures_at(known.run.data, known.run.data.time_s[0]);
  return thermal::growth_field(known.machine.growing, {rise.data(), std::size_t(rise.size())});
}

/// Rows of the first that lie within the second's time, at least `interval` apart, and the last of them.
std::vector<Eigen::Index> frame_rows(Eigen::VectorXd const& times, Eigen::VectorXd const& others, double interval) {
  std::vector<Eigen::Index> rows;
  Eigen::Index last = -1;
  for (Eigen::Index r = 0; r < times.size(); ++r) {
    if (others.size() == 0 || times[r] < others[0] || times[r] > others[others.size() - 1]) continue;
    last = r;
    if (rows.empty() || times[r] >= times[rows.back()] + interval - 1e-6) rows.push_back(r);
  }
  if (last < 0) throw InputError("the two have no time in common");
  if (rows.back() != last) rows.push_back(last);
  return rows;
}

/// First minus second of every placed sensor, at the first's times: row × sensor; NaN where either shows nothing.
Eigen::MatrixXd residuals(ShownRun const& first, ShownRun const& second, Machine const& machine) {
  auto const& times = first.data.time_s;
  Eigen::MatrixXd values = Eigen::MatrixXd::Constant(times.size(), Eigen::Index(machine.sensors.size()), std::nan(""));
  for (std::size_t s = 0; s < machine.sensors.size(); ++s)
    for (auto const& mine : first.data.readings)
      for (auto const& theirs : second.data.readings)
        if (mine.name == machine.sensors[s].description.name && theirs.name == mine.name) {
          auto const known = samples_of(second, theirs.values);
          values.col(Eigen::Index(s)) = mine.values - output::at_times(known.values, known.time_s, times);
        }
  return values;
}

/// The same, where the second is the machine itself.
struct Predicted {
  Eigen::VectorXd time;
  Eigen::MatrixXd residuals;
};

Predicted predicted(std::filesystem::path const& data, Machine const& machine) {
  auto const run = read_measured_run(data, machine);
  auto const shown = predict(machine, run);
  Predicted result{run.time, Eigen::MatrixXd::Constant(run.time.size(), Eigen::Index(machine.sensors.size()),
                                                       std::numeric_limits<double>::quiet_NaN())};
  for (std::size_t s = 0; s < machine.sensors.size(); ++s)
    for (std::size_t c = 0; c < run.channels.size(); ++c)
      if (run.channels[c].name == machine.sensors[s].description.name && !run.channels[c].displacement)
        result.residuals.col(Eigen::Index(s)) = run.channels[c].values - shown.col(Eigen::Index(c));
  return result;
}

/// Sensors with a place: their index in the machine.
std::vector<Eigen::Index> placed_sensors(Machine const& machine) {
  std::vector<Eigen::Index> placed;
  for (std::size_t s = 0; s < machine.sensors.size(); ++s)
    if (!machine.sensors[s].weights.empty()) placed.push_back(Eigen::Index(s));
  return placed;
}

output::FieldOptions options_for(DifferenceFiles const& files, Machine const& machine, output::FieldMeaning meaning) {
  output::FieldOptions options;
  options.meaning = meaning;
  auto const names = distinct_names({files.first, files.second});
  options.metadata = {{"first", names[0].string()}, {"second", names[1].string()}, {"machine", machine.name}};
  for (auto const s : placed_sensors(machine)) {
    auto const& sensor = machine.sensors[std::size_t(s)];
    options.sensors.push_back({sensor.description.name, sensor.position});
  }
  options.up = machine.up;
  return options;
}

std::string told(output::FieldSeries const& series, std::size_t frames, std::string const& what) {
  return fmt::format("{}: {} frames of {}; arranged.pvsm beside it opens them in ParaView\n",
                     series.index_path().string(), frames, what);
}

std::string write_fields(DifferenceFiles const& files, KnownRun const& first, KnownRun const& second) {
  auto const nodes = matched_nodes(first, second);
  check_nodes(first);
  check_nodes(second);
  auto const rows = frame_rows(first.run.data.time_s, second.run.data.time_s, files.interval);
  auto const sensors = residuals(first.run, second.run, first.machine);
  auto const placed = placed_sensors(first.machine);
  auto options = options_for(files, first.machine, output::FieldMeaning::difference);
  output::FieldSeries series(files.folder, first.machine.geometry, options);
  double largest = 0.0;
  for (auto const row : rows) {
    double const time = first.run.data.time_s[row];
    Eigen::VectorXd const mine = temperatures_at(first.run.data, time), theirs = temperatures_at(second.run.data, time);
    Frame frame{mine, {}, grown(first, mine), sensors(row, placed)};
    Eigen::Matrix3Xd const other = grown(second, theirs);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (nodes[i] < 0) continue;
      frame.temperature_degC[Eigen::Index(i)] -= theirs[nodes[i]];
      frame.displacement_m.col(Eigen::Index(i)) -= other.col(nodes[i]);
      largest = std::max(largest, std::abs(frame.temperature_degC[Eigen::Index(i)]));
    }
    series.add(time, frame);
  }
  return told(series, rows.size(), fmt::format("the difference of every node, {:.3g} K at most", largest));
}

std::string write_residual(DifferenceFiles const& files, Machine const& machine, Eigen::VectorXd const& times,
                           Eigen::VectorXd const& others, Eigen::MatrixXd const& residuals) {
  auto const placed = placed_sensors(machine);
  Eigen::MatrixXd const shown = residuals(Eigen::all, placed);
  if (!shown.array().isFinite().any())
    throw InputError(fmt::format("{} and {} have no temperature sensor of {} in common that has a place on it",
                                 files.first.string(), files.second, machine.name));
  std::vector<NodeWeights> seen;
  for (auto const s : placed) seen.push_back(machine.sensors[std::size_t(s)].weights);
  ResidualCarrier const carried(machine.geometry, seen);
  auto const rows = frame_rows(times, others, files.interval);
  output::FieldSeries series(files.folder, machine.geometry,
                             options_for(files, machine, output::FieldMeaning::residual));
  for (auto const row : rows) {
    Eigen::VectorXd const at_sensors = shown.row(row);
    series.add(times[row], {carried(at_sensors), {}, {}, at_sensors});
  }
  return told(series, rows.size(), "the residual at the sensors, carried over the bodies that bear them");
}

Machine drawn_machine(DifferenceFiles const& files, ShownRun const& first, ShownRun const& second) {
  if (!files.machine.empty()) return Machine::read(files.machine);
  for (auto const* run : {&second, &first})
    if (auto machine = machine_of(*run)) return *machine;
  throw InputError("neither of the two says what machine it was; name it with --machine");
}

}  // namespace

std::string write_difference(DifferenceFiles const& files) {
  if (!is_data(files.second)) {
    auto const machine = Machine::read(machine_file(files.second));
    auto const [times, values] = predicted(files.first, machine);
    return write_residual(files, machine, times, times, values);
  }
  std::vector<ShownRun> runs;
  for (std::filesystem::path const& file : {files.first, std::filesystem::path(files.second)})
    runs.push_back(read_shown_run(file));
  name_distinctly(runs);
  auto const &first = runs[0], &second = runs[1];
  if (first.data.node_temperatures && second.data.node_temperatures && files.machine.empty()) {
    auto mine = machine_of(first), theirs = machine_of(second);
    if (mine && theirs) return write_fields(files, {first, *mine}, {second, *theirs});
  }
  auto const machine = drawn_machine(files, first, second);
  return write_residual(files, machine, first.data.time_s, second.data.time_s, residuals(first, second, machine));
}

}  // namespace thermotwin::twin
