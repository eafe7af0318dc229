#include "output/campaign_file.h"

#include <gtest/gtest.h>
#include <hdf5.h>

#include "output/dataset_file.h"
#include "tests/output/temporary_directory.h"
#include "tests/scenarios/refusal.h"
#include "thermal/error.h"

namespace thermotwin::output {
namespace {

using Kind = CampaignVariable::Kind;

/// Two sensors, three times.
CampaignLayout layout() {
  CampaignLayout layout;
  layout.title = "example";
  layout.axes = {{"time", "s", "time", Eigen::VectorXd::LinSpaced(3, 0.0, 120.0)},
                 {"reading", "1", "sensor", std::vector<std::string>{"T1", "T2"}}};
  layout.variables = {{Kind::whole, "seed", "1", "", {}},
                      {Kind::real64, "parameters/a.b", "W/K", "", {}},
                      {Kind::real32, "readings", "degC", "", {"time", "reading"}}};
  layout.provenance = {{"campaign.file", "experiments = []\n"}};
  return layout;
}

float reading(std::int64_t run, int row, int channel) { return float(100 * run + 10 * row + channel); }

CampaignPart part(std::int64_t first, std::int64_t count) {
  CampaignPart part{first, count, {}, {}};
  std::vector<std::int64_t> seeds;
  std::vector<double> values;
  std::vector<float> readings;
  for (auto run = first; run < first + count; ++run) {
    seeds.push_back(1000 + run);
    values.push_back(0.1 * double(run));
    for (int row = 0; row < 3; ++row)
      for (int channel = 0; channel < 2; ++channel) readings.push_back(reading(run, row, channel));
  }
  part.values = {seeds, values, readings};
  return part;
}

template <class T>
std::vector<T> read(std::filesystem::path const& path, char const* name, hid_t type, std::vector<hsize_t> const& due) {
  hid_t const file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), set = H5Dopen2(file, name, H5P_DEFAULT);
  hid_t const space = H5Dget_space(set);
  std::vector<hsize_t> shape(due.size());
  EXPECT_EQ(H5Sget_simple_extent_ndims(space), int(due.size()));
  H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  EXPECT_EQ(shape, due);
  std::vector<T> values(std::size_t(H5Sget_simple_extent_npoints(space)));
  EXPECT_GE(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
  H5Sclose(space);
  H5Dclose(set);
  H5Fclose(file);
  return values;
}

TEST(CampaignFile, TheIndexShowsAllPartsAsOne) {
  tests::TemporaryDirectory const directory;
  std::filesystem::create_directory(directory / "parts");
  write_part(layout(), part(0, 4), directory / "parts/0.h5");
  write_part(layout(), part(4, 3), directory / "parts/1.h5");
  write_index(layout(), {{"parts/0.h5", 0, 4}, {"parts/1.h5", 4, 3}}, directory / "campaign.h5");
  // Opened from another folder: the parts are found beside the index.
  auto const whole = directory / "campaign.h5";
  auto const readings = read<float>(whole, "/readings", H5T_NATIVE_FLOAT, {7, 3, 2});
  for (int run = 0; run < 7; ++run)
    for (int row = 0; row < 3; ++row)
      for (int channel = 0; channel < 2; ++channel)
        EXPECT_EQ(readings[std::size_t(6 * run + 2 * row + channel)], reading(run, row, channel));
  EXPECT_EQ(read<std::int64_t>(whole, "/run", H5T_NATIVE_INT64, {7}), (std::vector<std::int64_t>{0, 1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(read<std::int64_t>(whole, "/seed", H5T_NATIVE_INT64, {7})[6], 1006);
  EXPECT_EQ(read<double>(whole, "/parameters/a.b", H5T_NATIVE_DOUBLE, {7})[5], 0.5);
  EXPECT_EQ(read<double>(whole, "/time", H5T_NATIVE_DOUBLE, {3})[2], 120.0);
}

TEST(CampaignFile, RunsAreReadBackAllOrSome) {
  tests::TemporaryDirectory const directory;
  write_part(layout(), part(4, 5), directory / "part.h5");
  auto const all = read_runs(directory / "part.h5", {"seed", "parameters", "readings"});
  EXPECT_EQ(all.run, (std::vector<std::int64_t>{4, 5, 6, 7, 8}));
  ASSERT_EQ(all.axes.size(), 2U);
  EXPECT_EQ(std::get<Eigen::VectorXd>(all.axes[0].values), Eigen::Vector3d(0.0, 60.0, 120.0));
  EXPECT_EQ(std::get<std::vector<std::string>>(all.axes[1].values), (std::vector<std::string>{"T1", "T2"}));
  EXPECT_EQ((*all.find("seed"))(2), 1006.0);
  EXPECT_EQ((*all.find("parameters/a.b"))(1), 0.5);
  ASSERT_EQ(all.find("readings")->cols(), 6);
  for (int row = 0; row < 3; ++row)
    for (int channel = 0; channel < 2; ++channel)
      EXPECT_EQ((*all.find("readings"))(3, 2 * row + channel), double(reading(7, row, channel)));

  auto const some = read_runs(directory / "part.h5", {"readings"}, 3);
  EXPECT_EQ(some.run, (std::vector<std::int64_t>{6}));  // of 0, 3, 6, 9, … those that are here
  EXPECT_EQ((*some.find("readings"))(0, 5), double(reading(6, 2, 1)));
  EXPECT_EQ(some.find("seed"), nullptr);
  EXPECT_EQ(read_runs(directory / "part.h5", {"readings"}, 100).find("readings"), nullptr);
  tests::put(directory / "none.h5", "no HDF5");
  EXPECT_THROW(static_cast<void>(read_runs(directory / "none.h5", {})), thermal::InputError);
}

/// Neither a part nor the whole.
TEST(CampaignFile, IsNoDataSetAndSaysHowToGetOne) {
  tests::TemporaryDirectory const directory;
  write_part(layout(), part(0, 4), directory / "0.h5");
  write_index(layout(), {{"0.h5", 0, 4}}, directory / "campaign.h5");
  for (std::string const file : {"0.h5", "campaign.h5"})
    EXPECT_EQ(tests::refusal([&] { static_cast<void>(output::read(directory / file)); }),
              "'" + (directory / file).string() +
                  "' cannot be read as a data set: it holds the runs of a campaign, for xarray and the like; "
                  "`thermotwin campaign CAMPAIGN --show N` prints the command that makes run N a data set of its own, "
                  "and `thermotwin report DIR` shows them all");
}

TEST(CampaignFile, APartIsCheckedForItsRunsAndVariables) {
  tests::TemporaryDirectory const directory;
  write_part(layout(), part(3, 2), directory / "part.h5");
  auto const said = [&](CampaignLayout const& due, std::int64_t first, std::int64_t count) {
    return tests::refusal([&] { check_part(due, first, count, directory / "part.h5"); });
  };
  auto const has = [](std::string const& text, std::string const& words) {
    return text.find("part.h5' is no whole part of this campaign: " + words) != std::string::npos;
  };
  EXPECT_EQ(said(layout(), 3, 2), "accepted");
  EXPECT_TRUE(has(said(layout(), 4, 2), "it does not hold the runs 4 to 5")) << said(layout(), 4, 2);
  EXPECT_TRUE(has(said(layout(), 3, 3), "it does not hold the runs 3 to 5")) << said(layout(), 3, 3);
  auto more = layout(), longer = layout();
  more.variables.push_back({Kind::whole, "rows", "1", "", {}});
  longer.axes[0].values = Eigen::VectorXd(Eigen::VectorXd::LinSpaced(4, 0.0, 180.0));
  EXPECT_TRUE(has(said(more, 3, 2), "rows")) << said(more, 3, 2);
  EXPECT_TRUE(has(said(longer, 3, 2), "'readings' has another shape")) << said(longer, 3, 2);
  tests::put(directory / "part.h5", "junk");
  EXPECT_TRUE(has(said(layout(), 3, 2), "")) << said(layout(), 3, 2);
}

TEST(CampaignFile, FailuresAreReadBack) {
  tests::TemporaryDirectory const directory;
  auto failed = part(4, 3);
  failed.failures = {{5, "the integration stopped at 3 s"}, {6, "ä µ"}};
  write_part(layout(), failed, directory / "part.h5");
  EXPECT_EQ(read_failures(directory / "part.h5"), failed.failures);
  write_part(layout(), part(4, 3), directory / "part.h5");
  EXPECT_TRUE(read_failures(directory / "part.h5").empty());
  tests::put(directory / "none.h5", "no HDF5");
  EXPECT_THROW(static_cast<void>(read_failures(directory / "none.h5")), thermal::InputError);
}

TEST(CampaignFile, SamePartSameBytes) {
  tests::TemporaryDirectory const directory;
  for (auto const* name : {"a.h5", "b.h5"}) write_part(layout(), part(0, 4), directory / name);
  EXPECT_TRUE(tests::contents(directory / "a.h5") == tests::contents(directory / "b.h5"));
}

}  // namespace
}  // namespace thermotwin::output
