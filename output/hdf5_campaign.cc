#include <algorithm>
#include <fmt/core.h>
#include <hdf5.h>
#include <hdf5_hl.h>
#include <map>
#include <utility>

#include "output/atomic_file.h"
#include "output/campaign_file.h"
#include "output/error.h"
#include "output/hdf5_building.h"
#include "output/hdf5_reading.h"
#include "thermal/error.h"

namespace thermotwin::output {
namespace {

using hdf5::any_text_type;
using hdf5::expect;
using hdf5::Handle;
using hdf5::Shape;
using Kind = CampaignVariable::Kind;

hid_t stored_type(Kind kind) {
  if (kind == Kind::real32) return H5T_IEEE_F32LE;
  return kind == Kind::real64 ? H5T_IEEE_F64LE : H5T_STD_I64LE;
}

hid_t memory_type(Kind kind) {
  if (kind == Kind::real32) return H5T_NATIVE_FLOAT;
  return kind == Kind::real64 ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT64;
}

hsize_t extent(std::int64_t n) { return static_cast<hsize_t>(n); }

/// Runs × axes.
Shape shape_of(CampaignLayout const& layout, CampaignVariable const& variable, std::int64_t runs) {
  Shape shape = {extent(runs)};
  for (auto const& axis : variable.axes) shape.push_back(layout.axis(axis).size());
  return shape;
}

/// The file's groups and scales, and which scales a variable has.
class CampaignFrame {
 public:
  CampaignFrame(hid_t file, CampaignLayout const& layout) : file_(file) {
    hdf5::set_attribute(file, "title", layout.title);
    hdf5::set_attribute(file, "Conventions", std::string("CF-1.8"));
    for (auto const& axis : layout.axes) scales_.emplace(axis.name, make_scale(axis));
  }

  /// The scale of the runs is a variable of another layout in parts and index.
  void set_run_scale(Handle run) {
    expect(H5DSset_scale(run, "run"), "run");
    scales_.emplace("run", std::move(run));
  }

  /// The group that the name begins with, and what is left of it.
  std::pair<hid_t, std::string> place(std::string const& name) {
    auto const slash = name.find('/');
    if (slash == std::string::npos) return {file_, name};
    auto const group = name.substr(0, slash);
    if (!groups_.contains(group)) groups_.emplace(group, hdf5::make_group(file_, group));
    return {groups_.at(group), name.substr(slash + 1)};
  }

  void attach(hid_t variable, std::vector<std::string> const& axes) {
    std::vector<hid_t> scales = {scales_.at("run")};
    for (auto const& axis : axes) scales.push_back(scales_.at(axis));
    hdf5::attach(variable, scales);
  }

 private:
  Handle make_scale(CampaignAxis const& axis) const {
    if (auto const* names = std::get_if<std::vector<std::string>>(&axis.values))
      return hdf5::write_axis(file_, axis.name, *names, axis.long_name);
    return hdf5::write_axis(file_, axis.name, std::get<Eigen::VectorXd>(axis.values), false, axis.unit, axis.long_name);
  }

