#include "twin/file_kind.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <utility>

#include "tests/output/temporary_directory.h"
#include "tests/scenarios/refusal.h"

namespace thermotwin::twin {
namespace {

using thermotwin::tests::refusal;

FileKind kind_of_text(std::string const& text) { return file_kind(parse_toml(text, "some.toml")); }

TEST(FileKind, IsTheOneThatKnowsMostKeys) {
  EXPECT_EQ(kind_of_text("name = \"a\"\n[[lump]]\nname = \"b\"\n"), FileKind::machine);
  EXPECT_EQ(kind_of_text("machine = \"v450\"\nduratoin = \"1 h\"\n"), FileKind::experiment);
  EXPECT_EQ(kind_of_text("machine = \"v450\"\nexperiments = []\n"), FileKind::campaign);
  EXPECT_EQ(kind_of_text("predicts = {}\n"), FileKind::error_model);
  EXPECT_EQ(kind_of_text("selections = []\n"), FileKind::study);
  EXPECT_EQ(kind_of_text("machine = \"v450\"\n[[table]]\n"), FileKind::measurement);
  EXPECT_EQ(kind_of_text("most = 3\n"), FileKind::candidates);
  EXPECT_EQ(kind_of_text("name = \"a\"\nduration = \"1 h\"\n[[lump]]\n"), FileKind::machine);  // one key is astray
  EXPECT_EQ(kind_of_text("nonsense = 1\n"), FileKind::machine);
  EXPECT_EQ(kind_of_text("[[temperature_sensor]]\n"), FileKind::sensors);
  EXPECT_EQ(kind_of_text("name = \"a\"\n[[temperature_sensor]]\n"), FileKind::machine);
}

TEST(FileKind, OfWhatIsShipped) {
  for (auto const& [folder, kind] :
       {std::pair{"twin/machines", FileKind::machine}, std::pair{"scenarios/catalogue", FileKind::experiment},
        std::pair{"scenarios/studies", FileKind::study}, std::pair{"scenarios/campaigns", FileKind::campaign}})
    for (auto const& entry : std::filesystem::directory_iterator(std::filesystem::path(THERMOTWIN_SOURCE_DIR) / folder))
      EXPECT_TRUE(entry.path().extension() != ".toml" || file_kind(read_toml(entry.path())) == kind) << entry.path();
}

TEST(FileKind, RefusesOnlyWhatIsSurelyAnother) {
  auto const said = [](std::string const& text, FileKind due) {
    return refusal([&] { refuse_other_kind(parse_toml(text, "some.toml"), due); });
  };
  std::string const machine = "name = \"a\"\n[spindle]\n[[lump]]\n";
  EXPECT_EQ(said(machine, FileKind::experiment), "some.toml: is a machine file; an experiment is due");
  EXPECT_EQ(said(machine, FileKind::measurement), "some.toml: is a machine file; a measurement file is due");
  EXPECT_EQ(said("most = 3\n", FileKind::error_model), "some.toml: is a file of candidates; an error model is due");
  EXPECT_EQ(said(machine, FileKind::machine), "accepted");
  EXPECT_EQ(said("title = \"a\"\n", FileKind::error_model), "accepted");  // most kinds have one
}

TEST(FileKind, TakesThePlaceOfItsOwnOnly) {
  tests::TemporaryDirectory const directory;
  auto const file = directory / "file.toml";
  auto const said = [&](std::string const& text, FileKind written) {
    tests::put(file, text);
    return refusal([&] { refuse_to_replace(file, written); });
  };
  std::string const machine = "name = \"a\"\n[spindle]\n[[lump]]\n", sensors = "[[temperature_sensor]]\n";
  for (auto const& [text, kind] : {std::pair{machine, FileKind::machine}, {sensors, FileKind::sensors}})
    for (auto const written : {FileKind::machine, FileKind::sensors, FileKind::error_model})
      EXPECT_EQ(said(text, written) == "accepted", kind == written) << text << int(written);
  EXPECT_EQ(said(machine, FileKind::error_model),
            file.string() + ": is a machine file, whose place an error model does not take; name another output");
  for (std::string const text : {"what the user wrote", "[tool]\n", "# a note\n"})
    EXPECT_EQ(said(text, FileKind::machine),
              file.string() + ": is something else, whose place a machine file does not take; name another output");
  EXPECT_EQ(said("", FileKind::machine), "accepted");
  EXPECT_EQ(refusal([&] { refuse_to_replace(directory / "none.toml", FileKind::machine); }), "accepted");
  EXPECT_EQ(refusal([&] { refuse_to_replace(directory.path(), FileKind::machine); }), "accepted");  // told elsewhere
}

}  // namespace
}  // namespace thermotwin::twin
