#include "twin/report/campaign_section.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/output/page_reader.h"
#include "tests/output/temporary_directory.h"
#include "tests/twin/report/example_campaign.h"
#include "thermal/error.h"
#include "twin/report/report_files.h"

namespace thermotwin::twin {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using tests::TemporaryDirectory;

/// What the runs show, checked by hand: 40 of them in two parts, the first of which failed.
TEST(CampaignSection, ShowsWhatTheRunsShow) {
  TemporaryDirectory const folder;
  fs::create_directories(folder / "many" / "parts");
  tests::put(folder / "many" / "manifest.json",
             R"({"runs": "60", "runs_per_part": "20", "campaign.file": "title = 'Forty'\nexperiments = []\n",
                 "machine.file": "[[rotation]]\nname = 'A'\n"})");
  output::ReportPage none("", "");
  EXPECT_TRUE(campaign_json(folder / "many", none).is_null());
  tests::put_part(folder / "many" / "parts" / "000000.h5", 0, 20, true);
  tests::put_part(folder / "many" / "parts" / "000001.h5", 20, 20);

  auto const file = folder / "report.html";
  EXPECT_THAT(write_report({{folder / "many"}, "", file}), HasSubstr("report.html"));
  tests::PageReader const page(tests::contents(file));
  auto const& section = page.document["sections"][1];  // after how far it is
  EXPECT_EQ(section["kind"], "campaign");
  EXPECT_EQ(section["title"], "Forty");
  EXPECT_EQ(section["runs"], 40);
  EXPECT_EQ(section["failed"], 1);
  EXPECT_EQ(section["failures"][0]["reason"], "too fast");
  ASSERT_EQ(section["channels"].size(), 3U);
  EXPECT_EQ(section["channels"][0]["unit"], "degC");
  EXPECT_EQ(section["channels"][1]["unit"], "urad");  // A is an angle
  EXPECT_EQ(section["channels"][2]["unit"], "um");
  // Share by share at 0, 60 and 120 s: of 1 … 39, and 10 and 20 K more later.
  auto const quantiles = page.numbers<float>(section["channels"][0]["quantiles"]);
  ASSERT_EQ(quantiles.size(), 15U);
  EXPECT_NEAR(quantiles[0], 1.0 + 0.05 * 38.0, 1e-5);
  EXPECT_NEAR(quantiles[7], 30.0, 1e-5);
  EXPECT_NEAR(quantiles[14], 21.0 + 0.95 * 38.0, 1e-5);
  auto const last = page.numbers<float>(section["channels"][0]["last"]);
  EXPECT_TRUE(std::isnan(last[0]));
  EXPECT_EQ(last[39], 59.0F);
  EXPECT_EQ(section["parameters"][0]["name"], "a.b");
  EXPECT_EQ(page.numbers<float>(section["parameters"][0]["values"])[5], 25.0F);

  output::ReportPage some("", "");  // at most ten: every fourth
  auto const thinned = campaign_json(folder / "many", some, 10);
  EXPECT_EQ(thinned["run"]["shape"][0], 10);
  EXPECT_THAT(thinned["remarks"][0].get<std::string>(), HasSubstr("Of 40 runs one in 4 is looked at here, 10 in all"));
  tests::put(folder / "many" / "parts" / "000001.h5", "damaged");
  EXPECT_THROW(static_cast<void>(campaign_json(folder / "many", some)), thermal::InputError);
}

}  // namespace
}  // namespace thermotwin::twin