  hid_t file_;
  std::map<std::string, Handle> scales_, groups_;
};

void const* data_of(CampaignValues const& values) {
  return std::visit([](auto const& list) -> void const* { return list.data(); }, values);
}

void write_failures(hid_t file, CampaignPart const& part) {
  auto const group = hdf5::make_group(file, "failures");
  std::vector<std::int64_t> runs;
  std::vector<char const*> reasons;
  for (auto const& [run, reason] : part.failures) {
    runs.push_back(run);
    reasons.push_back(reason.c_str());
  }
  auto const text = any_text_type();
  auto const of_run = hdf5::make_variable(group, "run", {H5T_STD_I64LE, {runs.size()}}, "1", "number of the run");
  auto const of_reason = hdf5::make_variable(group, "reason", {text, {runs.size()}}, "1", "why it failed");
  if (runs.empty()) return;
  hdf5::store(of_run, H5T_NATIVE_INT64, runs.data());
  hdf5::store(of_reason, text, reasons.data());
}

Handle part_in_memory(CampaignLayout const& layout, CampaignPart const& part) {
  auto file = hdf5::make_file_in_memory();
  CampaignFrame frame(file, layout);
  std::vector<std::int64_t> numbers(static_cast<std::size_t>(part.count));
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = part.first + static_cast<std::int64_t>(i);
  auto run = hdf5::make_variable(file, "run", {H5T_STD_I64LE, {numbers.size()}}, "1", "number of the run");
  hdf5::store(run, H5T_NATIVE_INT64, numbers.data());
  frame.set_run_scale(std::move(run));
  for (std::size_t v = 0; v < layout.variables.size(); ++v) {
    auto const& variable = layout.variables[v];
    auto const [group, name] = frame.place(variable.name);
    auto const made =
        hdf5::make_variable(group, name, {stored_type(variable.kind), shape_of(layout, variable, part.count)},
                            variable.unit, variable.long_name);
    hdf5::store(made, memory_type(variable.kind), data_of(part.values[v]));
    frame.attach(made, variable.axes);
  }
  write_failures(file, part);
  return file;
}

/// A variable of this shape whose rows are those of the parts, one after another.
Handle make_virtual(hid_t group, std::string const& name, std::string const& name_in_part, hid_t type, Shape shape,
                    std::vector<CampaignPartFile> const& parts, CampaignVariable const& words) {
  auto const how = hdf5::dataset_properties();
  auto const whole = hdf5::space_of(shape, shape);
  std::vector<hsize_t> start(shape.size(), 0);
  for (auto const& part : parts) {
    start[0] = extent(part.first);
    shape[0] = extent(part.count);
    auto const source = hdf5::space_of(shape, shape);
    expect(H5Sselect_hyperslab(whole, H5S_SELECT_SET, start.data(), nullptr, shape.data(), nullptr), name);
    expect(H5Pset_virtual(how, whole, part.file.c_str(), name_in_part.c_str(), source), name);
  }
  expect(H5Sselect_all(whole), name);
  Handle variable(H5Dcreate2(group, name.c_str(), type, whole, H5P_DEFAULT, how, H5P_DEFAULT), H5Dclose, name);
  hdf5::set_attribute(variable, "units", words.unit);
  hdf5::set_attribute(variable, "long_name", words.long_name.empty() ? name : words.long_name);
  return variable;
}

void write_texts(hid_t file, std::map<std::string, std::string> const& texts) {
  auto const group = hdf5::make_group(file, "provenance");
  auto const type = any_text_type();
  for (auto const& [key, text] : texts) {
    auto const variable = hdf5::make_variable(group, key, {type, {}}, "1", key);
    char const* const bytes = text.c_str();
    hdf5::store(variable, type, &bytes);
  }
}

Handle index_in_memory(CampaignLayout const& layout, std::vector<CampaignPartFile> const& parts) {
  std::int64_t runs = 0;
  for (auto const& part : parts) runs += part.count;
  auto file = hdf5::make_file_in_memory();
  CampaignFrame frame(file, layout);
  CampaignVariable const run{Kind::whole, "run", "1", "number of the run", {}};
  frame.set_run_scale(make_virtual(file, "run", "/run", H5T_STD_I64LE, {extent(runs)}, parts, run));
  for (auto const& variable : layout.variables) {
    auto const [group, name] = frame.place(variable.name);
    auto const made = make_virtual(group, name, "/" + variable.name, stored_type(variable.kind),
                                   shape_of(layout, variable, runs), parts, variable);
    frame.attach(made, variable.axes);
  }
  write_texts(file, layout.provenance);
  return file;
}

template <class File>
void write(std::filesystem::path const& path, File const& file_in_memory) try {
  hdf5::Silence const silence;
  auto const file = file_in_memory();
  write_atomically(path, hdf5::image_of(file));
} catch (hdf5::Failure const& failure) {
  throw OutputError(fmt::format("'{}' cannot be made: {}", path.string(), failure.what()));
}

}  // namespace

std::size_t CampaignAxis::size() const {
  return std::visit([](auto const& list) { return static_cast<std::size_t>(list.size()); }, values);
}

CampaignAxis const& CampaignLayout::axis(std::string const& name) const {
  return *std::find_if(axes.begin(), axes.end(), [&](auto const& a) { return a.name == name; });
}

std::size_t CampaignLayout::size(CampaignVariable const& variable) const {
  std::size_t size = 1;
  for (auto const& name : variable.axes) size *= axis(name).size();
  return size;
}

void write_part(CampaignLayout const& layout, CampaignPart const& part, std::filesystem::path const& path) {
  write(path, [&] { return part_in_memory(layout, part); });
}

void write_index(CampaignLayout const& layout, std::vector<CampaignPartFile> const& parts,
                 std::filesystem::path const& path) {
  write(path, [&] { return index_in_memory(layout, parts); });
}

std::map<std::int64_t, std::string> read_failures(std::filesystem::path const& part) try {
  hdf5::Silence const silence;
  Handle const file(H5Fopen(part.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "open");
  Handle const runs(H5Dopen2(file, "/failures/run", H5P_DEFAULT), H5Dclose, "failures");
  Handle const space(H5Dget_space(runs), H5Sclose, "failures");
  auto const count = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space));
  std::map<std::int64_t, std::string> failures;
  if (count == 0) return failures;
  std::vector<std::int64_t> numbers(count);
  expect(H5Dread(runs, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()), "runs");
  auto const reasons = hdf5::read_names(file, "/failures/reason");
  for (std::size_t i = 0; i < std::min(count, reasons.size()); ++i) failures[numbers[i]] = reasons[i];
  return failures;
} catch (hdf5::Failure const& failure) {
  throw thermal::InputError(fmt::format("'{}' is no part of a campaign: {}", part.string(), failure.what()));
}

}  // namespace thermotwin::output
