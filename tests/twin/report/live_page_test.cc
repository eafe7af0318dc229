#include "twin/report/live_page.h"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "output/dataset_file.h"
#include "output/journal.h"
#include "output/report_page.h"
#include "tests/output/page_reader.h"
#include "tests/output/temporary_directory.h"
#include "tests/twin/report/example_campaign.h"
#include "thermal/error.h"
#include "twin/progress_file.h"

namespace thermotwin::twin {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using tests::TemporaryDirectory;

output::Dataset head() {
  output::Dataset data;
  data.title = "growing";
  data.readings = {{"T1", "degC", "nose", {}}};
  data.truth_readings = data.readings;
  return data;
}

output::Row row(double time) {
  output::Row row;
  row.time_s = time;
  row.readings = Eigen::VectorXd::Constant(1, std::nan(""));
  row.truth_readings = Eigen::VectorXd::Constant(1, 20.0 + time / 60.0);
  return row;
}

/// The document that a page which has this revision is given.
nlohmann::json news(LivePage& page, std::uint64_t after) {
  auto const text = page.news(after);
  return text ? nlohmann::json::parse(*text)["document"] : nlohmann::json();
}

class Live : public testing::Test {
 protected:
  TemporaryDirectory folder;
};

TEST_F(Live, WaitsForWhatIsNotThereYet) {
  LivePage page({folder / "run.h5"});
  tests::PageReader const read(page.html());
  EXPECT_THAT(read.document["sections"][0]["title"].get<std::string>(), HasSubstr("run.h5 yet"));
  EXPECT_EQ(read.document["revision"], 1);
  EXPECT_FALSE(page.news(1));
}

TEST_F(Live, RefusesWhatCanNeverBeShown) {
  auto const refusal = [](fs::path const& path) {
    try {
      LivePage const page({path});
    } catch (thermal::InputError const& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  EXPECT_THAT(refusal(folder / "nope.txt"), HasSubstr("nope.txt is neither a data set (.h5, .csv, .toml) nor"));
  EXPECT_THAT(refusal(folder / "nowhere" / "run.h5"), testing::EndsWith("nowhere"));
  tests::put(folder / "notes", "");
  EXPECT_THAT(refusal(folder / "notes"), HasSubstr("notes is neither"));
  for (char const* name : {"run.h5", "study", "found.json"}) EXPECT_EQ(refusal(folder / name), "nothing");
}

TEST_F(Live, FollowsARunFromItsFirstRowToItsEnd) {
  LivePage page({folder / "run.h5"});
  output::DatasetWriter writer(folder / "run.h5", head(), std::chrono::seconds(0));
  writer.append(row(60.0));
  writer.append(row(120.0));
  auto const going = news(page, 0);
  auto const& set = going["sections"][0]["sets"][0];
  EXPECT_EQ(set["name"], "run");
  EXPECT_FALSE(set["complete"]);
  EXPECT_EQ(set["time"]["shape"][0], 2);
  EXPECT_THAT(going["sections"][0]["remarks"].dump(), HasSubstr("without their noise"));
  auto const revision = going["revision"].get<std::uint64_t>();
  EXPECT_FALSE(page.news(revision));

  writer.append(row(180.0));
  auto const later = news(page, revision);
  EXPECT_EQ(later["sections"][0]["sets"][0]["time"]["shape"][0], 3);

  writer.set_measured({{"T1", "degC", "nose", Eigen::Vector3d(21.0, 22.1, 22.9)}}, {}, {});
  (void)writer.finish();
  auto const done = news(page, later["revision"].get<std::uint64_t>());
  EXPECT_TRUE(done["sections"][0]["sets"][0]["complete"]);
  EXPECT_EQ(done["sections"][0]["remarks"].dump().find("without their noise"), std::string::npos);
}

TEST_F(Live, ShowsTheNewerOfARunAndItsSuccessor) {
  output::DatasetWriter first(folder / "run.h5", head(), std::chrono::seconds(0));
  first.append(row(60.0));
  (void)first.finish();
  output::DatasetWriter second(folder / "run.h5", head(), std::chrono::seconds(0));
  second.append(row(60.0));
  second.append(row(120.0));
  fs::last_write_time(folder / "run.h5", fs::last_write_time(folder / "run.h5.partial") - std::chrono::seconds(9));
  LivePage page({folder / "run.h5"});
  EXPECT_EQ(news(page, 0)["sections"][0]["sets"][0]["time"]["shape"][0], 2);
}

TEST_F(Live, ShowsWhatACommandDoesInItsFolder) {
  LivePage page({folder / "study"});
  {
    ProgressFile going(folder / "study", "Study of two");
    going.show("running", 0.25);
    going.show("judging");
    auto const now = news(page, 0)["sections"];
    ASSERT_EQ(now.size(), 1U);
    EXPECT_EQ(now[0]["kind"], "progress");
    EXPECT_EQ(now[0]["steps"][0]["share"], 0.25);
    EXPECT_EQ(now[0]["steps"][1]["what"], "judging");
  }
  tests::put(folder / "study" / "study.json",
             R"({"title": "two", "verdict": [], "claims": [], "remarks": [], "worlds": [], "selections": [],
                 "combinations": []})");
  auto const then = news(page, 0)["sections"];
  ASSERT_EQ(then.size(), 1U);
  EXPECT_EQ(then[0]["kind"], "study");
}

TEST_F(Live, CountsTheRunsOfACampaignWhoeverMakesThem) {
  fs::create_directories(folder / "many" / "parts");
  tests::put(folder / "many" / "manifest.json", R"({"runs": "25", "runs_per_part": "10"})");
  LivePage page({folder / "many"});
  EXPECT_EQ(news(page, 0)["sections"][0]["steps"].back()["what"], "0 of 25 runs are made");
  {
    output::Journal here(folder / "many" / "parts" / "000000.journal");
    output::Journal elsewhere(folder / "many" / "parts" / "000001.journal");
    for (char const* record : {"one", "two", "three"}) here.append(record);
    elsewhere.append("eleven");
  }
  auto const going = news(page, 1);
  EXPECT_EQ(going["revision"], 2);
  EXPECT_EQ(going["sections"][0]["steps"].back()["what"], "4 of 25 runs are made");
  tests::put_part(folder / "many" / "parts" / "000002.h5", 20, 5);
  auto const later = news(page, 2)["sections"][0];
  EXPECT_EQ(later["steps"][0]["what"], "part 2 is whole: runs 20 to 24");
  EXPECT_DOUBLE_EQ(later["steps"].back()["share"], 9.0 / 25.0);
  EXPECT_FALSE(later["done"]);
  tests::put(folder / "many" / "failures.csv", "run,reason\n7,\"too fast\"\n");
  tests::put(folder / "many" / "campaign.h5", "");
  auto const shown = news(page, 3)["sections"];
  ASSERT_EQ(shown.size(), 2U);
  EXPECT_EQ(shown[0]["kind"], "campaign");  // results first, once they are all there
  auto const& done = shown[1];
  EXPECT_TRUE(done["done"]);
  EXPECT_EQ(done["steps"].back()["what"], "25 runs, 1 of them failed: campaign.h5");
}

/// Two writes within a tick of the file system's clock leave the same time, and here the same size.
TEST_F(Live, SeesAChangeThatLeavesTimeAndSizeAsTheyWere) {
  auto const file = folder / "progress.json";
  auto const say = [&](char const* what) { tests::put(file, fmt::format(R"({{"title": "{}", "steps": []}})", what)); };
  say("one");
  LivePage page({file});
  EXPECT_EQ(news(page, 0)["sections"][0]["title"], "one");
  auto const then = fs::last_write_time(file);
  say("two");
  fs::last_write_time(file, then);
  auto const second = news(page, 1);
  EXPECT_EQ(second["sections"][0]["title"], "two");
  EXPECT_FALSE(page.news(second["revision"].get<std::uint64_t>()));
}

TEST_F(Live, SeesThatAJobWasKilled) {
  auto const steps = [](nlohmann::json const& document) { return document["sections"][0]["steps"]; };
  std::optional<ProgressFile> job(std::in_place, folder.path(), "Diagnosis");
  job->show("calibrating");
  LivePage page({folder.path()});
  EXPECT_EQ(steps(news(page, 0)).back()["what"], "calibrating");
  auto const left = tests::contents(folder / progress_file);
  job.reset();
  tests::put(folder / progress_file, left);  // as a job leaves it that is killed
  auto const after = news(page, 1);
  EXPECT_EQ(steps(after).back()["what"], "ended without a word: it was killed");
  EXPECT_TRUE(after["sections"][0]["done"]);
  ProgressFile again(folder.path(), "Diagnosis");
  again.show("calibrating anew");
  EXPECT_EQ(steps(news(page, 2)).back()["what"], "calibrating anew");
}

TEST_F(Live, SaysWhatItCannotReadAndGoesOn) {
  tests::put(folder / "run.h5", "no data set");
  LivePage page({folder / "run.h5"});
  EXPECT_THAT(news(page, 0)["sections"][0]["title"].get<std::string>(), HasSubstr("run.h5"));
  output::DatasetWriter writer(folder / "run.h5", head());
  writer.append(row(60.0));
  (void)writer.finish();
  EXPECT_EQ(news(page, 1)["sections"][0]["kind"], "runs");
}

TEST_F(Live, MayConnectToWhereItComesFromAndTheFileToNothing) {
  LivePage page({folder / "run.h5"});
  EXPECT_THAT(page.html(), HasSubstr("connect-src 'self'"));
  EXPECT_EQ(output::ReportPage("from disk", "test").html().find("connect-src"), std::string::npos);
}

}  // namespace
}  // namespace thermotwin::twin
