#include "twin/diagnosis/amended_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/output/temporary_directory.h"
#include "tests/scenarios/refusal.h"
#include "twin/machine.h"

/// A machine file that gets tables and other numbers stays its author's file.
namespace thermotwin::twin {
namespace {

using testing::HasSubstr;
using tests::contents;
using tests::put;
using tests::refusal;
using tests::TemporaryDirectory;

std::string v450() { return contents(machine_file("v450")); }

AddedTable const fan{"heat",
                     {{"name", "cabinet", ""}, {"at", "column_rear", ""}, {"power", "40 W", "± 3 W"}},
                     "Missing: heat of the cabinet.\nFound in two runs."};

std::vector<std::string> lines_of(std::string const& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Lines of `after` that are not in `before` at the same place; both have as many.
std::vector<std::string> changed_lines(std::string const& before, std::string const& after) {
  auto const old_lines = lines_of(before), new_lines = lines_of(after);
  EXPECT_EQ(old_lines.size(), new_lines.size());
  std::vector<std::string> changed;
  for (std::size_t i = 0; i < std::min(old_lines.size(), new_lines.size()); ++i)
    if (old_lines[i] != new_lines[i]) changed.push_back(new_lines[i]);
  return changed;
}

/// The document that with_values should lead to.
std::string text_at(std::string const& toml, std::string const& path) {
  Value document = parse_toml(toml, "test.toml");
  auto const [table, key] = find_parameter(document, path);
  return table->find(key)->text();
}

TEST(AmendedFile, TablesStandBehindAnUntouchedFile) {
  std::string const text = amended_text(v450(), {fan});
  EXPECT_TRUE(text.starts_with(v450()));
  EXPECT_EQ(text.substr(v450().size()), R"(
# Missing: heat of the cabinet.
# Found in two runs.
[[heat]]
name = "cabinet"
at = "column_rear"
power = "40 W"                          # ± 3 W
)");
  auto const before = Machine::build(parse_toml(v450(), "v450.toml"));
  auto const after = Machine::build(parse_toml(text, "v450.toml"));
  EXPECT_EQ(after.network().parts().size(), before.network().parts().size() + 1);
}

TEST(AmendedFile, LineBreaksAreThoseOfTheFile) {
  std::string const text = amended_text("name = \"x\"\r\n", {fan});
  EXPECT_THAT(text, HasSubstr("[[heat]]\r\nname = \"cabinet\"\r\n"));
  EXPECT_TRUE(amended_text("name = \"x\"", {fan}).starts_with("name = \"x\"\n\n#"));
}

/// As a logger calls its channels.
TEST(AmendedFile, NamesMayHaveDots) {
  std::string const text = "[[temperature_sensor]]\nname = \"Temp. 1.2\"\nat = \"bed\"\n";
  EXPECT_THAT(with_values(text, {{"temperature_sensor.Temp. 1.2.lag", "40 s", "± 9 s"}}),
              HasSubstr("name = \"Temp. 1.2\"\nlag = \"40 s\"  # ± 9 s\n"));
  EXPECT_THAT(refusal([&] {
                (void)with_values(text, {{"temperature_sensor.Temp. 1.3.lag", "40 s", ""}});
              }),
              HasSubstr("there is no temperature_sensor named"));
}

TEST(AmendedFile, ValuesAreReplacedWhereTheyStand) {
  std::string const text = with_values(
      v450(), {{"joint.taper.conductance", "61.5 W/K", "± 4 W/K"}, {"bearing.front.grease_factor", "0.83", ""}});
  auto const changed = changed_lines(v450(), text);
  ASSERT_EQ(changed.size(), 2u);
  EXPECT_TRUE(changed[0].starts_with("conductance = \"61.5 W/K\"")) << changed[0];
  EXPECT_THAT(changed[0], HasSubstr("# was "));
  EXPECT_TRUE(changed[0].ends_with("W/K; ± 4 W/K")) << changed[0];
  EXPECT_TRUE(changed[1].starts_with("grease_factor = 0.83")) << changed[1];
  EXPECT_EQ(text_at(text, "joint.taper.conductance"), "\"61.5 W/K\"");
  EXPECT_EQ(text_at(text, "bearing.front.grease_factor"), "0.83");
}

TEST(AmendedFile, SegmentOfALoopGetsAKeyWithinItsBraces) {
  std::string const text = with_values(v450(), {{"displacement.E_Z.segment.2.growth_factor", "1.07", "± 0.04"},
                                                {"displacement.E_Z.segment.2.weight", "-0.9", ""}});
  auto const changed = changed_lines(v450(), text);
  ASSERT_EQ(changed.size(), 1u);
  EXPECT_EQ(changed[0],
            "  { of = \"cartridge[0 mm .. 20 mm]\", weight = -0.9, growth_factor = 1.07 },"
            "  # growth_factor: ± 0.04, was -1");
  EXPECT_EQ(text_at(text, "displacement.E_Z.segment.2.growth_factor"), "1.07");
}

TEST(AmendedFile, KeyThatATableLacksIsAddedBelowItsFirst) {
  EXPECT_EQ(with_values("[[lump]]\nname = \"a\" # first\nmass = 1\n", {{"lump.a.height", "2 m", "guess"}}),
            "[[lump]]\nname = \"a\" # first\nheight = \"2 m\"  # guess\nmass = 1\n");
}

TEST(AmendedFile, PlacesAreFoundBehindLettersOfSeveralBytes) {
  EXPECT_EQ(
      with_values("[[a]]\nname = \"µ\"\nb = [{ t = \"5 µm\", u = \"1 }# µm\" }] # °\n", {{"a.µ.b.0.u", "2 um", ""}}),
      "[[a]]\nname = \"µ\"\nb = [{ t = \"5 µm\", u = \"2 um\" }] # °  # was 1 }# µm\n");
}

TEST(AmendedFile, PathThatLeadsNowhereIsRefused) {
  EXPECT_THAT(refusal([] {
                (void)with_values(v450(), {{"joint.tapper.conductance", "1 W/K", ""}});
              }),
              HasSubstr("did you mean 'taper'?"));
}

TEST(AmendedFile, NeverOverwritesTheFileThatItAmends) {
  TemporaryDirectory const folder;
  put(folder / "m.toml", "name = \"m\"\n");
  std::filesystem::create_symlink(folder / "m.toml", folder / "link.toml");
  for (auto const* name : {"m.toml", "link.toml"})
    EXPECT_THAT(refusal([&] { write_amended(folder / "m.toml", folder / name, "x"); }), HasSubstr("never overwritten"));
  EXPECT_EQ(contents(folder / "m.toml"), "name = \"m\"\n");
}

TEST(AmendedFile, WeightsGoWithTheFile) {
  TemporaryDirectory const folder;
  std::filesystem::create_directory(folder / "out");
  put(folder / "m.toml", "name = \"m\"\n");
  put(folder / "m.weights", "# a\n");
  write_amended(folder / "m.toml", folder / "out/amended.toml", "name = \"n\"\n");
  EXPECT_EQ(contents(folder / "out/amended.toml"), "name = \"n\"\n");
  EXPECT_EQ(contents(folder / "out/amended.weights"), "# a\n");
}

}  // namespace
}  // namespace thermotwin::twin
