#include "output/dataset_file.h"

#include <algorithm>
#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <thread>

#include "tests/output/example_dataset.h"
#include "tests/output/temporary_directory.h"
#include "thermal/error.h"

namespace thermotwin::output {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;
using tests::contents;
using tests::example_dataset;
using tests::put;
using tests::TemporaryDirectory;
using thermal::InputError;

template <class Matrix>
bool same(Matrix const& a, Matrix const& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() &&
         std::equal(a.reshaped().begin(), a.reshaped().end(), b.reshaped().begin(),
                    [](auto x, auto y) { return x == y || (x != x && y != y); });
}

void expect_same(std::vector<Channel> const& a, std::vector<Channel> const& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].name, b[i].name);
    EXPECT_EQ(a[i].unit, b[i].unit);
    EXPECT_EQ(a[i].long_name, b[i].long_name);
    EXPECT_TRUE(same(a[i].values, b[i].values)) << a[i].name;
  }
}

void expect_same(std::vector<Positioning> const& a, std::vector<Positioning> const& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].axis, b[i].axis);
    EXPECT_TRUE(same(a[i].position_mm, b[i].position_mm));
    EXPECT_TRUE(same(a[i].time_s, b[i].time_s));
    EXPECT_TRUE(same(a[i].forward_um, b[i].forward_um));
    EXPECT_TRUE(same(a[i].backward_um, b[i].backward_um));
  }
}

void expect_same(Dataset const& a, Dataset const& b) {
  EXPECT_EQ(a.title, b.title);
  EXPECT_EQ(a.complete, b.complete);
  EXPECT_TRUE(same(a.time_s, b.time_s));
  expect_same(a.inputs, b.inputs);
  expect_same(a.readings, b.readings);
  expect_same(a.displacements, b.displacements);
  expect_same(a.positioning, b.positioning);
  expect_same(a.truth_readings, b.truth_readings);
  expect_same(a.truth_displacements, b.truth_displacements);
  expect_same(a.truth_positioning, b.truth_positioning);
  expect_same(a.heat, b.heat);
  ASSERT_EQ(a.node_temperatures.has_value(), b.node_temperatures.has_value());
  if (a.node_temperatures) {
    EXPECT_TRUE(same(*a.node_temperatures, *b.node_temperatures));
  }
  EXPECT_EQ(a.node_names, b.node_names);
  EXPECT_EQ(a.provenance, b.provenance);
}

TEST(DatasetFile, GivesBackWhatWasWritten) {
  TemporaryDirectory const directory;
  for (Eigen::Index const rows : {0, 1, 50, 5000}) {
    Dataset const dataset = example_dataset(rows);
    write(dataset, directory / "run.h5");
    expect_same(read(directory / "run.h5"), dataset);
  }
}

TEST(DatasetFile, GivesBackAMeasuredRunWithoutTruth) {
  TemporaryDirectory const directory;
  Dataset measured;
  measured.title = "measured";
  measured.time_s = Eigen::Vector2d(0.0, 60.0);
  measured.readings = {{"T1", "degC", "bearing", Eigen::Vector2d(20.0, 21.0)}};
  write(measured, directory / "run.h5");
  expect_same(read(directory / "run.h5"), measured);
}

TEST(DatasetFile, SameDataSameBytes) {
  Dataset const dataset = example_dataset();
  std::string const first = to_hdf5(dataset);
  static_cast<void>(to_hdf5(example_dataset(7)));
  EXPECT_TRUE(first == to_hdf5(dataset));
}

