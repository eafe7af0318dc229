#include "twin/reduction_store.h"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <span>
#include <stdexcept>

#include "output/atomic_file.h"
#include "output/checksum.h"
#include "output/error.h"
#include "output/locked_file.h"
#include "twin/fingerprint.h"
#include "twin/node_cores.h"
#include "twin/packed.h"
#include "twin/version.h"

namespace thermotwin::twin {
namespace {

namespace fs = std::filesystem;
using thermal::Reduction;

void add(Fingerprint& print, std::vector<std::pair<int, double>> const& weights) {
  print.add(weights.size());
  for (auto const& [node, weight] : weights) {
    print.add(node);
    print.add(weight);
  }
}

void add(Fingerprint& print, std::vector<std::string> const& names) {
  print.add(names.size());
  for (auto const& name : names) {
    print.add(name);
    print.add('\0');
  }
}

void add(Fingerprint& print, Eigen::MatrixXd const& matrix) {
  print.add(matrix.rows());
  print.add(std::span<double const>(matrix.data(), std::size_t(matrix.size())));
}

void add(Fingerprint& print, thermal::ElementGroup const& group) {
  print.add(group.law->name());
  print.add(group.ports);
  print.add(group.coefficients);
  print.add(group.inputs);
}

void add(Fingerprint& print, thermal::Boundary const& boundary) {
  print.add(boundary.offset);
  print.add(boundary.terms.size());
  for (auto const& term : boundary.terms) {
    print.add(term.channel);
    print.add(term.weight);
  }
}

void add(Fingerprint& print, thermal::Network const& network) {
  print.add(network.capacity());
  print.add(network.capacity_slope());
  print.add(network.signals());
  add(print, network.channel_names());
  for (auto const& group : network.groups()) add(print, group);
  for (auto const& boundary : network.boundaries()) add(print, boundary);
  for (auto const& average : network.averages()) {
    print.add(average.nodes);
    print.add(average.weights);
  }
}

/// At every minute, and where it jumps.
void add(Fingerprint& print, thermal::TrainingRun const& run) {
  print.add(run.initial_temperatures);
  print.add(run.duration);
  std::vector<std::string> names;
  for (auto const& channel : run.course->channels()) names.push_back(channel.name);
  add(print, names);
  std::vector<double> values(names.size());
  double jump = run.course->next_jump(0.0);
  for (double t = 0.0; t <= run.duration; t += 60.0) {
    for (; jump <= t; jump = run.course->next_jump(jump)) {
      print.add(jump);
      run.course->evaluate(jump, values);
      print.add(values);
    }
    run.course->evaluate(t, values);
    print.add(values);
  }
}

void put(std::string& bytes, thermal::Subspace const& subspace) {
  packed::put(bytes, subspace.shapes.rows());
  packed::put_all(bytes, std::span<double const>(subspace.shapes.data(), std::size_t(subspace.shapes.size())));
  packed::put_all(bytes, std::span<thermal::SampledElement const>(subspace.elements));
}

thermal::Subspace take_subspace(packed::Reader& reader) {
  thermal::Subspace subspace;
  auto const rows = reader.take<Eigen::Index>();
  auto const numbers = reader.take_all<double>();
  if (rows <= 0) throw std::out_of_range("shapes without nodes");
  subspace.shapes = Eigen::Map<Eigen::MatrixXd const>(numbers.data(), rows, Eigen::Index(numbers.size()) / rows);
  subspace.elements = reader.take_all<thermal::SampledElement>();
  return subspace;
}

std::string bytes_of(Reduction const& reduction) {
  std::string bytes;
  for (auto const* numbers : {&reduction.reference.temperatures, &reduction.reference.input, &reduction.training_error})
    packed::put_all(bytes, std::span<double const>(*numbers));
  put(bytes, reduction.fine);
  put(bytes, reduction.coarse);
  return bytes;
}

Reduction reduction_of(std::string_view bytes) {
  packed::Reader reader(bytes);
  Reduction reduction;
  for (auto* numbers : {&reduction.reference.temperatures, &reduction.reference.input, &reduction.training_error})
    *numbers = reader.take_all<double>();
  reduction.fine = take_subspace(reader);
  reduction.coarse = take_subspace(reader);
  return reduction;
}

/// What a file begins with; it depends on every byte that follows.
std::string first_line(std::string const& key, std::string_view bytes) {
  return fmt::format("thermotwin reduction {} {:08x}\n", key, output::crc_32(bytes));
}

}  // namespace

std::string reduction_key(thermal::Network const& network, thermal::ReductionTask const& task) {
  Fingerprint print;
  print.add(sources());
  print.add(std::string_view(__VERSION__));
  add(print, network);
  for (auto const& run : task.training) add(print, run);
  for (auto const& sum : task.watched) {
    add(print, sum.weights);
    print.add(sum.tolerance);
  }
  add(print, task.initial_rises);
  print.add(task.share);
  print.add(task.cubature);
  return print.text();
}

fs::path ReductionStore::file(std::string const& key) const { return folder_ / (key + ".reduction"); }

std::optional<Reduction> ReductionStore::find(std::string const& key) const {
  std::ifstream stream(file(key), std::ios::binary);
  std::string head;
  if (!std::getline(stream, head) || stream.eof()) return {};
  std::string bytes(std::size_t(fs::file_size(file(key))) - head.size() - 1, '\0');
  stream.read(bytes.data(), std::streamsize(bytes.size()));
  if (head + '\n' != first_line(key, bytes)) return {};
  try {
    return reduction_of(bytes);
  } catch (std::out_of_range const&) {
    return {};
  }
}

Reduction ReductionStore::find_or_make(std::string const& key, std::function<Reduction()> const& make) const {
  if (auto known = find(key)) return *known;
  std::optional<Reduction> made;
  try {
    output::make_directory(folder_);
    output::LockedFile const lock(folder_ / (key + ".lock"), output::LockedFile::Busy::wait);
    if (auto known = find(key)) return *known;
    {
      NodeCores const all;
      made = make();
    }
    auto const bytes = bytes_of(*made);
    output::write_atomically(file(key), first_line(key, bytes) + bytes);
  } catch (output::OutputError const&) {
    if (!made) made = make();
  }
  return *made;
}

std::optional<fs::path> cache_folder() {
  auto const folder = [](char const* variable) -> std::optional<fs::path> {
    char const* value = std::getenv(variable);
    return value && *value ? std::optional<fs::path>(value) : std::nullopt;
  };
  if (std::getenv("THERMOTWIN_CACHE")) return folder("THERMOTWIN_CACHE");
  if (auto const caches = folder("XDG_CACHE_HOME")) return *caches / "thermotwin";
  if (auto const home = folder("HOME")) return *home / ".cache" / "thermotwin";
  return {};
}

}  // namespace thermotwin::twin
