#include "twin/diagnosis/linear_unknowns.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>

#include "twin/diagnosis/linearised_run.h"
#include "twin/diagnosis/warmer_air.h"
#include "twin/parallel.h"

namespace thermotwin::twin {
namespace {

constexpr double zero_deviation = 1e-6;  // of a displacement's zero [m]
constexpr double unread_zero = 200e-6;   // where the run begins before the channel was read
constexpr double air_deviation = 0.2;    // [K]
constexpr double mean_moment = 0.25;     // between a programme that runs with the samples, 0, and one that does not
constexpr double mean_moment_deviation = 0.25;
constexpr double moment_deviation = 0.289;  // about that mean, of any moment between two samples: 1/√12
constexpr double clock_deviation = 10.0;    // of one logger's from another's [s]
constexpr double interior_deviation = 0.5;  // of a lump: half of a slab
constexpr double place_deviation = 0.5;     // 3 mm along a bar, a twentieth of the way to a neighbour
constexpr double loop_deviation = 0.02;     // of free growth, as long as loops are what files say

/// A probe's zero is anywhere: where it stood when it was first read, the machine had not moved yet, unless it has a
/// past.
Unknown zero_unknown(MeasuredChannel const& channel, std::size_t index, std::size_t run) {
  auto const& values = channel.values;
  auto const first = std::find_if(values.begin(), values.end(), [](double value) { return !std::isnan(value); });
  return {.kind = Unknown::Kind::offset,
          .name = fmt::format("zero of {}, run {}", channel.name, run + 1),
          .mean = first == values.end() ? 0.0 : *first,
          .deviation = first == values.begin() ? zero_deviation : unread_zero,
          .index = index,
          .run = int(run)};
}

/// Of warmer air, of the whole machine warmer by a kelvin at the start, and of the fields of one that is not at rest.
Eigen::MatrixXd response_to_air_and_start(LinearisedRun const& twin) {
  auto const& network = twin.machine().network();
  auto const air = warmer_air(network);
  auto const none = thermal::lengthened({}, network);
  auto const& warm = twin.data().run->warm_start;
  Eigen::MatrixXd const fields = warm ? warm->fields_in(network) : Eigen::MatrixXd(network.nodes(), 0);
  Eigen::MatrixXd initial = Eigen::MatrixXd::Zero(network.nodes(), 2 + fields.cols());
  initial.col(1).setOnes();
  initial.rightCols(fields.cols()) = fields;
  std::vector<thermal::NetworkDerivative const*> parameters(std::size_t(initial.cols()), &none);
  parameters[0] = &air;
  return twin.response(thermal::ParameterColumns(network, parameters), initial);
}

/// What the channels show more where this course is the machine's.
Eigen::VectorXd response_to(std::shared_ptr<thermal::Course const> const& course, LinearisedRun const& twin) {
  MeasuredRun run = *twin.data().run;
  run.course = course;
  BinnedRun other = twin.data();
  other.run = &run;
  return (LinearisedRun(twin.machine(), other).prediction() - twin.prediction()).reshaped();
}

Eigen::MatrixXd response_to_earlier_changes(LinearisedRun const& twin) {
  std::vector<double> times;
  for (auto const& change : twin.data().run->changes) times.push_back(change.time);
  return twin.response_to_earlier(times);
}

/// Those of loggers that did not record what is switched.
std::vector<std::string> clocks_of(MeasuredRun const& run) {
  std::vector<std::string> clocks;
  for (auto const& channel : run.channels)
    if (!channel.clock.empty() && std::find(clocks.begin(), clocks.end(), channel.clock) == clocks.end())
      clocks.push_back(channel.clock);
  return clocks;
}

/// What the channels of each of them show more where it is a second behind.
Eigen::MatrixXd response_to_clocks(LinearisedRun const& twin) {
  auto const& run = *twin.data().run;
  auto const clocks = clocks_of(run);
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(twin.data().values.size(), Eigen::Index(clocks.size()));
  if (clocks.empty()) return columns;
  Eigen::VectorXd const all = twin.response_to_all_earlier().col(0);
  auto const rows = twin.data().time.size();
  for (std::size_t c = 0; c < run.channels.size(); ++c) {
    auto const clock = std::find(clocks.begin(), clocks.end(), run.channels[c].clock) - clocks.begin();
    if (clock < columns.cols())
      columns.col(clock).segment(Eigen::Index(c) * rows, rows) = all.segment(Eigen::Index(c) * rows, rows);
  }
  return columns;
}

/// What a sensor shows more where its weights are others.
Eigen::VectorXd response_to(SensorPlace const& place, LinearisedRun const& twin, Eigen::VectorXd const& prediction) {
  Machine machine = twin.machine();
  for (auto& sensor : machine.sensors)
    if (sensor.description.name == place.sensor)
      sensor.weights.insert(sensor.weights.end(), place.change.begin(), place.change.end());
  return twin.prediction_of(machine).reshaped() - prediction;
}

}  // namespace

LinearUnknowns::LinearUnknowns(Value const& document, std::vector<BinnedRun> const& data,
                               std::vector<std::string> const& channels, bool drawn,
                               std::vector<ChangedZero> const& zeros)
    : machine_(Machine::build(document)),
      interiors_(document),
      places_(sensor_places(document, machine_)),
      gaps_(loop_gaps(machine_)) {
  add_of_channels(data, channels);
  for (std::size_t r = 0; r < data.size(); ++r) add_of_run(data[r], int(r), drawn);
  add_of_machine();
  Eigen::Index rows = 0;
  std::vector<Eigen::Index> first;
  for (auto const& run : data) {
    first.push_back(rows);
    rows += run.values.size();
  }
  columns_.setZero(rows, Eigen::Index(unknowns_.size()));
  in_parallel(data.size(), [&](std::size_t r) {
    columns_.middleRows(first[r], data[r].values.size()) = columns_of(data[r], int(r), channels);
  });
  add(zeros, data);
}

LinearUnknowns LinearUnknowns::with(std::vector<ChangedZero> const& zeros, std::vector<BinnedRun> const& data) const {
  LinearUnknowns other = *this;
  other.add(zeros, data);
  return other;
}

void LinearUnknowns::add(std::vector<ChangedZero> const& zeros, std::vector<BinnedRun> const& data) {
  if (zeros.empty()) return;
  auto const before = columns_.cols();
  columns_.conservativeResize(Eigen::NoChange, before + Eigen::Index(zeros.size()));
  columns_.rightCols(Eigen::Index(zeros.size())).setZero();
  for (auto const& zero : zeros) {
    auto const place = Eigen::Index(unknowns_.size());
    unknowns_.push_back({.kind = Unknown::Kind::zero,
                         .name = zero.name(data),
                         .deviation = zero.deviation,
                         .index = zeros_.size(),
                         .run = int(zero.run)});
    Eigen::Index row = Eigen::Index(zero.channel) * data[zero.run].time.size();
    for (std::size_t r = 0; r < zero.run; ++r) row += data[r].values.size();
    columns_.col(place).segment(row, data[zero.run].time.size()) = zero.share(data[zero.run]);
    zeros_.push_back(zero);
  }
}

void LinearUnknowns::add_of_channels(std::vector<BinnedRun> const& data, std::vector<std::string> const& channels) {
  for (std::size_t c = 0; c < channels.size(); ++c) {
    bool sensor = false;
    for (std::size_t r = 0; r < data.size(); ++r) {
      auto const& all = data[r].run->channels;
      auto const it = std::find_if(all.begin(), all.end(), [&](auto const& own) { return own.name == channels[c]; });
      if (it == all.end()) continue;
      sensor = sensor || !it->displacement;
      if (it->displacement) unknowns_.push_back(zero_unknown(*it, c, r));
    }
    if (sensor)
      unknowns_.push_back({.kind = Unknown::Kind::offset,
                           .name = "offset of " + channels[c],
                           .deviation = offset_deviation,
                           .index = c});
  }
}

void LinearUnknowns::add_of_run(BinnedRun const& data, int run, bool drawn) {
  using Kind = Unknown::Kind;
  int const number = run + 1;  // as people count
  unknowns_.push_back({.kind = Kind::start,
                       .name = fmt::format("warm start of run {}", number),
                       .deviation = start_deviation,
                       .run = run});
  if (auto const& warm = data.run->warm_start)
    for (Eigen::Index k = 0; k < warm->likely.size(); ++k)
      unknowns_.push_back({.kind = Kind::warmth,
                           .name = fmt::format("warmth {} at the start of run {}", k + 1, number),
                           .mean = -warm->likely[k],
                           .index = std::size_t(k),
                           .run = run});
  unknowns_.push_back(
      {.kind = Kind::air, .name = fmt::format("air in run {}", number), .deviation = air_deviation, .run = run});
  auto const& alternatives = data.run->alternatives;
  for (std::size_t a = 0; a < alternatives.size(); ++a)
    if (drawn || !alternatives[a].for_drawn)
      unknowns_.push_back({.kind = Kind::input,
                           .name = fmt::format("{}, run {}", alternatives[a].name, number),
                           .deviation = alternatives[a].deviation,
                           .index = a,
                           .run = run});
  auto const clocks = clocks_of(*data.run);
  for (std::size_t i = 0; i < clocks.size(); ++i)
    unknowns_.push_back({.kind = Kind::clock,
                         .name = fmt::format("clock of {} behind, run {}", clocks[i], number),
                         .deviation = clock_deviation,
                         .index = i,
                         .run = run});
  auto const& changes = data.run->changes;
  if (!changes.empty())
    unknowns_.push_back({.kind = Kind::moments,
                         .name = fmt::format("changes before their samples, run {}", number),
                         .mean = mean_moment,
                         .deviation = mean_moment_deviation,
                         .run = run});
  for (std::size_t i = 0; i < changes.size(); ++i)
    unknowns_.push_back({.kind = Kind::moment,
                         .name = fmt::format("change before {:.2f} h, run {}", changes[i].time / 3600.0, number),
                         .deviation = moment_deviation * changes[i].earlier,
                         .index = i,
                         .run = run});
}

void LinearUnknowns::add_of_machine() {
  auto const add = [&](Unknown::Kind kind, auto const& all, double deviation) {
    for (std::size_t i = 0; i < all.size(); ++i)
      unknowns_.push_back({.kind = kind, .name = all[i].name, .deviation = deviation, .index = i});
  };
  add(Unknown::Kind::interior, interiors_.unknowns(), interior_deviation);
  add(Unknown::Kind::place, places_, place_deviation);
  add(Unknown::Kind::loop, gaps_, loop_deviation);
}

Eigen::MatrixXd LinearUnknowns::columns_of(BinnedRun const& data, int run,
                                           std::vector<std::string> const& channels) const {
  LinearisedRun const twin(machine_, data);
  Eigen::VectorXd const prediction = twin.prediction().reshaped();
  Eigen::MatrixXd const air_and_start = response_to_air_and_start(twin);
  Eigen::MatrixXd const earlier = response_to_earlier_changes(twin), within = interiors_.responses(data);
  Eigen::MatrixXd const behind = response_to_clocks(twin);
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(data.values.size(), Eigen::Index(unknowns_.size()));
  for (std::size_t u = 0; u < unknowns_.size(); ++u) {
    auto const& unknown = unknowns_[u];
    if (unknown.run >= 0 && unknown.run != run) continue;
    auto const own = Eigen::Index(unknown.index);
    auto column = columns.col(Eigen::Index(u));
    if (unknown.kind == Unknown::Kind::air) column = air_and_start.col(0);
    if (unknown.kind == Unknown::Kind::start) column = air_and_start.col(1);
    if (unknown.kind == Unknown::Kind::warmth) column = air_and_start.col(2 + own);
    if (unknown.kind == Unknown::Kind::moments)
      for (std::size_t i = 0; i < data.run->changes.size(); ++i)
        column += data.run->changes[i].earlier * earlier.col(Eigen::Index(i));
    if (unknown.kind == Unknown::Kind::moment) column = earlier.col(own);
    if (unknown.kind == Unknown::Kind::clock) column = behind.col(own);
    if (unknown.kind == Unknown::Kind::interior) column = within.col(own);
    if (unknown.kind == Unknown::Kind::place) column = response_to(places_[unknown.index], twin, prediction);
    if (unknown.kind == Unknown::Kind::loop) column = twin.growth(gaps_[unknown.index].growth).reshaped();
    if (unknown.kind == Unknown::Kind::input) column = response_to(data.run->alternatives[unknown.index].course, twin);
    if (unknown.kind != Unknown::Kind::offset) continue;
    auto const rows = data.time.size();
    for (std::size_t c = 0; c < data.run->channels.size(); ++c)
      if (data.run->channels[c].name == channels[unknown.index]) column.segment(Eigen::Index(c) * rows, rows).setOnes();
  }
  return columns;
}

}  // namespace thermotwin::twin
