#include "twin/volumetric/volumetric_files.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/output/temporary_directory.h"
#include "twin/machine.h"
#include "twin/volumetric/volumetric_report.h"

/// What `thermotwin volumetric mill200` leaves in its folder.
namespace thermotwin::twin {
namespace {

using testing::HasSubstr;
using thermotwin::tests::contents;
using thermotwin::tests::TemporaryDirectory;

class Mill : public testing::Test {
 protected:
  VolumetricStudy study(std::string const& folder = "out") {
    VolumetricFiles files;
    files.machine = machine_file("mill200");
    files.output = folder_ / folder;
    return volumetric_files(files);
  }
  [[nodiscard]] std::string text(std::string const& name) const { return contents(folder_ / "out" / name); }
  [[nodiscard]] auto lines(std::string const& name) const {
    auto const all = text(name);
    return std::count(all.begin(), all.end(), '\n');
  }

  TemporaryDirectory folder_;
};

TEST_F(Mill, LeavesItsTables) {
  auto const found = study();
  EXPECT_EQ(lines("diagonals.csv"), 1 + 4 * 31);
  EXPECT_EQ(lines("functions.csv"), 1 + 3 * 11);
  EXPECT_EQ(lines("closure.csv"), 1 + 3 * 10);
  EXPECT_EQ(lines("field.csv"), 1 + 11 * 11 * 11);
  EXPECT_EQ(lines("compensation.csv"), 1 + 11 * 11 * 11);
  EXPECT_THAT(text("compensation.cec"), HasSubstr("$AN_CEC_OUTPUT_AXIS[8]=(AX3)"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/field.vts"));
  auto const report = nlohmann::json::parse(text("report.json"));
  EXPECT_EQ(report["identification"]["rank"], 14);
  EXPECT_GE(double(report["reduction"]), 0.8);
  EXPECT_EQ(report["misleading"], false);
  for (auto const& [name, largest] : report["after"]["diagonals_um"].items()) EXPECT_LT(double(largest), 10.0) << name;
  EXPECT_THAT(volumetric_text(found), HasSubstr("rank 14 of 14"));
}

TEST_F(Mill, SameSeedSameBytes) {
  (void)study();
  (void)study("again");
  EXPECT_EQ(contents(folder_ / "again/compensation.csv"), text("compensation.csv"));
  EXPECT_TRUE(contents(folder_ / "again/field.vts") == text("field.vts"));
}

}  // namespace
}  // namespace thermotwin::twin
