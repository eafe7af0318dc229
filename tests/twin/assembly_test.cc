#include "twin/assembly.h"

#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <regex>
#include <sstream>

#include "tests/output/temporary_directory.h"
#include "tests/scenarios/refusal.h"
#include "thermal/bar.h"
#include "thermal/block.h"
#include "thermal/hollow_cylinder.h"
#include "thermal/lump.h"

namespace thermotwin::twin {
namespace {

using testing::HasSubstr;
using thermal::make_body;
using thermotwin::tests::refusal;

thermal::Material const& steel() { return thermal::material("C45"); }

std::map<std::string, thermal::Body> bodies() {
  return {
      {"motor", make_body("motor", thermal::Lump{steel(), 1.0, {}})},
      {"column", make_body("column", thermal::Bar{steel(), {0, 0, 0}, {0, 0, 1}, 1.0, 0.18, 0.0, {}, 10})},
      {"sleeve", make_body("sleeve", thermal::HollowCylinder{steel(), {1, 0, 0}, {0, 0, 1}, 0.1, 0.08, 0.04, 5, 2})},
      {"bed", make_body("bed", thermal::Block{steel(), {0, 5, 0}, {0.4, 0.5, 1.5}, {4, 4, 4}})}};
}

/// What docs/machine.md shows of places, in the first column of its table.
std::vector<std::string> documented_places() {
  auto const page = thermotwin::tests::contents(std::filesystem::path(THERMOTWIN_SOURCE_DIR) / "docs/machine.md");
  std::istringstream lines(page.substr(page.find("## Places")));
  std::vector<std::string> places;
  for (std::string line; std::getline(lines, line) && line != "## In this order";) {
    auto const column = line.substr(0, line.find(" | "));
    if (!column.starts_with("| `")) continue;
    static std::regex const span("`([^`]*)`");
    for (std::sregex_iterator found(column.begin(), column.end(), span), end; found != end; ++found)
      places.push_back((*found)[1]);
  }
  return places;
}

TEST(Place, IsWhatTheDocumentationShows) {
  auto const all = bodies();
  auto const places = documented_places();
  EXPECT_EQ(places.size(), 11U);
  for (auto const& place : places) {
    if (place == "ambient") continue;
    EXPECT_NO_THROW((void)site_of(all.at(body_of(place)), place)) << place;
  }
}

TEST(Place, CountsFromItsBody) {
  auto const point = site_of(bodies().at("bed"), "bed.y_max[200 mm, 450 mm]");
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (auto const& contact : point.contacts) centre += contact.share * contact.centre;
  EXPECT_NEAR(centre[0], 0.2, 1e-12);
  EXPECT_NEAR(centre[2], 0.45, 1e-12);
  EXPECT_GT(centre[1], 5.4);
}

TEST(Place, ThatIsNotThereComesWithTheOnesThatAre) {
  auto const all = bodies();
  Assembly const assembly(all, {"motor", "column", "sleeve", "bed"}, 0.0);
  EXPECT_EQ(refusal([&] { (void)assembly.place("room"); }),
            "unknown body 'room'; known: 'motor', 'bed', 'column', "
            "'sleeve'");
  EXPECT_THAT(refusal([&] { (void)assembly.place("room", {"ambient"}); }), HasSubstr(", 'ambient'"));
  EXPECT_THAT(refusal([&] { (void)assembly.place("ambiant", {"ambient"}); }), HasSubstr("did you mean 'ambient'?"));
}

TEST(Assembly, TakesNoDisplacementThatIsNotFinite) {
  auto const all = bodies();
  Assembly assembly(all, {"motor"}, 0.0);
  Place const motor = assembly.place("motor");
  for (double const number : {std::nan(""), HUGE_VAL}) {
    EXPECT_THAT(refusal([&] {
                  assembly.displace(InputTerm{"E_Z", "spindle.speed", number, 2.0});
                }),
                HasSubstr("'E_Z'"));
    EXPECT_THAT(refusal([&] {
                  assembly.displace(InputTerm{"E_Z", "spindle.speed", 1e-6, number});
                }),
                HasSubstr("'E_Z'"));
    EXPECT_THAT(refusal([&] { assembly.displace(TemperatureTerm{"E_Z", motor, number}); }), HasSubstr("'motor'"));
  }
  EXPECT_TRUE(assembly.input_terms().empty());
  EXPECT_TRUE(assembly.temperature_terms().empty());
}

TEST(Assembly, RatedSpeedIsThePartsOwnOrTheMaximumOfASpindle) {
  auto const all = bodies();
  Assembly const with(all, {"motor"}, 600.0), without(all, {"motor"}, 0.0);
  EXPECT_EQ(with.rated_speed(std::nullopt), 600.0);
  EXPECT_EQ(with.rated_speed(300.0, "x.speed"), 300.0);
  EXPECT_EQ(without.rated_speed(300.0, "x.speed"), 300.0);
  EXPECT_EQ(without.rated_speed(std::nullopt, "spindle.running"), 0.0);
  EXPECT_EQ(refusal([&] { (void)without.rated_speed(std::nullopt, "x.speed"); }),
            "what follows 'x.speed' needs a rated_speed: the machine has no spindle");
  EXPECT_EQ(refusal([&] { (void)with.rated_speed(0.0); }), "'rated_speed' must be above 0");
}

}  // namespace
}  // namespace thermotwin::twin
