#include "twin/diagnosis/diagnose_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "output/dataset_file.h"
#include "tests/output/temporary_directory.h"
#include "tests/scenarios/refusal.h"
#include "tests/twin/diagnosis/diagnosis_bench.h"
#include "twin/diagnosis/comparison.h"
#include "twin/diagnosis/diagnosis_json.h"
#include "twin/diagnosis/linearised_run.h"
#include "twin/diagnosis/run_files.h"

/// The whole way of a user: files in, a verdict and an amended file out.
namespace thermotwin::twin {
namespace {

using testing::AnyOf;
using testing::HasSubstr;
using testing::StartsWith;
using thermotwin::tests::contents;
using thermotwin::tests::refusal;
using thermotwin::tests::TemporaryDirectory;

constexpr char const* heat = R"(
[[heat]]
name = "cabinet"
at = "column_rear"
power = "60 W"
while_on = "machine.on"
)";

output::Dataset made(Value const& document, std::string const& blocks, std::string const& seed) {
  auto const experiment = tests::experiment("duration = \"8 h\"\nseed = " + seed + "\nspindle.blocks = " + blocks);
  return run(Machine::build(document), experiment, {}).dataset;
}

/// A machine with 60 W in its column, measured in two runs by the same instruments; its file knows nothing of them.
/// Diagnosed once for all tests.
class DiagnoseFilesTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = std::make_unique<TemporaryDirectory>();
    thermotwin::tests::put(*folder / "mine.toml", contents(machine_file("v450")));
    Value const truth = tests::with_table(read_toml(machine_file("v450")), heat);
    output::write(made(truth, R"([{duration = "4 h", speed = "5000 rpm"}, {duration = "4 h", speed = "0 rpm"}])", "1"),
                  *folder / "run1.h5");
    output::write(made(truth, R"([{duration = "2 h", speed = "0 rpm"}, {duration = "6 h", speed = "3000 rpm"}])", "1"),
                  *folder / "unseen.h5");
    DiagnoseFiles files{
        *folder / "mine.toml", {*folder / "run1.h5"}, {*folder / "unseen.h5"}, *folder / "amended.toml", {}, {}};
    files.show = [&](DiagnosisReport const& found) {
      EXPECT_FALSE(std::filesystem::exists(files.output));  // what was found outlives that it cannot be written
      shown = report_text(found);
    };
    report = diagnose_files(files);
  }
  static void TearDownTestSuite() { folder.reset(); }

  static std::unique_ptr<TemporaryDirectory> folder;
  static DiagnosisReport report;
  static std::string shown;
};

std::unique_ptr<TemporaryDirectory> DiagnoseFilesTest::folder;
DiagnosisReport DiagnoseFilesTest::report;
std::string DiagnoseFilesTest::shown;

/// In eight hours it may as well be a neighbour that is always as hot.
TEST_F(DiagnoseFilesTest, SteadyHeatOfTheColumnIsMissing) {
  ASSERT_EQ(report.diagnosis.explanations.size(), 1);
  for (auto const& finding : report.diagnosis.explanations[0].alternatives)
    EXPECT_THAT(finding.hypothesis.label(), AnyOf("heat at column_rear", "hot_neighbour at column_rear"));
}

TEST_F(DiagnoseFilesTest, AmendedFileIsTheMachineThatWasDiagnosed) {
  Machine const written = Machine::read(*folder / "amended.toml");
  Machine const meant = Machine::build(report.diagnosis.document);
  ASSERT_EQ(written.network().parts().size(), meant.network().parts().size());
  auto const run = read_measured_run(*folder / "run1.h5", meant);
  auto const binned = bin(run, fitting_interval(run));
  Eigen::MatrixXd const difference =
      LinearisedRun(written, binned).prediction() - LinearisedRun(meant, binned).prediction();
  for (std::size_t c = 0; c < run.channels.size(); ++c)
    EXPECT_LT(difference.col(Eigen::Index(c)).cwiseAbs().maxCoeff(), run.channels[c].displacement ? 1e-9 : 1e-4)
        << run.channels[c].name;
}

