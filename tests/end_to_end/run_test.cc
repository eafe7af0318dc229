#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "output/dataset_file.h"
#include "tests/end_to_end/earlier_run.h"
#include "tests/end_to_end/program.h"
#include "tests/output/temporary_directory.h"

/// The program as its users meet it.
namespace thermotwin {
namespace {

namespace fs = std::filesystem;
using tests::answer;
using tests::TemporaryDirectory;

std::string const program = THERMOTWIN_PROGRAM;

output::Channel const& channel(std::vector<output::Channel> const& group, std::string const& name) {
  for (auto const& c : group)
    if (c.name == name) return c;
  throw std::runtime_error("no channel " + name);
}

TEST(Run, LeavesReadingsTruthHeatAndProvenance) {
  TemporaryDirectory const directory;
  answer(program + " run golden_b_6000 -q -o " + (directory / "run.h5").string());
  auto const data = output::read(directory / "run.h5");
  EXPECT_TRUE(data.complete);
  ASSERT_EQ(data.time_s.size(), 49);
  EXPECT_EQ(data.time_s[24], 4 * 3600.0);
  EXPECT_EQ(data.time_s[48], 8 * 3600.0);
  // Golden table B: after four hours the cartridge's nose has risen by 23.11 K.
  EXPECT_NEAR(channel(data.truth_readings, "T1").values[24] - 22.0, 23.11, 0.02);
  EXPECT_NEAR(channel(data.truth_displacements, "E_Z").values[24], 44.8, 0.1);
  EXPECT_NEAR(channel(data.inputs, "spindle.speed").values[10], 6000.0, 1e-9);
  EXPECT_EQ(channel(data.inputs, "spindle.speed").unit, "rpm");
  // A DS18B20 shows multiples of 1/16 K.
  double const reading = channel(data.readings, "T1").values[24];
  EXPECT_EQ(reading * 16.0, std::round(reading * 16.0));
  // physics.md 6.2: the front set makes 113 W after nearly four hours, nothing at standstill.
  EXPECT_NEAR(channel(data.heat, "bearing.front").values[23], 113.0, 1.0);
  EXPECT_EQ(channel(data.heat, "bearing.front").values[30], 0.0);
  EXPECT_LT(std::stod(data.provenance.at("energy.imbalance")), 1e-9);
  EXPECT_NE(data.provenance.at("machine.file").find("[[bearing]]"), std::string::npos);
  EXPECT_NE(data.provenance.at("experiment.file").find("[spindle]"), std::string::npos);
}

TEST(Run, SameSeedSameBytes) {
  TemporaryDirectory const directory;
  for (std::string const name : {"a.h5", "b.h5"})
    answer(program + " run golden_b_4000 -q -o " + (directory / name).string());
  EXPECT_TRUE(tests::contents(directory / "a.h5") == tests::contents(directory / "b.h5"));
  answer(program + " run golden_b_4000 -q --set experiment.seed=2 -o " + (directory / "c.h5").string());
  EXPECT_FALSE(tests::contents(directory / "a.h5") == tests::contents(directory / "c.h5"));
}

TEST(Run, SettingAParameterChangesTheRun) {
  TemporaryDirectory const directory;
  auto const rise = [&](std::string const& setting) {
    answer(program + " run golden_b_4000 -q " + setting + " -o " + (directory / "run.h5").string());
    return channel(output::read(directory / "run.h5").truth_readings, "T4").values[24];
  };
  EXPECT_GT(rise("--set bearing.front.grease_factor=0.8"), rise("") + 1.0);
  EXPECT_LT(rise("--set experiment.ambient.mean='\"20 degC\"'"), rise(""));
}

TEST(Run, TellsWhenItFindsTheShapesOfAReducedModel) {
  TemporaryDirectory const directory;
  std::string const reduced =
      "THERMOTWIN_CACHE=" + directory.path().string() + "/cache " + program + " run golden_b_4000 --reduced ";
  std::string const told = "finding the shapes of v450, once for this machine …\n";
  EXPECT_EQ(answer(reduced).find(told), 0U);
  EXPECT_EQ(answer(reduced).find(told), std::string::npos);
  fs::remove_all(directory / "cache");
  EXPECT_EQ(answer(reduced + "-q"), "");
}

TEST(Run, OpensInXarrayWithDimensionsAndUnits) {
  if (std::system("/usr/bin/python3 -c 'import xarray, h5netcdf' 2>/dev/null") != 0)
    GTEST_SKIP() << "no python3-xarray";
  TemporaryDirectory const directory;
  answer(program + " run golden_b_2000 -q --nodes -o " + (directory / "run.h5").string());
  std::ofstream(directory / "look.py") << "import sys, xarray\n"
                                          "r = xarray.open_dataset(sys.argv[1], group='readings', engine='h5netcdf')\n"
                                          "assert r.T1.dims == ('time',) and r.T1.attrs['units'] == 'degC', r\n"
                                          "assert r.time.attrs['units'] == 's' and float(r.time[-1]) == 28800.0, r\n"
                                          "n = xarray.open_dataset(sys.argv[1], group='nodes', engine='h5netcdf')\n"
                                          "assert n.temperature.dims == ('time', 'node'), n\n"
                                          "assert abs(float(n.temperature[0, 0]) - 22.0) < 1e-4, n\n"
                                          "print('good')\n";
  EXPECT_NE(answer("/usr/bin/python3 -W error::UserWarning " + (directory / "look.py").string() + " " +
                   (directory / "run.h5").string())
                .find("good"),
            std::string::npos);
}

TEST(Run, ExportsCsv) {
  TemporaryDirectory const directory;
  answer(program + " run golden_b_2000 -q -o " + (directory / "run.h5").string());
  answer(program + " export " + (directory / "run.h5").string() + " -o " + (directory / "run.csv").string());
  std::ifstream csv(directory / "run.csv");
  std::string header;
  std::getline(csv, header);
  EXPECT_TRUE(header.starts_with("time_s,")) << header;
  EXPECT_NE(header.find("T1_degC"), std::string::npos);
  EXPECT_NE(header.find("E_Z_um"), std::string::npos);
}

TEST(Run, ExportSaysThatTheLaserStaysOut) {
  TemporaryDirectory const directory;
  auto const file = (directory / "feed.h5").string();
  answer(program + " run feed_12000 -q --set experiment.duration='30 min' -o " + file);
  EXPECT_EQ(answer(program + " export " + file + " -o " + (directory / "feed.csv").string()),
            "note: a table has no place for the laser's passes along z of '" + file + "'\n");
}

/// All that is printed is one answer.
TEST(Run, FitAndPredictSpeakToPrograms) {
  TemporaryDirectory const directory;
  auto const run = (directory / "run.h5").string(), model = (directory / "model.toml").string();
  answer(program + " run golden_b_6000 -q -o " + run);
  auto const fitted =
      nlohmann::json::parse(answer(program + " fit " + run + " --error E_Z --sensors T1,T7 --json -o " + model));
  EXPECT_EQ(fitted.at("inputs"), nlohmann::json({"T1", "T7"}));
  auto const said = nlohmann::json::parse(answer(program + " predict " + model + " " + run + " --json"));
  EXPECT_EQ(said.at("model").at("fitted_to"), fitted.at("fitted_to"));
  ASSERT_EQ(said.at("runs").size(), 1);
  EXPECT_EQ(said.at("runs")[0].at("fitted_to_these_data"), true);
  EXPECT_NEAR(said.at("runs")[0].at("less_prediction").at("rmse"), fitted.at("rmse"), 1e-6);
}

TEST(Run, JsonSummaryForPrograms) {
  auto const text = answer(program + " run golden_b_2000 --json --quiet");
  EXPECT_EQ(text.front(), '{');
  EXPECT_NE(text.find("\"imbalance\""), std::string::npos);
}

/// How a command ends (waitpid) that gets Ctrl-C as soon as something holds, or after a minute.
int stopped_when(std::function<bool()> const& holds, std::vector<std::string> words) {
  pid_t const child = fork();
  if (child == 0) {
    std::vector<char*> arguments;
    for (auto& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  for (int i = 0; i < 6000 && !holds(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

TEST(Run, StoppedByTheUserKeepsThePartialFileAndTheOldOne) {
  TemporaryDirectory const directory;
  tests::put_earlier_run(directory / "run.h5");
  auto const before = tests::contents(directory / "run.h5");
  int const status = stopped_when([&] { return fs::exists(directory / "run.h5.partial"); },
                                  {program, "run", "etve", "-q", "-m", "v450", "--set", "experiment.sampling=0.1 s",
                                   "-o", (directory / "run.h5").string()});
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_TRUE(tests::contents(directory / "run.h5") == before);
  EXPECT_FALSE(output::read(directory / "run.h5.partial").complete);
}

TEST(Run, JsonOfAReducedModelHasItsBounds) {
  auto const text = answer(program + " run golden_b_2000 --reduced --json --quiet");
  auto const json = nlohmann::json::parse(text);
  EXPECT_EQ(json["duration_s"], 8 * 3600.0);
  for (auto const* group : {"readings", "displacements"}) {
    double largest = 0.0;
    for (auto const& channel : json[group]) largest = std::max(largest, double(channel["bound"]));
    EXPECT_GT(largest, 0.0) << group;
  }
}

/// While it finds its shapes, which takes seconds.
TEST(Run, AReducedRunIsStoppedAtOnce) {
  TemporaryDirectory const directory;
  int const status =
      stopped_when([&] { return fs::exists(directory / "cache"); },
                   {"env", "THERMOTWIN_CACHE=" + (directory / "cache").string(), program, "run", "spindle_random", "-q",
                    "-m", "v450_fine", "--reduced", "-o", (directory / "run.h5").string()});
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGINT);
  EXPECT_FALSE(fs::exists(directory / "run.h5"));
}

/// What reads measurements writes nothing before its end: at a step of a fit it says so, before the first one it just
/// ends.
TEST(Commands, DiagnosisIsStoppedAtOnce) {
  TemporaryDirectory const directory;
  auto const data = (directory / "run.h5").string(), amended = (directory / "amended.toml").string();
  answer(program + " run golden_b_4000 -q -o " + data);
  auto const is_stopped = [](int status) {
    return WIFEXITED(status) ? WEXITSTATUS(status) == 130 : WTERMSIG(status) == SIGINT;
  };
  int status = 0;
  for (int wait = 200; wait > 0 && !is_stopped(status); wait /= 2) {  // on a machine that is faster, earlier
    auto const soon = std::chrono::steady_clock::now() + std::chrono::milliseconds(wait);
    fs::remove(amended);
    status = stopped_when([&] { return std::chrono::steady_clock::now() > soon; },
                          {program, "diagnose", "v450", data, "-o", amended});
  }
  EXPECT_TRUE(is_stopped(status));
  EXPECT_FALSE(fs::exists(amended));
}

TEST(Commands, CheckEveryShippedFile) {
  fs::path const source = THERMOTWIN_SOURCE_DIR;
  for (auto const& folder : {source / "twin/machines", source / "scenarios/catalogue"})
    for (auto const& entry : fs::directory_iterator(folder)) {
      bool const needs_data = tests::contents(entry.path()).find("MEASURED_DATA") != std::string::npos;
      if (entry.path().extension() != ".toml" || needs_data) continue;
      EXPECT_NE(answer(program + " check " + entry.path().string()).find("no mistake found"), std::string::npos);
    }
}

TEST(Commands, DescribeAndEffectsReadTheCatalogue) {
  auto const machine = answer(program + " describe machine");
  for (std::string const word : {"hollow_cylinder", "grease_factor", "temperature_sensor", "closure"})
    EXPECT_NE(machine.find(word), std::string::npos) << word;
  EXPECT_NE(answer(program + " describe experiment").find("of_maximum"), std::string::npos);
  for (auto const& [file, key] : {std::pair("model", "highest_K"),
                                  {"study", "selections"},
                                  {"campaign", "latin_hypercube"},
                                  {"candidates", "forbidden"},
                                  {"measurement", "clock_offset"},
                                  {"materials", "GJL-250"},
                                  {"channels", "ambient.temperature"}})
    EXPECT_NE(answer(program + " describe " + file).find(key), std::string::npos) << file;
  EXPECT_NE(answer(program + " effects").find("ball_nut"), std::string::npos);
  EXPECT_NE(answer(program + " effects bearing").find("Palmgren"), std::string::npos);
}

}  // namespace
}  // namespace thermotwin
