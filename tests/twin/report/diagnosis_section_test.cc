#include "twin/report/diagnosis_section.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace thermotwin::twin {
namespace {

using output::Json;

TEST(DiagnosisSection, TakesTheHeadlineOfSilenceAndTellsCautionsBeforeRemarks) {
  Json const shown =
      diagnosis_json(Json::parse(R"({"verdict": "nothing", "effects": [], "headline": "No effect is evident.",
    "cautions": ["a number is far from the file"], "remarks": ["a gap"]})"),
                     "silent");
  EXPECT_EQ(shown["sentence"], "No effect is evident.");
  EXPECT_EQ(shown["remarks"], Json::parse(R"(["a number is far from the file", "a gap"])"));
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

TEST(DiagnosisSection, SaysWhatCouldHideInTheUnitThatPeopleUse) {
  Json const diagnosis = Json::parse(R"({"verdict": "nothing", "effects": [], "could_hide": [
    {"effect": "centrifugal_growth", "site": "E_Z", "parameter": "growth", "amplitude": 1.234e-6, "unit": "m"}]})");
  EXPECT_EQ(diagnosis_json(diagnosis, "healthy")["could_hide"][0]["text"], "1.2 um");
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
