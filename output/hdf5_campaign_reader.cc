#include <algorithm>
#include <fmt/core.h>
#include <hdf5.h>
#include <hdf5_hl.h>
#include <utility>

#include "output/campaign_file.h"
#include "output/hdf5_handle.h"
#include "output/hdf5_reading.h"
#include "thermal/error.h"

namespace thermotwin::output {
namespace {

using hdf5::expect;
using hdf5::Handle;
using Shape = std::vector<hsize_t>;
using RowMajorXd = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

bool is_group(hid_t file, std::string const& name) {
  H5O_info_t info;
  expect(H5Oget_info_by_name(file, name.c_str(), &info, H5P_DEFAULT), name);
  return info.type == H5O_TYPE_GROUP;
}

Shape shape_of(hid_t space) {
  Shape shape(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
  H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  return shape;
}

/// Every `every`-th row from `first` on.
Eigen::MatrixXd read_rows(hid_t variable, std::string const& name, hsize_t first, hsize_t every) {
  Handle const space(H5Dget_space(variable), H5Sclose, name);
  auto shape = shape_of(space);
  if (shape.empty() || shape[0] <= first) return {};
  Shape start(shape.size(), 0), step(shape.size(), 1);
  start[0] = first;
  step[0] = every;
  shape[0] = (shape[0] - first + every - 1) / every;
  expect(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), step.data(), shape.data(), nullptr), name);
  Handle const memory(H5Screate_simple(int(shape.size()), shape.data(), nullptr), H5Sclose, name);
  hsize_t numbers = 1;
  for (std::size_t i = 1; i < shape.size(); ++i) numbers *= shape[i];
  RowMajorXd values{Eigen::Index(shape[0]), Eigen::Index(numbers)};
  expect(H5Dread(variable, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, values.data()), name);
  return values;
}

CampaignAxis read_axis(hid_t file, hid_t variable, std::string const& name) {
  CampaignAxis axis{name, hdf5::text_attribute(variable, "units"), hdf5::text_attribute(variable, "long_name"), {}};
  Handle const type(H5Dget_type(variable), H5Tclose, name);
  if (H5Tget_class(type) == H5T_STRING)
    axis.values = hdf5::read_names(file, name);
  else
    axis.values = Eigen::VectorXd(read_rows(variable, name, 0, 1));
  return axis;
}

/// Reads one part.
class Reading {
 public:
  Reading(hid_t file, std::int64_t every) : file_(file), every_(hsize_t(every)) {
    Eigen::MatrixXd const numbers = read_rows(hdf5::open_variable(file, "run"), "run", 0, 1);
    auto const before = numbers.size() > 0 ? std::int64_t(numbers(0)) : 0;
    first_ = hsize_t((every - before % every) % every);
    for (auto row = Eigen::Index(first_); row < numbers.rows(); row += every)
      runs_.run.push_back(std::int64_t(numbers(row)));
  }

  CampaignRuns read(std::vector<std::string> const& groups) {
    for (auto const& name : hdf5::names_in(file_)) {
      bool const wanted = std::find(groups.begin(), groups.end(), name) != groups.end();
      if (is_group(file_, name)) {
        if (wanted) read_group(name);
        continue;
      }
      auto const variable = hdf5::open_variable(file_, name);
      if (H5DSis_scale(variable) > 0) {
        if (name != "run") runs_.axes.push_back(read_axis(file_, variable, name));
      } else if (wanted) {
        take(variable, name);
      }
    }
    return std::move(runs_);
  }

 private:
  void read_group(std::string const& name) {
    Handle const group(H5Gopen2(file_, name.c_str(), H5P_DEFAULT), H5Gclose, name);
    for (auto const& inside : hdf5::names_in(group)) take(hdf5::open_variable(group, inside), name + "/" + inside);
  }

  void take(hid_t variable, std::string const& name) {
    CampaignVariable taken;
    taken.name = name;
    taken.unit = hdf5::text_attribute(variable, "units");
    taken.long_name = hdf5::text_attribute(variable, "long_name");
    runs_.variables.push_back(taken);
    runs_.values.push_back(read_rows(variable, name, first_, every_));
  }

  hid_t file_;
  hsize_t every_, first_ = 0;
  CampaignRuns runs_;
};

}  // namespace

Eigen::MatrixXd const* CampaignRuns::find(std::string const& variable) const {
  for (std::size_t v = 0; v < variables.size(); ++v)
    if (variables[v].name == variable && values[v].size() > 0) return &values[v];
  return nullptr;
}

void check_part(CampaignLayout const& layout, std::int64_t first, std::int64_t count,
                std::filesystem::path const& part) try {
  hdf5::Silence const silence;
  auto const refuse = [&](std::string const& why) {
    throw thermal::InputError(fmt::format("'{}' is no whole part of this campaign: {}", part.string(), why));
  };
  Handle const file(H5Fopen(part.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "open");
  Eigen::MatrixXd const runs = read_rows(hdf5::open_variable(file, "run"), "run", 0, 1);
  bool whole = runs.rows() == count && runs.cols() == 1;
  for (Eigen::Index row = 0; whole && row < count; ++row) whole = runs(row) == double(first + row);
  if (!whole) refuse(fmt::format("it does not hold the runs {} to {}", first, first + count - 1));
  for (auto const& variable : layout.variables) {
    Shape due = {hsize_t(count)};
    for (auto const& axis : variable.axes) due.push_back(layout.axis(axis).size());
    Handle const space(H5Dget_space(hdf5::open_variable(file, variable.name)), H5Sclose, variable.name);
    if (shape_of(space) != due) refuse(fmt::format("'{}' has another shape", variable.name));
  }
} catch (hdf5::Failure const& failure) {
  throw thermal::InputError(fmt::format("'{}' is no whole part of this campaign: {}", part.string(), failure.what()));
}

CampaignRuns read_runs(std::filesystem::path const& part, std::vector<std::string> const& groups,
                       std::int64_t every) try {
  hdf5::Silence const silence;
  Handle const file(H5Fopen(part.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "open");
  return Reading(file, every).read(groups);
} catch (hdf5::Failure const& failure) {
  throw thermal::InputError(fmt::format("'{}' is no part of a campaign: {}", part.string(), failure.what()));
}

}  // namespace thermotwin::output
