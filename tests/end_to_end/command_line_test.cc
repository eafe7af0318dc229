#include <gtest/gtest.h>
#include <string>
#include <utility>

#include "tests/end_to_end/program.h"

/// What the program says to words that are none of its own, too few or too many, and to those that ask for help.
namespace thermotwin {
namespace {

using tests::run_program;

TEST(CommandLine, CommandsThatLackSomething) {
  struct Row {
    std::string arguments, message;
  };
  for (auto const& [arguments, message] :
       {Row{"", "a command is due; thermotwin --help lists them"},
        Row{"run", "run: experiment is required; thermotwin run --help tells more\n"},
        Row{"describe", "describe: what is required; thermotwin describe --help tells more\n"},
        Row{"view", "view: data is required; thermotwin view --help tells more\n"},
        Row{"challenge", "challenge: one of --output and --key is due, and no other; thermotwin challenge --help"},
        Row{"challenge --key -o x", "challenge: one of --output and --key is due, and no other; thermotwin"},
        Row{"place --experiments golden_b_4000 v450 -k 3",
            "place: machine is required, and --experiments took 'golden_b_4000', 'v450', as all words up to the next"},
        Row{"diagnose v450 --hold-out b.h5 a.h5", "diagnose needs measured runs, and --hold-out took all words"},
        Row{"volumetric mill200 --at 600s", "volumetric: --at requires --run"},
        Row{"diagnose v450 --plan etve -o amended.toml", "diagnose: --output excludes --plan"},
        Row{"diagnose v450 --plan etve --start 3", "diagnose: --start excludes --plan"},
        Row{"challenge --key --run etve", "challenge: --run excludes --key"}}) {
    auto const answer = run_program(arguments);
    EXPECT_EQ(answer.code, 2) << arguments;
    EXPECT_NE(answer.text.find(message), std::string::npos) << answer.text;
  }
}

/// What follows their value is not theirs.
TEST(CommandLine, OptionsThatTakeOneWord) {
  for (std::string const arguments :
       {"run --set experiment.seed=2 none", "volumetric --set volumetric.drawn.seed=2 none",
        "diagnose --without heat,radiation none a.h5", "figure -p heat --only A none.h5 -o x.svg",
        "fit --sensors T1,T2 none.h5 -o x.toml"}) {
    auto const answer = run_program(arguments);
    EXPECT_EQ(answer.code, 2) << arguments;
    EXPECT_NE(answer.text.find("none"), std::string::npos) << arguments << "\n" << answer.text;
    EXPECT_EQ(answer.text.find("required"), std::string::npos) << arguments << "\n" << answer.text;
  }
}

TEST(CommandLine, OptionsBeforeTheirCommand) {
  for (auto const& [arguments, shown] : {std::pair{"--json run golden_b_2000", "run --json ..."},
                                         {"-m v450 run golden_b_2000", "run -m ..."},
                                         {"--tolerance=1e-5 run golden_b_2000", "run --tolerance ..."},
                                         {"--hold-out a.h5 run golden_b_2000", "diagnose --hold-out ..."},
                                         {"--checkpoint '2 h'", "run --checkpoint ..."}}) {
    auto const answer = run_program(arguments);
    EXPECT_EQ(answer.code, 2) << arguments;
    EXPECT_NE(answer.text.find(std::string("' is an option of a command: thermotwin ") + shown), std::string::npos)
        << answer.text;
  }
}

TEST(CommandLine, HelpSaysOfWhichOptionsOneIsDue) {
  auto const help = run_program("challenge --help").text;
  EXPECT_NE(help.find("\nOne of these is due:\n  -o,--output TEXT "), std::string::npos) << help;
  EXPECT_EQ(help.find('['), help.find("[OPTIONS]")) << help;
  EXPECT_EQ(help.rfind('['), help.find("[OPTIONS]")) << help;
}

TEST(CommandLine, HelpAndVersionUnderTheirOtherNames) {
  EXPECT_EQ(run_program("help").text, run_program("--help").text);
  EXPECT_EQ(run_program("help run").text, run_program("run --help").text);
  EXPECT_EQ(run_program("-v").text, run_program("--version").text);
}

TEST(CommandLine, NumbersThatCannotBe) {
  for (std::string const tolerance : {"-1", "0", "5", "nan", "abc"}) {
    auto const answer = run_program("run golden_b_2000 --tolerance " + tolerance);
    EXPECT_EQ(answer.code, 2);
    EXPECT_NE(answer.text.find("allowed is 1e-12 to 0.01"), std::string::npos) << answer.text;
  }
  for (std::string const command : {"volumetric mill200", "challenge --key", "place v450 -k 3", "fit a.h5 -o m.toml"}) {
    auto const answer = run_program(command + " --seed -1");
    EXPECT_EQ(answer.code, 2) << command;
    EXPECT_NE(answer.text.find("-1 is negative"), std::string::npos) << answer.text;
  }
}

TEST(CommandLine, NumbersTooLargeForWhatTheyCount) {
  struct Row {
    std::string arguments, message;
  };
  for (auto const& [arguments, message] :
       {Row{"challenge --key --seed 99999999999999999999", "99999999999999999999 is more than 18446744073709551615"},
        Row{"run golden_b_2000 --set experiment.seed=99999999999999999999", "a whole number without unit is due"},
        Row{"run golden_b_2000 --set experiment.seed=4294967297", "'seed' is 4294967297; allowed is"},
        Row{"run golden_b_2000 --set 'experiment.sampling=1 us'", "at most 1e+08 are possible"},
        Row{"run golden_b_2000 --fields fields --field-interval '0 s'", "--field-interval 0 s: a time above 0 is due"},
        Row{"place v450 -k 3 --noise 0.1", "--noise: 0.1 has no unit; write for example \"0.2 K\""},
        Row{"volumetric mill200 --resolution '1 K'",
            "--resolution: '1 K' is a temperature difference; a length is due"},
        Row{"place v450 -k 3 --unseen 0", "0 unseen members; at least 1 is due"},
        Row{"place v450 -k three", "'three' is no whole number; one is due"},
        Row{"figure a.h5 -p heat -o x.svg --height 5", "figure: --height: 5 is out of range; allowed is 20 to 1000 mm"},
        Row{"figure a.h5 -p heat -o x.svg --width wide", "'wide' is no number; allowed is 30 to 1000 mm"},
        Row{"view a.h5 --port 99999", "view: --port: 99999 is out of range; allowed is 0 to 65535"}}) {
    auto const answer = run_program(arguments);
    EXPECT_EQ(answer.code, 2) << arguments;
    EXPECT_NE(answer.text.find(message), std::string::npos) << answer.text;
  }
}

/// An unset variable of a script must not make a run whose output goes nowhere.
TEST(CommandLine, EmptyWords) {
  for (std::string const arguments :
       {"run golden_b_2000 -o ''", "run golden_b_2000 -m ''", "run ''", "export a.h5 -o ''", "fit a.h5 -o ''",
        "challenge -o ''", "place v450 -k 3 --propose ''"}) {
    auto const answer = run_program(arguments);
    EXPECT_EQ(answer.code, 2) << arguments;
    EXPECT_NE(answer.text.find("an empty text; a value is due"), std::string::npos) << arguments << "\n" << answer.text;
  }
}

TEST(CommandLine, NamesTooLongForAFile) {
  std::string const name(300, 'x');
  for (std::string const& arguments : {"fit " + name + ".csv -o model.toml", "run golden_b_2000 -o " + name + ".h5"}) {
    auto const answer = run_program(arguments);
    EXPECT_EQ(answer.code, 2) << arguments;
    EXPECT_NE(answer.text.find("File name too long"), std::string::npos) << answer.text;
  }
}

/// What is printed through either of the two streams of the library.
TEST(CommandLine, StandardOutputThatIsFull) {
  for (std::string const arguments : {"describe channels", "effects", "--version", "run --help"}) {
    auto const answer = tests::run_command(std::string(THERMOTWIN_PROGRAM) + " " + arguments + " 2>&1 >/dev/full");
    EXPECT_EQ(answer.code, 2) << arguments;
    EXPECT_NE(answer.text.find("cannot write to standard output"), std::string::npos) << arguments << answer.text;
  }
}

TEST(CommandLine, StandardErrorThatIsFullChangesNothing) {
  EXPECT_EQ(tests::run_command(std::string(THERMOTWIN_PROGRAM) + " run none 2>/dev/full").code, 2);
}

}  // namespace
}  // namespace thermotwin