TEST_F(DiagnoseFilesTest, AmendedFileSaysWhatWasFoundAndWhere) {
  std::string const text = contents(*folder / "amended.toml");
  auto const& effect = report.diagnosis.effects.at(0);
  EXPECT_THAT(text, HasSubstr("[[" + effect.effect->name + "]]\nname = \"diagnosed_1\"\n"));
  EXPECT_THAT(text, HasSubstr("# Diagnosed from run1.h5: " + effect.effect->meaning));
  EXPECT_THAT(text, HasSubstr("2 ln of the evidence"));
  EXPECT_THAT(text, HasSubstr("growth_factor: ± "));
  EXPECT_THAT(text, HasSubstr("# was 0.55; ± 0."));
  Machine const written = Machine::read(*folder / "amended.toml"), meant = Machine::build(report.diagnosis.document);
  for (std::size_t s = 0; s < written.sensors.size(); ++s)  // machines are held to follow their data: so are sensors
    EXPECT_NEAR(written.sensors[s].description.lag.value(), meant.sensors[s].description.lag.value(), 1e-3);
  EXPECT_THAT(text, HasSubstr(" s\"  # ± "));
}

TEST_F(DiagnoseFilesTest, IsShownAsItIsGivenBack) { EXPECT_EQ(shown, report_text(report)); }

TEST_F(DiagnoseFilesTest, DoubtsOfTheDataAreToldFirst) {
  EXPECT_TRUE(report.doubts.empty());
  DiagnosisReport doubted = report;
  doubted.doubts = {{"run1", "E_Z", "E_Z moves against the machine"}};
  EXPECT_THAT(report_text(doubted), StartsWith(doubt_lines(doubted.doubts)));
  EXPECT_THAT(report_json(doubted), HasSubstr(R"("text": "E_Z moves against the machine")"));
}

TEST_F(DiagnoseFilesTest, GapShrinksOnTheUnseenRun) {
  auto const comparison = compare_files(*folder / "mine.toml", *folder / "amended.toml", {*folder / "unseen.h5"});
  auto const kelvin = total(comparison, "K"), micrometres = total(comparison, "um");
  EXPECT_LT(kelvin.after, 0.5 * kelvin.before);
  EXPECT_LT(micrometres.after, 0.5 * micrometres.before);
}

TEST_F(DiagnoseFilesTest, RunsOfOneNameAreToldApart) {
  std::vector<std::filesystem::path> files;
  for (auto const* name : {"a", "b"}) {
    std::filesystem::create_directory(*folder / name);
    files.push_back(*folder / name / "run.h5");
    std::filesystem::copy_file(*folder / "run1.h5", files.back());
  }
  auto const compared = compare_files(*folder / "mine.toml", *folder / "mine.toml", files).runs;
  EXPECT_EQ(compared[0].name, "a/run");
  EXPECT_EQ(compared[1].name, "b/run");
  std::vector<std::string> remarks;
  EXPECT_EQ(read_runs({files[0]}, Machine::read(*folder / "mine.toml"), remarks, {files[1]})[0].name, "a/run");
  EXPECT_EQ(names_of(files), "a/run.h5, b/run.h5");
}

TEST_F(DiagnoseFilesTest, FilesThatAreReadAreNeverWritten) {
  EXPECT_EQ(contents(*folder / "mine.toml"), contents(machine_file("v450")));
  for (auto const* name : {"mine.toml", "run1.h5", "unseen.h5"}) {
    std::string const before = contents(*folder / name);
    EXPECT_THAT(refusal([&] {
                  (void)diagnose_files(
                      {*folder / "mine.toml", {*folder / "run1.h5"}, {*folder / "unseen.h5"}, *folder / name, {}, {}});
                }),
                HasSubstr("never overwritten"));
    EXPECT_EQ(contents(*folder / name), before);
  }
}

}  // namespace
}  // namespace thermotwin::twin
