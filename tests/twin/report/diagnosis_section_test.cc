#include "twin/report/diagnosis_section.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace thermotwin::twin {
namespace {

using output::Json;

TEST(DiagnosisSection, TellsThatNothingIsEvidentFromThatNothingIsLeft) {
  Json diagnosis = Json::parse(R"({"verdict": "nothing", "effects": [],
    "disagreement": {"before": [{"significant": false}, {"significant": true}], "after": []}})");
  EXPECT_EQ(diagnosis_json(diagnosis, "silent")["sentence"],
            "No effect is evident, though the machine leaves more than noise in parts of the data.");
  diagnosis["disagreement"]["before"][1]["significant"] = false;
  EXPECT_EQ(diagnosis_json(diagnosis, "silent")["sentence"],
            "Nothing is missing: the machine explains these data to within their noise.");
}

TEST(DiagnosisSection, TakesWhatStandsInForAnUnknownShiftForNothingFound) {
  Json const diagnosis = Json::parse(R"({"verdict": "none_known", "effects": [
    {"group": 0, "effect": "bearing_shift", "site": "E_Z", "parameter": "weight", "amplitude": -0.23, "low": -0.3,
     "high": -0.15, "unit": "1"},
    {"group": 1, "effect": "centrifugal_growth", "site": "E_Z", "parameter": "growth", "amplitude": -8.9e-7,
     "low": -1.2e-6, "high": -5.9e-7, "unit": "m"}]})");
  EXPECT_EQ(diagnosis_json(diagnosis, "shift")["sentence"],
            "Something is missing that none of the effects tried explains. What stands in for it: bearing shift at "
            "E_Z; and centrifugal growth at E_Z.");
}

TEST(DiagnosisSection, WritesAMinusForHeatThatIsTaken) {
  Json const diagnosis =
      Json::parse(R"({"verdict": "none_known", "effects": [], "heat": {"body": "motor", "watts": -4.2, "runs": []}})");
  EXPECT_EQ(diagnosis_json(diagnosis, "cold")["sentence"],
            "Heat of −4.2 W on average into motor is missing, and none of the effects tried explains it.");
}

TEST(DiagnosisSection, NamesTheAirWhereAllBodiesTakePart) {
  Json const diagnosis = Json::parse(R"({"verdict": "none_known", "effects": [],
    "heat": {"body": "bed", "watts": 12.1, "standard_error": 3.5, "runs": [],
             "watts_per_kelvin_of_air": {"bed": 14.0, "motor": 3.0}}})");
  EXPECT_EQ(
      diagnosis_json(diagnosis, "room")["sentence"],
      "The air at the machine is not as warm as its record says, and none of the effects tried explains it: 12.1 ± "
      "6.9 W on average into bed.");
}

}  // namespace
}  // namespace thermotwin::twin
