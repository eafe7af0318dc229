#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <regex>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include "output/dataset_file.h"
#include "tests/end_to_end/program.h"
#include "tests/output/temporary_directory.h"

/// Campaigns, checkpoints and replays, as their users meet them, and as SIGKILL does.
namespace thermotwin {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using tests::answer;
using tests::contents;
using tests::TemporaryDirectory;

std::string const program = THERMOTWIN_PROGRAM;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// 200 runs of a day.
fs::path campaign_of_200(TemporaryDirectory const& directory) {
  tests::put(directory / "campaign.toml", R"toml(
experiments = ["spindle_random"]
machine = "v450"
set = ["experiment.duration=24 h", "experiment.spindle.random.run=24 h"]
every = "10 min"
part = 30

[latin_hypercube]
count = 200

[[latin_hypercube.vary]]
path = "bearing.front.grease_factor"
from = 0.4
to = 0.8

[[latin_hypercube.vary]]
path = "experiment.ambient.mean"
from = "18 degC"
to = "26 degC"
)toml");
  return directory / "campaign.toml";
}

/// What a campaign leaves, by path.
std::map<std::string, std::string> files_in(fs::path const& folder) {
  std::map<std::string, std::string> files;
  for (auto const& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files[fs::relative(entry.path(), folder).string()] = contents(entry.path());
  return files;
}

/// Files that only one of two folders has, or that are not the same there.
std::vector<std::string> differing(std::map<std::string, std::string> const& one,
                                   std::map<std::string, std::string> const& other) {
  std::vector<std::string> names;
  for (auto const& [name, bytes] : one)
    if (!other.contains(name) || other.at(name) != bytes) names.push_back(name);
  for (auto const& [name, bytes] : other)
    if (!one.contains(name)) names.push_back(name);
  return names;
}

pid_t start(std::vector<std::string> words) {
  pid_t const child = fork();
  if (child != 0) return child;
  std::vector<char*> arguments;
  for (auto& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  if (!freopen("/dev/null", "w", stdout) || !freopen("/dev/null", "w", stderr)) _exit(126);
  execvp(arguments[0], arguments.data());
  _exit(127);
}

bool was_killed(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status) || (WIFEXITED(status) && WEXITSTATUS(status) != 0);
}

void wait(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

/// The processes that a process has started.
std::vector<pid_t> children_of(pid_t parent) {
  std::vector<pid_t> children;
  for (auto const& entry : fs::directory_iterator("/proc")) {
    std::ifstream file(entry.path() / "stat");
    std::string number, name, state;
    pid_t of = 0;
    if (file >> number >> name >> state >> of && of == parent) children.push_back(std::stoi(number));
  }
  return children;
}

/// What was_killed says of a launcher; one that has not ended after `seconds` is killed with all that it has started.
bool was_killed_within(double seconds, pid_t launcher) {
  auto const begin = Clock::now();
  siginfo_t ended{};
  while (seconds_since(begin) < seconds && ended.si_pid == 0) {
    wait(0.01);
    waitid(P_PID, id_t(launcher), &ended, WEXITED | WNOHANG | WNOWAIT);
  }
  if (ended.si_pid == 0) {
    auto const ranks = children_of(launcher);
    kill(launcher, SIGKILL);
    for (pid_t const rank : ranks) kill(rank, SIGKILL);
  }
  return was_killed(launcher);
}

/// How long the program takes before its first run, and for all 200.
struct Undisturbed {
  double start, whole;
  std::map<std::string, std::string> files;
};

Undisturbed undisturbed(TemporaryDirectory const& directory, std::string const& file) {
  Undisturbed result;
  auto begin = Clock::now();
  answer(program + " campaign " + file + " --show 0");
  result.start = seconds_since(begin);
  begin = Clock::now();
  auto const text = answer(program + " campaign " + file + " -o " + (directory / "whole").string());
  EXPECT_NE(text.find("200 runs, 0 of them failed"), std::string::npos) << text;
  EXPECT_TRUE(std::regex_search(text, std::regex("[0-9.]+ ms of a thread each, and [0-9.]+ ms for the campaign\n")))
      << text;
  result.whole = seconds_since(begin) - result.start;
  result.files = files_in(directory / "whole");
  return result;
}

/// One that ends before it is killed begins anew: how fast the machine is decides nothing.
TEST(CampaignCommand, KilledTwentyTimesItLeavesTheSameBytes) {
  TemporaryDirectory const directory;
  std::string const file = campaign_of_200(directory), folder = directory / "killed";
  auto const expected = undisturbed(directory, file);
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> moment(0.5 * expected.start, expected.start + 0.08 * expected.whole);
  int killed = 0;
  for (int tries = 0; killed < 20 && tries < 200; ++tries) {
    pid_t const child = start({program, "campaign", file, "-q", "-o", folder});
    wait(moment(random));
    kill(child, SIGKILL);
    if (was_killed(child))
      ++killed;
    else
      fs::remove_all(folder);
  }
  EXPECT_EQ(killed, 20);
  answer(program + " campaign " + file + " -q -o " + folder);
  EXPECT_THAT(differing(files_in(folder), expected.files), testing::IsEmpty());
}

TEST(CampaignCommand, ARankKilledUnderMpirunLeavesTheSameBytes) {
  if (std::system("mpirun --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "no mpirun";
  setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
  setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
  TemporaryDirectory const directory;
  std::string const file = campaign_of_200(directory), folder = directory / "ranks";
  auto const expected = undisturbed(directory, file);
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> moment(0.0, 0.2 * expected.whole);
  std::vector<std::string> const words = {"mpirun", "-np", "2",   "--oversubscribe", program, "campaign", file,
                                          "-q",     "-o",  folder};
  int killed = 0;
  for (int k = 0; k < 3; ++k) {
    pid_t const child = start(words);
    for (int tries = 0; tries < 500 && !fs::exists(folder + "/manifest.json"); ++tries) wait(0.01);
    wait(moment(random));
    auto const ranks = children_of(child);
    if (ranks.size() == 2) kill(ranks[std::size_t(k % 2)], SIGKILL);
    killed += was_killed_within(100, child) ? 1 : 0;
  }
  EXPECT_GE(killed, 1);
  EXPECT_FALSE(was_killed_within(400, start(words)));
  EXPECT_THAT(differing(files_in(folder), expected.files), testing::IsEmpty());
}

TEST(CampaignCommand, SharesOfAnArrayMakeTheWhole) {
  TemporaryDirectory const directory;
  std::string const file = campaign_of_200(directory), folder = directory / "array";
  auto const expected = undisturbed(directory, file);
  for (std::string const share : {"1/3", "0/3", "2/3"})
    answer(program + " campaign " + file + " -q --array " + share + " -o " + folder);
  EXPECT_THAT(differing(files_in(folder), expected.files), testing::IsEmpty());
  EXPECT_NE(answer(program + " campaign " + file + " --array 3/3 -o " + folder, 2).find("3/16"), std::string::npos);
}

TEST(CampaignCommand, RanksOfALauncherMakeTheWhole) {
  TemporaryDirectory const directory;
  std::string const file = campaign_of_200(directory), folder = directory / "ranks";
  auto const expected = undisturbed(directory, file);
  auto const rank = [&](std::string const& environment, int exit = 0) {
    return answer("env " + environment + " " + program + " campaign " + file + " -o " + folder, exit);
  };
  EXPECT_NE(rank("OMPI_COMM_WORLD_RANK=0 OMPI_COMM_WORLD_SIZE=3").find("by rank 0 of 3"), std::string::npos);
  EXPECT_EQ(rank("PMI_RANK=2 PMI_SIZE=3"), "");
  auto const last = rank("SLURM_PROCID=1 SLURM_STEP_NUM_TASKS=3");
  EXPECT_NE(last.find("by rank 1 of 3"), std::string::npos) << last;
  EXPECT_NE(last.find("200 runs, 0 of them failed"), std::string::npos) << last;
  EXPECT_THAT(differing(files_in(folder), expected.files), testing::IsEmpty());
  auto const wrong = rank("PMI_RANK=3 PMI_SIZE=3", 2);
  EXPECT_NE(wrong.find("PMI_RANK/PMI_SIZE in the environment: '3/3'"), std::string::npos) << wrong;
}

/// A motor of a megawatt, which the check does not run.
TEST(CampaignCommand, OfWhichNoRunCouldBeMadeEndsWithOne) {
  TemporaryDirectory const directory;
  auto const file = directory / "campaign.toml";
  tests::put(file,
             "experiments = [\"golden_b_4000\"]\nmachine = \"v450\"\nkeep = [\"summary\"]\n"
             "set = [\"motor_loss.stator.constant=1 MW\"]\n[[grid]]\npath = \"experiment.ambient.mean\"\n"
             "values = [\"18 degC\", \"20 degC\"]\n");
  auto const command = program + " campaign " + file.string() + " -o " + (directory / "out").string();
  auto const text = answer(command, 1);
  EXPECT_NE(text.find("2 runs, 2 of them failed"), std::string::npos) << text;
  auto const said =
      "no run of the campaign could be made; '" + (directory / "out/failures.csv").string() + "' says why";
  EXPECT_NE(text.find(said), std::string::npos) << text;
  EXPECT_NE(answer(command + " -q", 1).find(said), std::string::npos);
}

/// The campaign's numbers are those of the run that it says it made.
TEST(CampaignCommand, ShowsTheCommandOfARun) {
  TemporaryDirectory const directory;
  std::string const file = campaign_of_200(directory);
  auto command = answer(program + " campaign " + file + " --show 123");
  ASSERT_TRUE(command.starts_with("thermotwin run ")) << command;
  command = program + command.substr(10, command.size() - 11);
  answer(command + " -q -o " + (directory / "run.h5").string());
  auto const run = output::read(directory / "run.h5");
  answer(program + " campaign " + file + " -q -o " + (directory / "all").string());
  if (std::system("/usr/bin/python3 -c 'import xarray, h5netcdf' 2>/dev/null") != 0)
    GTEST_SKIP() << "no python3-xarray";
  std::ofstream(directory / "look.py") << "import sys, xarray, numpy\n"
                                          "a = xarray.open_dataset(sys.argv[1], engine='h5netcdf')\n"
                                          "assert a.readings.dims == ('run', 'time', 'reading'), a\n"
                                          "assert a.sizes['run'] == 200, a\n"
                                          "r = xarray.open_dataset(sys.argv[2], group='readings', engine='h5netcdf')\n"
                                          "for i, name in enumerate(a.reading.values):\n"
                                          "    x = a.readings[123, :, i].values\n"
                                          "    assert (x == r[name].values.astype(numpy.float32)).all(), name\n"
                                          "print('good')\n";
  EXPECT_NE(answer("/usr/bin/python3 -W error::UserWarning " + (directory / "look.py").string() + " " +
                   (directory / "all/campaign.h5").string() + " " + (directory / "run.h5").string())
                .find("good"),
            std::string::npos);
}

/// Killed at the third checkpoint that it writes, of a hundred, each time that it goes on.
TEST(RunCommand, KilledAndResumedGivesTheSameBytes) {
  TemporaryDirectory const directory;
  auto const command = [&](std::string const& name) {
    return program + " run golden_b_4000 -q --set experiment.duration='2000 h' --checkpoint '20 h' -o " +
           (directory / name).string();
  };
  answer(command("whole.h5"));
  fs::path const run = directory / "killed.h5";
  auto const kept = [&] {
    std::error_code none_yet;
    return fs::file_size(directory / "killed.h5.checkpoint", none_yet);
  };
  int killed = 0;
  for (int tries = 0; killed < 3 && tries < 30; ++tries) {
    pid_t const child = start({"sh", "-c", "exec " + command("killed.h5") + " --resume"});
    for (int written = 0; written < 3; ++written) {
      auto const before = kept();
      for (int i = 0; i < 10000 && kept() == before && !fs::exists(run); ++i) wait(0.001);
    }
    kill(child, SIGKILL);
    if (was_killed(child)) {
      ++killed;
      EXPECT_FALSE(fs::exists(run));
    } else {
      fs::remove(run);  // it was faster than the signal: once more
    }
  }
  EXPECT_EQ(killed, 3);
  EXPECT_NE(answer(command("killed.h5"), 2).find("go on with --resume"), std::string::npos);
  answer(command("killed.h5") + " --resume");
  EXPECT_TRUE(contents(run) == contents(directory / "whole.h5"));
  EXPECT_FALSE(fs::exists(directory / "killed.h5.checkpoint"));
}

/// As a job script does that always gives both options.
TEST(RunCommand, ResumesOnlyWhatIsNotFinished) {
  TemporaryDirectory const directory;
  auto const run = (directory / "run.h5").string();
  std::string const resume = program + " run golden_b_2000 -q --resume -o " + run;
  auto const begun = answer(resume, 2);
  EXPECT_NE(begun.find("there is no checkpoint '" + run + ".checkpoint' to go on from: the run was never begun"),
            std::string::npos)
      << begun;
  answer(resume + " --checkpoint '2 h'");
  auto const before = contents(run);
  for (std::string const again : {"", " --checkpoint '2 h'", " --checkpoint '3 h' --set experiment.seed=2"}) {
    auto const said = answer(resume + again, 2);
    EXPECT_NE(said.find("'" + run + "' is finished"), std::string::npos) << said;
    EXPECT_TRUE(contents(run) == before) << again;
    EXPECT_EQ(directory.files(), std::vector<std::string>{"run.h5"}) << again;
  }
}

/// What a stopped run left goes with the next one that ends, however that one was asked for.
TEST(RunCommand, LeavesNoCheckpointOfAnEarlierOne) {
  TemporaryDirectory const directory;
  auto const run = (directory / "run.h5").string();
  pid_t const child = start({"sh", "-c",
                             "exec " + program + " run golden_b_4000 --set experiment.duration='20000 h' " +
                                 "--checkpoint '20 h' -o " + run + " 2> " + (directory / "said").string()});
  for (int i = 0; i < 10000 && !fs::exists(run + ".checkpoint"); ++i) wait(0.001);
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_NE(contents(directory / "said").find("the same command with --resume goes on from the last checkpoint"),
            std::string::npos);
  fs::remove(directory / "said");
  auto const left = contents(run + ".checkpoint");
  for (std::string const option : {"", " --reduced"}) {
    tests::put(run + ".checkpoint", left);
    answer(program + " run golden_b_2000 -q -o " + run + option);
    EXPECT_EQ(directory.files(), std::vector<std::string>{"run.h5"}) << option;
  }
}

TEST(ReplayCommand, MakesARunAnewFromItsOutputAlone) {
  TemporaryDirectory const directory;
  fs::create_directory(directory / "gone");
  fs::path const source = THERMOTWIN_SOURCE_DIR;
  tests::put(directory / "gone/mine.toml", contents(source / "twin/machines/v450.toml"));
  tests::put(directory / "gone/speed.csv", "time_s,n\n0,1000\n3600,5000\n7200,2000\n");
  tests::put(directory / "gone/experiment.toml", R"toml(
machine = "mine.toml"
duration = "2 h"
[[recorded]]
file = "speed.csv"
max_gap = "2 h"
columns = [{column = "n", channel = "spindle.speed", unit = "rpm"}]
)toml");
  std::string const run = directory / "run.h5";
  answer(program + " run " + (directory / "gone/experiment.toml").string() + " -q --nodes --tolerance 1e-5 " +
         "--set bearing.front.grease_factor=0.7 --set experiment.seed=4 -o " + run);
  fs::remove_all(directory / "gone");
  EXPECT_NE(answer(program + " replay " + run).find("the same bytes"), std::string::npos);
  auto data = output::read(run);
  data.readings[0].values[7] += 0.5;
  output::write(data, run);
  auto const text = answer(program + " replay " + run, 1);
  EXPECT_NE(text.find("reading " + data.readings[0].name + ": up to 0.5 degC"), std::string::npos) << text;
  data.provenance.erase("machine.file");
  output::write(data, run);
  EXPECT_NE(answer(program + " replay " + run, 2).find("'machine.file'"), std::string::npos);
}

}  // namespace
}  // namespace thermotwin
