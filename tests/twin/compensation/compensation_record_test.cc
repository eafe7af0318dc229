#include "twin/compensation/compensation_record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/output/small_disk.h"
#include "tests/output/temporary_directory.h"
#include "thermal/error.h"

namespace thermotwin::twin {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using thermotwin::tests::contents;
using thermotwin::tests::TemporaryDirectory;

/// E = 2 ΔT1, a decision every 10 s.
class Recorded : public testing::Test {
 protected:
  CompensationRecord record() {
    return {folder_ / "live.h5", compensator_.inputs(), "X", [this](std::string const& line) { said_.push_back(line); },
            std::chrono::seconds(0)};
  }
  void decide(CompensationRecord& into) {
    Reading const reading{"T1", 20.0 + 0.01 * time_, "degC", time_, "good"};
    into.add(compensator_.step(time_, std::span(&reading, 1), 10.0), compensator_);
    time_ += 10.0;
  }
  std::string refusal() {
    try {
      (void)record();
      return "taken";
    } catch (thermal::InputError const& error) {
      return error.what();
    }
  }

  TemporaryDirectory folder_;
  Compensator compensator_{
      SavedModel({"linear", {"T1"}, 0.0, 2.0, models::LinearForm{0.0, {0}, Eigen::MatrixXd::Ones(1, 1)}, ""}), {}};
  double time_ = 0.0;
  std::vector<std::string> said_;
};

TEST_F(Recorded, TakesThePlaceOfNoOtherRecordEvenOfAKilledOne) {
  {
    auto killed = record();
    decide(killed);
  }
  for (std::string const name : {"live.h5.partial", "live.h5"}) {
    auto const before = contents(folder_ / name);
    EXPECT_THAT(refusal(), AllOf(HasSubstr(name + "' is there already"), HasSubstr("name another record")));
    EXPECT_EQ(folder_.files(), std::vector{name});
    EXPECT_TRUE(contents(folder_ / name) == before);
    std::filesystem::remove(folder_ / name);
    auto ended = record();
    decide(ended);
    ended.finish();
  }
  EXPECT_TRUE(said_.empty());
}

/// As where an input does not come within --start.
TEST_F(Recorded, LeavesNothingWhereNothingWasDecided) {
  models::LinearForm const form{0.0, {0}, Eigen::MatrixXd::Ones(2, 1)};
  compensator_ = Compensator(SavedModel({"linear", {"T1", "T2"}, 0.0, 2.0, form, ""}), {});
  for (bool const stopped : {false, true}) {
    {
      auto waiting = record();
      for (int i = 0; i < 3; ++i) decide(waiting);
      if (stopped) waiting.finish();
    }
    EXPECT_EQ(folder_.files(), std::vector<std::string>{}) << stopped;
  }
  EXPECT_TRUE(said_.empty());
}

TEST_F(Recorded, OnAFullDiskItSaysSoOnceAndKeepsWhatItHas) {
  {
    auto full = record();
    decide(full);
    thermotwin::tests::SmallDisk const disk(10);
    for (int i = 0; i < 3; ++i) decide(full);
    full.finish();
  }
  ASSERT_EQ(said_.size(), 1U);
  EXPECT_THAT(said_[0], AllOf(HasSubstr("live.h5.partial': File too large"), HasSubstr("compensation goes on")));
  EXPECT_EQ(folder_.files(), std::vector<std::string>{"live.h5.partial"});
  EXPECT_FALSE(output::read(folder_ / "live.h5.partial").complete);
}

}  // namespace
}  // namespace thermotwin::twin