TEST(DatasetFile, StaysSmall) {
  Dataset dataset;
  dataset.time_s = Eigen::VectorXd::LinSpaced(2881, 0.0, 28800.0);
  for (int i = 0; i < 60; ++i)
    dataset.readings.push_back({"T" + std::to_string(i), "degC", "", Eigen::VectorXd::Constant(2881, 20.0)});
  EXPECT_LT(to_hdf5(dataset).size(), 200'000u);
}

/// Debian's xarray is the judge of whether others can open the file; warnings are errors.
int run_python(TemporaryDirectory const& directory, std::string const& script) {
  put(directory / "check.py", script);
  return std::system(("cd '" + directory.path().string() + "' && /usr/bin/python3 -W error check.py").c_str());
}

TEST(DatasetFile, OpensInXarray) {
  TemporaryDirectory const directory;
  write(example_dataset(), directory / "run.h5");
  EXPECT_EQ(run_python(directory, R"(
import numpy as np, xarray as xr

def open_group(name=None):
    return xr.open_dataset("run.h5", engine="h5netcdf", group=name).load()

root = open_group()
assert root.attrs["title"] == "warm-up at 4000 rpm, 20 °C", root.attrs
assert root.attrs["source"] == "ThermoTwin 0.1.0" and root.attrs["Conventions"] == "CF-1.8"
assert root.attrs["complete"] == 1
assert root.time.dims == ("time",) and root.time.units == "s" and root.time.long_name
assert np.allclose(root.time, 10.0 * np.arange(50)), root.time
assert root.time.dtype == np.float64

readings = open_group("readings")
assert set(readings.data_vars) == {"T1", "T2", "T10"}
assert readings.T2.dims == ("time",) and readings.T2.units == "degC" and readings.T2.long_name == "example of T2"
assert np.isnan(readings.T2[1]) and np.isfinite(readings.T2[2])
assert abs(readings.T1.sel(time=20.0).item() - 26.0 * np.sin(0.2) - 1.0 / 5.0) < 1e-12

units = {"inputs": {"spindle.speed": "rpm", "ambient.temperature": "degC"}, "displacements": {"E_Z": "um", "A": "urad"},
         "truth/readings": {"T2": "degC"}, "truth/displacements": {"E_Z": "um"}, "heat": {"bearing.front": "W"}}
for group, expected in units.items():
    data = open_group(group)
    assert {name: variable.units for name, variable in data.data_vars.items()} == expected, group
    assert all(variable.long_name and variable.dims == ("time",) for variable in data.values())
    assert data.time.size == 50

for group in ("positioning/z", "truth/positioning/z"):
    z = open_group(group)
    assert z.forward.dims == ("pass_time", "position") and z.forward.units == "um"
    assert z.position.units == "mm" and list(z.position) == [0.0, 200.0, 400.0] and list(z.pass_time) == [0.0, 900.0]
    assert abs((z.backward - z.forward - 0.5)).max() < 1e-9
assert abs(z.forward.sel(pass_time=900.0, position=400.0).item() - 2e-3 * 901.0 * 400.0) < 1e-9

nodes = open_group("nodes")
assert nodes.temperature.dims == ("time", "node") and nodes.temperature.shape == (50, 3)
assert nodes.temperature.units == "degC" and nodes.temperature.dtype == np.float32
assert list(nodes.node.values) == ["bed", "Säule/oben", "spindle[0]"], nodes.node

provenance = open_group("provenance")
assert provenance.attrs["seed"] == "7" and len(provenance.attrs["machine"]) == 59000
assert len(provenance.experiment.item()) == 200000
)"),
            0);
}

TEST(DatasetFile, IsKnownAsPartialInXarray) {
  TemporaryDirectory const directory;
  Dataset partial = example_dataset();
  partial.complete = false;
  write(partial, directory / "run.h5");
  EXPECT_FALSE(read(directory / "run.h5").complete);
  EXPECT_EQ(run_python(directory, R"(
import xarray as xr
assert xr.open_dataset("run.h5", engine="h5netcdf").attrs["complete"] == 0
)"),
            0);
}

TEST(DatasetFile, ReadsWhatH5pyChanged) {
  TemporaryDirectory const directory;
  write(example_dataset(), directory / "run.h5");
  EXPECT_EQ(run_python(directory, R"(
import h5py
with h5py.File("run.h5", "r+") as file:
    file.attrs["title"] = "changed"
    file["readings/T1"].attrs["units"] = "K"
    file["readings/T1"][0] = 300.0
)"),
            0);
  Dataset const changed = read(directory / "run.h5");
  EXPECT_EQ(changed.title, "changed");
  EXPECT_EQ(changed.readings[1].unit, "K");
  EXPECT_EQ(changed.readings[1].values[0], 300.0);
}

auto reading(std::filesystem::path const& path) {
  return [path] { static_cast<void>(read(path)); };
}

TEST(DatasetFile, RefusesWhatIsNoDataSet) {
  TemporaryDirectory const directory;
  EXPECT_THAT(reading(directory / "no.h5"),
              ThrowsMessage<InputError>(HasSubstr("no.h5' cannot be read as a data set: no such file")));
  EXPECT_THAT(reading(directory.path()), ThrowsMessage<InputError>(HasSubstr("it is not a file")));
  put(directory / "text.h5", "time_s,T1_degC\n0,20\n");
  EXPECT_THAT(reading(directory / "text.h5"), ThrowsMessage<InputError>(HasSubstr("it is not an HDF5 file")));
  put(directory / "empty.h5", "");
  EXPECT_THAT(reading(directory / "empty.h5"), ThrowsMessage<InputError>(HasSubstr("it is not an HDF5 file")));
}

TEST(DatasetFile, RefusesHdf5OfOthers) {
  TemporaryDirectory const directory;
  ASSERT_EQ(run_python(directory, R"(
import h5py, numpy
with h5py.File("foreign.h5", "w") as file: file["temperature"] = numpy.zeros(3)
with h5py.File("matrix.h5", "w") as file: file["time"] = numpy.zeros((3, 2))
with h5py.File("short.h5", "w") as file:
    file["time"] = numpy.arange(3.0)
    file["readings/T1"] = numpy.zeros(2)
with h5py.File("backwards.h5", "w") as file: file["time"] = numpy.array([0.0, 2.0, 1.0])
with h5py.File("words.h5", "w") as file: file["time"] = ["now", "then"]
)"),
            0);
  EXPECT_THAT(reading(directory / "foreign.h5"), ThrowsMessage<InputError>(HasSubstr("without a variable 'time'")));
  EXPECT_THAT(reading(directory / "matrix.h5"), ThrowsMessage<InputError>(HasSubstr("'time' has 2 dimensions")));
  EXPECT_THAT(reading(directory / "short.h5"),
              ThrowsMessage<InputError>(HasSubstr("readings: 'T1' has 2 values, expected 3")));
  EXPECT_THAT(reading(directory / "backwards.h5"), ThrowsMessage<InputError>(HasSubstr("1 s follows 2 s")));
  EXPECT_THAT(reading(directory / "words.h5"), ThrowsMessage<InputError>(HasSubstr("words.h5' cannot be read")));
}

TEST(DatasetFile, RefusesEveryTruncation) {
  TemporaryDirectory const directory;
  std::string const whole = to_hdf5(example_dataset());
  for (std::size_t part = 1; part < 40; ++part) {
    put(directory / "cut.h5", whole.substr(0, whole.size() * part / 40));
    testing::internal::CaptureStderr();
    EXPECT_THAT(reading(directory / "cut.h5"), ThrowsMessage<InputError>(HasSubstr("cut.h5' cannot be read")));
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  }
  EXPECT_THAT(reading(directory / "cut.h5"), ThrowsMessage<InputError>(HasSubstr("truncated file")));
}

/// As `view` does, which reads on a thread of its server.
TEST(DatasetFile, DamagedOnAnotherThreadLetsTheLibraryEnd) {
  TemporaryDirectory const directory;
  write(example_dataset(), directory / "run.h5");
  put(directory / "cut.h5", contents(directory / "run.h5").substr(0, 20'000));
  auto const end = [&] {
    std::thread([&] { EXPECT_ANY_THROW(static_cast<void>(read(directory / "cut.h5"))); }).join();
    std::exit(0);
  };
  EXPECT_EXIT(end(), testing::ExitedWithCode(0), testing::Not(HasSubstr("HDF5")));
}

TEST(DatasetFile, RefusesDataThatDoNotFit) {
  TemporaryDirectory const directory;
  put(directory / "run.h5", "old");
  auto const writing = [&](auto const& change) {
    return [&directory, change] {
      Dataset dataset = example_dataset();
      change(dataset);
      write(dataset, directory / "run.h5");
    };
  };
  EXPECT_THAT(writing([](Dataset& d) { d.readings[0].values.conservativeResize(3); }),
              ThrowsMessage<InputError>(HasSubstr("readings: 'T2' has 3 values, expected 50")));
  EXPECT_THAT(writing([](Dataset& d) { d.time_s[4] = d.time_s[3]; }),
              ThrowsMessage<InputError>(HasSubstr("30 s follows 30 s")));
  EXPECT_THAT(writing([](Dataset& d) { d.time_s[4] = NAN; }), ThrowsMessage<InputError>(HasSubstr("must be finite")));
  EXPECT_THAT(writing([](Dataset& d) { d.readings[0].name = "T1"; }),
              ThrowsMessage<InputError>(HasSubstr("readings: 'T1' is there twice")));
  EXPECT_THAT(writing([](Dataset& d) { d.heat[0].name = "a/b"; }), ThrowsMessage<InputError>(HasSubstr("'a/b'")));
  EXPECT_THAT(writing([](Dataset& d) { d.inputs[0].name = "time"; }), ThrowsMessage<InputError>(HasSubstr("'time'")));
  EXPECT_THAT(writing([](Dataset& d) { d.positioning[0].forward_um.resize(2, 2); }),
              ThrowsMessage<InputError>(HasSubstr("axis 'z', targets has 2 values, expected 3")));
  EXPECT_THAT(writing([](Dataset& d) { d.node_names.pop_back(); }),
              ThrowsMessage<InputError>(HasSubstr("node temperatures, nodes has 3 values, expected 2")));
  EXPECT_EQ(contents(directory / "run.h5"), "old");
  EXPECT_THAT(directory.files(), ElementsAre("run.h5"));
}

}  // namespace
}  // namespace thermotwin::output
