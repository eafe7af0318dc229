#include <chrono>
#include <csignal>
#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "output/dataset_file.h"
#include "output/error.h"
#include "tests/output/temporary_directory.h"
#include "thermal/error.h"

namespace thermotwin::output {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;
using testing::UnorderedElementsAre;
using tests::contents;
using tests::put;
using tests::TemporaryDirectory;
using thermal::InputError;
using Seconds = std::chrono::duration<double>;

constexpr Seconds never(1e9);
constexpr Seconds always(0);

Dataset head() {
  Dataset dataset;
  dataset.title = "growing";
  dataset.inputs = {{"spindle.speed", "rpm", "speed", {}}};
  dataset.readings = {{"T1", "degC", "front", {}}, {"T2", "degC", "rear", {}}};
  dataset.truth_readings = {{"T1", "degC", "front", {}}};
  dataset.node_names = {"a", "b"};
  dataset.node_temperatures = Eigen::MatrixXf(0, 2);
  dataset.provenance = {{"seed", "7"}};
  return dataset;
}

/// Every value tells its row, so that a reader can check what it gets.
Row row_at(int i) {
  Row row;
  row.time_s = i;
  row.inputs = Eigen::VectorXd::Constant(1, 1.0 * i);
  row.readings = Eigen::Vector2d(2.0 * i, 3.0 * i);
  row.truth_readings = Eigen::VectorXd::Constant(1, 4.0 * i);
  row.node_temperatures = Eigen::VectorXf{{static_cast<float>(i), static_cast<float>(-i)}};
  return row;
}

void expect_first_rows(Dataset const& dataset, Eigen::Index rows) {
  Eigen::VectorXd const i = Eigen::VectorXd::LinSpaced(rows, 0.0, static_cast<double>(rows - 1));
  ASSERT_EQ(dataset.time_s.size(), rows);
  EXPECT_EQ(dataset.time_s, i);
  EXPECT_EQ(dataset.inputs[0].values, i);
  EXPECT_EQ(dataset.readings[1].values, 3.0 * i);
  EXPECT_EQ(dataset.truth_readings[0].values, 4.0 * i);
  EXPECT_EQ(dataset.node_temperatures->col(1), -i.cast<float>());
}

TEST(DatasetWriter, WritesTheSameBytesAsTheWholeAtOnce) {
  TemporaryDirectory const directory;
  DatasetWriter seldom(directory / "seldom.h5", head(), never);
  DatasetWriter often(directory / "often.h5", head(), always);
  for (int i = 0; i < 600; ++i) seldom.append(row_at(i));
  for (int i = 0; i < 600; ++i) often.append(row_at(i));
  Dataset const whole = seldom.finish({{"energy balance", "1e-12"}});
  often.finish({{"energy balance", "1e-12"}});
  expect_first_rows(whole, 600);
  EXPECT_EQ(whole.provenance.at("energy balance"), "1e-12");
  EXPECT_EQ(whole.provenance.at("seed"), "7");
  EXPECT_TRUE(whole.complete);
  EXPECT_TRUE(contents(directory / "seldom.h5") == contents(directory / "often.h5"));
  EXPECT_TRUE(contents(directory / "seldom.h5") == to_hdf5(whole));
  EXPECT_THAT(directory.files(), UnorderedElementsAre("seldom.h5", "often.h5"));
}

TEST(DatasetWriter, KeepsTheOldFileUntilFinished) {
  TemporaryDirectory const directory;
  put(directory / "run.h5", "old");
  DatasetWriter writer(directory / "run.h5", head(), always);
  writer.append(row_at(0));
  EXPECT_EQ(contents(directory / "run.h5"), "old");
  Dataset const partial = read(writer.partial_path());
  EXPECT_FALSE(partial.complete);
  expect_first_rows(partial, 1);
  writer.finish();
  EXPECT_TRUE(read(directory / "run.h5").complete);
}

TEST(DatasetWriter, LeavesTheRowsOfAFailedRun) {
  TemporaryDirectory const directory;
  {
    DatasetWriter writer(directory / "run.h5", head(), never);
    for (int i = 0; i < 300; ++i) writer.append(row_at(i));
  }
  EXPECT_THAT(directory.files(), ElementsAre("run.h5.partial"));
  Dataset const partial = read(directory / "run.h5.partial");
  EXPECT_FALSE(partial.complete);
  expect_first_rows(partial, 300);
}

TEST(DatasetWriter, TakesThePlaceOfAnInterruptedRunAndOfNothingElse) {
  TemporaryDirectory const directory;
  auto const partial = directory / "run.h5.partial";
  {
    DatasetWriter writer(directory / "run.h5", head(), always);
    writer.append(row_at(0));
  }
  DatasetWriter(directory / "run.h5", head(), always).finish();
  EXPECT_THAT(directory.files(), ElementsAre("run.h5"));
  auto const expect_refusal = [&](std::string const& theirs) {
    put(partial, theirs);
    EXPECT_THAT([&] { DatasetWriter(directory / "run.h5", head()); },
                ThrowsMessage<OutputError>(HasSubstr("run.h5.partial' is not what an interrupted run left")));
    EXPECT_EQ(contents(partial), theirs);
  };
  expect_refusal("mine");
  expect_refusal(contents(directory / "run.h5"));
}

TEST(DatasetWriter, LeavesWhatWasThereWhenThereIsNoRow) {
  TemporaryDirectory const directory;
  { DatasetWriter const writer(directory / "run.h5", head()); }
  EXPECT_THAT(directory.files(), IsEmpty());
  {
    DatasetWriter interrupted(directory / "run.h5", head(), always);
    interrupted.append(row_at(0));
  }
  auto const rows = contents(directory / "run.h5.partial");
  { DatasetWriter const refused(directory / "run.h5", head()); }
  EXPECT_EQ(contents(directory / "run.h5.partial"), rows);
}

TEST(DatasetWriter, RefusesADirectoryThatIsNotThereAtOnce) {
  TemporaryDirectory const directory;
  EXPECT_THAT([&] { DatasetWriter(directory / "no/run.h5", head()); },
              ThrowsMessage<OutputError>(HasSubstr("No such file or directory")));
  EXPECT_THAT([&] { DatasetWriter(directory.path(), head()); },
              ThrowsMessage<OutputError>(HasSubstr("it is a directory")));
}

TEST(DatasetWriter, RefusesRowsThatDoNotFit) {
  TemporaryDirectory const directory;
  DatasetWriter writer(directory / "run.h5", head());
  writer.append(row_at(5));
  EXPECT_THAT([&] { writer.append(row_at(5)); }, ThrowsMessage<InputError>(HasSubstr("5 s follows 5 s")));
  Row narrow = row_at(6);
  narrow.readings = Eigen::VectorXd::Zero(1);
  EXPECT_THAT([&] { writer.append(narrow); },
              ThrowsMessage<InputError>(HasSubstr("1 values for 2 channels of readings")));
  Row nodeless = row_at(6);
  nodeless.node_temperatures.resize(0);
  EXPECT_THAT([&] { writer.append(nodeless); },
              ThrowsMessage<InputError>(HasSubstr("0 node temperatures for 2 nodes")));
}

TEST(DatasetWriter, TakesWhatTheInstrumentsShowedAtTheEnd) {
  TemporaryDirectory const directory;
  DatasetWriter writer(directory / "run.h5", head());
  for (int i = 0; i < 3; ++i) writer.append(row_at(i));
  Channel measured{"T1", "degC", "front", Eigen::Vector2d(20.0, 21.0)};
  EXPECT_THAT([&] { writer.set_measured({measured}, {}, {}); },
              ThrowsMessage<InputError>(HasSubstr("'T1' has 2 values for 3 rows")));
  measured.values = Eigen::Vector3d(20.0, 21.0, 22.0);
  writer.set_measured({measured}, {}, {});
  writer.finish();
  EXPECT_EQ(read(directory / "run.h5").readings[0].values, measured.values);
}

/// Appends rows until it is killed.
pid_t start_endless_run(std::filesystem::path const& path) {
  pid_t const child = fork();
  if (child != 0) return child;
  DatasetWriter writer(path, head(), always);
  for (int i = 0;; ++i) writer.append(row_at(i));
}

TEST(DatasetWriter, KilledAtAnyMomentLeavesTheOldFileAndAReadablePartialOne) {
  TemporaryDirectory const directory;
  std::mt19937 random(7);
  std::uniform_int_distribution<int> milliseconds(0, 120);
  int readable = 0;
  for (int run = 0; run < 30; ++run) {
    auto const name = "run_" + std::to_string(run) + ".h5";
    put(directory / name, "old");
    auto const partial = directory / (name + ".partial");
    pid_t const child = start_endless_run(directory / name);
    if (run % 3 > 0)  // two of three live to see their first row, however slow the machine
      while (!std::filesystem::exists(partial)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds(random)));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    EXPECT_EQ(contents(directory / name), "old");
    if (!std::filesystem::exists(partial)) continue;  // killed before the run began
    ++readable;
    Dataset const rows = read(partial);
    EXPECT_FALSE(rows.complete);
    expect_first_rows(rows, rows.time_s.size());
  }
  EXPECT_GE(readable, 20);
  put(directory / "check.py", R"(
import glob, h5py, numpy, xarray
for name in glob.glob("*.partial"):
    with xarray.open_dataset(name, engine="h5netcdf") as root: assert root.attrs["complete"] == 0
    with xarray.open_dataset(name, engine="h5netcdf", group="readings") as data:
        assert numpy.array_equal(data.T2, 3.0 * numpy.arange(data.time.size)), data
    with h5py.File(name) as file: assert file["nodes/temperature"].shape == (file["time"].size, 2)
)");
  EXPECT_EQ(std::system(("cd '" + directory.path().string() + "' && /usr/bin/python3 -W error check.py").c_str()), 0);
}

}  // namespace
}  // namespace thermotwin::output
