#include "thermal/nearest_name.h"

#include <gtest/gtest.h>
#include <vector>

namespace thermotwin::thermal {
namespace {

TEST(EditDistance, CountsInsertDeleteReplaceAndSwap) {
  EXPECT_EQ(edit_distance("bearing", "bearing"), 0);
  EXPECT_EQ(edit_distance("bearing", "bearings"), 1);
  EXPECT_EQ(edit_distance("bearing", "bering"), 1);
  EXPECT_EQ(edit_distance("bearing", "beering"), 1);
  EXPECT_EQ(edit_distance("bearing", "baering"), 1);
  EXPECT_EQ(edit_distance("Bearing", "bearing"), 0);
  EXPECT_EQ(edit_distance("", "abc"), 3);
}

TEST(EditDistance, IsSymmetric) { EXPECT_EQ(edit_distance("ambient", "ambit"), edit_distance("ambit", "ambient")); }

TEST(NearestName, PrefersEqualLengthAmongEquallyFar) {
  std::vector<std::string> const known = {"mm", "min"};
  EXPECT_EQ(nearest_name("mim", known), "min");
}

TEST(NearestName, OfNothingIsEmpty) { EXPECT_EQ(nearest_name("x", {}), ""); }

TEST(DidYouMean, NamesTheCloseOne) {
  std::vector<std::string> const known = {"conductance", "capacity"};
  EXPECT_EQ(did_you_mean("conductence", known), "did you mean 'conductance'?");
}

TEST(DidYouMean, CompletesWhatIsTheBeginningOfOneName) {
  std::vector<std::string> const known = {"ambient.door", "ambient.temperature", "coolant.temperature"};
  EXPECT_EQ(did_you_mean("ambient.temp", known), "did you mean 'ambient.temperature'?");
  EXPECT_EQ(did_you_mean("ambient", known).substr(0, 7), "known: ");
  EXPECT_EQ(did_you_mean("coolant", known).substr(0, 7), "known: ");
  EXPECT_EQ(did_you_mean("co", known).substr(0, 7), "known: ");
}

TEST(DidYouMean, ListsNearestFirstWhenNoneIsClose) {
  std::vector<std::string> const known = {"conductance", "mass"};
  EXPECT_EQ(did_you_mean("xmxxs", known), "known: 'mass', 'conductance'");
}

TEST(DidYouMean, ListsThoseFirstThatHoldTheName) {
  std::vector<std::string> const known = {"length", "axial_cells", "42CrMo4", "radial_cells"};
  auto const meaning = [](std::string const& name) { return name == "42CrMo4" ? "Steel, quenched" : ""; };
  EXPECT_EQ(did_you_mean("cells", known).substr(0, 36), "known: 'axial_cells', 'radial_cells'");
  EXPECT_EQ(did_you_mean("steel", known, meaning).substr(0, 16), "known: '42CrMo4'");
}

TEST(DidYouMean, SaysWhatTheListedOnesMean) {
  std::vector<std::string> const known = {"conductance", "mass"};
  auto const meaning = [](std::string const& name) { return name == "mass" ? "how heavy" : ""; };
  EXPECT_EQ(did_you_mean("xmxxs", known, meaning), "known: 'mass' (how heavy), 'conductance'");
  EXPECT_EQ(did_you_mean("mas", known, meaning), "did you mean 'mass'?");
}

TEST(DidYouMean, ANameOfOneLetterIsNotCloseToAnother) {
  std::vector<std::string> const known = {"z"};
  EXPECT_EQ(did_you_mean("w", known), "known: 'z'");
}

TEST(DidYouMean, CutsALongList) {
  std::vector<std::string> const known(11, "conductance");
  EXPECT_TRUE(did_you_mean("zzzz", known).ends_with(", …"));
}

TEST(DidYouMean, SaysThatNothingIsKnown) { EXPECT_EQ(did_you_mean("x", {}), "none is known"); }

}  // namespace
}  // namespace thermotwin::thermal
