#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numeric>
#include <string>

#include "thermal/evaluation.h"
#include "thermal/growth_field.h"
#include "twin/machine.h"

/// How a machine file lays bodies out: which way is up, who carries whom, what surfaces share.
namespace thermotwin::twin {
namespace {

using testing::HasSubstr;

/// A post that stands on end along x, 10 K warmer than the room at its foot, in films of 10 W/(m² K).
std::string post(std::string const& head, std::string const& film) {
  return "name = \"post\"\n" + head + R"toml(
[[material]]
name = "metal"
like = "GJL-300"
conductivity = "1e6 W/(m K)"
[[block]]
name = "post"
material = "metal"
corner = ["0 m", "0 m", "0 m"]
size = ["2 m", "0.5 m", "0.5 m"]
cells = [4, 2, 2]
[[film]]
name = "sides"
correlation = "constant"
coefficient = "10 W/(m2 K)"
)toml" + film;
}

Machine build(std::string const& text) { return Machine::build(parse_toml(text, "post.toml")); }

/// Heat that the film gives to the post at 30 °C in air of 20 °C at the floor and 2 K more per metre [W].
double film_heat(std::string const& text) {
  Machine const machine = build(text);
  thermal::Evaluation evaluation(machine.network());
  std::vector<double> const state(std::size_t(machine.network().nodes()), 303.15);
  std::vector<double> input;
  for (auto const& channel : machine.network().channel_names())
    input.push_back(channel == "ambient.floor_temperature" ? 293.15 : channel == "ambient.gradient" ? 2.0 : 0.0);
  std::vector<double> watts(machine.network().parts().size());
  evaluation.heat_of_parts(state.data(), input.data(), watts);
  return std::accumulate(watts.begin(), watts.end(), 0.0);
}

TEST(MachineLayout, FilmTakesTheRoomAtTheHeightOverTheAxisThatPointsUp) {
  std::string const top = "on = \"post.x_max\"\n";
  EXPECT_NEAR(film_heat(post("up = \"x\"", top)), -10.0 * 0.25 * (10.0 - 2.0 * 2.0), 1e-3);
  EXPECT_NEAR(film_heat(post("", top)), -10.0 * 0.25 * (10.0 - 2.0 * 0.25), 1e-3);
}

TEST(MachineLayout, SurfacesOfOneFilmShareItsAreaAsDrawn) {
  // A long side at the mean height of 1 m, the top at 2 m: 1 m² and 0.25 m², of which the film has 0.5 m² together.
  std::string const both = "on = [\"post.y_min\", \"post.x_max\"]\n";
  EXPECT_NEAR(film_heat(post("up = \"x\"", both)), -10.0 * (1.0 * 8.0 + 0.25 * 6.0), 1e-3);
  EXPECT_NEAR(film_heat(post("up = \"x\"", both + "area = \"0.5 m2\"\n")), -10.0 * (0.4 * 8.0 + 0.1 * 6.0), 1e-3);
}

TEST(MachineLayout, WhatNobodyCarriesStandsOnTheFloor) {
  std::string const film = "on = \"post.x_max\"\n";
  EXPECT_TRUE(build(post("up = \"x\"", film)).growing[0].held_at.isApprox(Eigen::Vector3d(0.0, 0.25, 0.25)));
  EXPECT_TRUE(build(post("", film)).growing[0].held_at.isApprox(Eigen::Vector3d(1.0, 0.25, 0.0)));
}

std::string lumps(std::string const& of_arm, std::string const& of_tool) {
  std::string const lump = "material = \"C45\"\nmass = \"10 kg\"\nsize = [\"100 mm\", \"100 mm\", \"100 mm\"]\n";
  return "[[joint]]\nname = \"a\"\nfrom = \"post\"\nto = \"arm\"\nconductance = \"1 W/K\"\n"
         "[[joint]]\nname = \"b\"\nfrom = \"arm\"\nto = \"tool\"\nconductance = \"1 W/K\"\n"
         "[[lump]]\nname = \"tool\"\n" +
         lump + "corner = [\"2.1 m\", \"0 m\", \"0 m\"]\n" + of_tool + "[[lump]]\nname = \"arm\"\n" + lump +
         "corner = [\"2 m\", \"0 m\", \"0 m\"]\n" + of_arm;
}

/// All of C45 and of iron at one temperature: each grows from where it is held, whatever the order in the file.
TEST(MachineLayout, CarriedBodiesMoveWithTheirCarriers) {
  std::string const film = "on = \"post.x_max\"\n";
  Machine const machine = build(post("up = \"x\"", film + lumps("carried_by = \"post\"\n", "carried_by = \"arm\"\n")));
  std::vector<double> const rise(std::size_t(machine.network().nodes()), 10.0);
  auto const field = thermal::growth_field(machine.growing, rise);
  double const tool = field(0, machine.network().range("tool").first);
  EXPECT_NEAR(tool, 10.0 * (2.0 * 10.5e-6 + 0.1 * 11.5e-6 + 0.05 * 11.5e-6), 1e-15);
  Machine const elsewhere =
      build(post("up = \"x\"", film + lumps("carried_by = \"post\"\nheld_at = [\"1 m\", \"0 m\", \"0 m\"]\n", "")));
  double const arm = thermal::growth_field(elsewhere.growing, rise)(0, elsewhere.network().range("arm").first);
  EXPECT_NEAR(arm, 10.0 * (1.0 * 10.5e-6 + 1.05 * 11.5e-6), 1e-15);
}

std::string message(std::string const& text) {
  try {
    (void)build(text);
  } catch (FileError const& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(MachineLayout, MistakesAreNamedWithTheirPlace) {
  std::string const film = "on = \"post.x_max\"\n";
  EXPECT_THAT(message(post("up = \"w\"", film)), testing::AllOf(HasSubstr("post.toml:2:"), HasSubstr("'up' is 'w'")));
  auto const line_of = [](std::string const& text, std::string const& word) {
    return "post.toml:" +
           std::to_string(1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(text.find(word)), '\n'));
  };
  auto const unknown = post("", film + lumps("carried_by = \"pst\"\n", ""));
  EXPECT_THAT(message(unknown), testing::AllOf(HasSubstr(line_of(unknown, "pst")), HasSubstr("post")));
  auto const circle = post("", film + lumps("carried_by = \"tool\"\n", "carried_by = \"arm\"\n"));
  EXPECT_THAT(message(circle), testing::AllOf(HasSubstr("post.toml:"), HasSubstr("carried by what it carries itself")));
  auto const bare = post("", "area = \"1 m2\"\n");
  EXPECT_THAT(message(bare),
              testing::AllOf(HasSubstr(line_of(bare, "[[film]]").substr(0, 9)), HasSubstr("needs a surface")));
  auto sizeless = post("", film);
  std::string const size = "size = [\"2 m\", \"0.5 m\", \"0.5 m\"]\n";
  sizeless.erase(sizeless.find(size), size.size());
  EXPECT_THAT(message(sizeless),
              testing::AllOf(HasSubstr(line_of(sizeless, "[[block]]")), HasSubstr("'size' is missing; write for ex"),
                             HasSubstr("size = [\"600 mm\", \"600 mm\", \"600 mm\"]")));
}

/// Before memory is taken for them: 900 × 600 × 300 cells would need 160 GB.
TEST(MachineLayout, CellsAreCountedOverAllBodies) {
  auto text = post("", "on = \"post.x_max\"\n");
  std::string const cells = "cells = [4, 2, 2]";
  text.replace(text.find(cells), cells.size(), "cells = [900, 600, 300]");
  EXPECT_THAT(message(text), testing::AllOf(HasSubstr("post.toml:12:9: "), HasSubstr("'post' has 162000000 cells"),
                                            HasSubstr("allowed is 10000000 for a whole machine")));
  auto bars = post("", "on = \"post.x_max\"\n");
  for (std::string const name : {"a", "b", "c"})
    bars += "[[hollow_cylinder]]\nname = \"" + name +
            "\"\nmaterial = \"metal\"\nlength = \"1 m\"\nouter_diameter = \"1 m\"\naxial_cells = 100000\n"
            "radial_cells = 10000\n";
  EXPECT_THAT(message(bars), HasSubstr("'a' has 1000000000 cells"));
  auto sum = post("", "on = \"post.x_max\"\n");
  sum.replace(sum.find(cells), cells.size(), "cells = [10000, 10000, 1]");
  sum += "[[bar]]\nname = \"bar\"\nmaterial = \"metal\"\nlength = \"1 m\"\nouter_diameter = \"1 m\"\ncells = 20\n";
  EXPECT_THAT(message(sum), HasSubstr("'post' has 100000000 cells, the machine with it 100000020"));
}

}  // namespace
}  // namespace thermotwin::twin
