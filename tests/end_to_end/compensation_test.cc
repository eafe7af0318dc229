#include <algorithm>
#include <array>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <regex>

#include "output/dataset_file.h"
#include "tests/end_to_end/broker_process.h"
#include "tests/end_to_end/program.h"
#include "tests/output/temporary_directory.h"
#include "thermal/error.h"
#include "twin/compensation/broker.h"
#include "twin/compensation/reading.h"

/// `thermotwin fit`, `compensate` and `play` over a real broker.
namespace thermotwin {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using tests::answer;
using tests::BrokerProcess;
using tests::Child;
using tests::TemporaryDirectory;
using twin::Broker;
using twin::BrokerOptions;

std::string const program = THERMOTWIN_PROGRAM;

/// The number behind that word in what `play` prints.
double figure(std::string const& text, std::string const& word) {
  std::smatch match;
  return std::regex_search(text, match, std::regex("\\b" + word + " +([0-9.]+)")) ? std::stod(match[1]) : -1.0;
}

BrokerOptions named(std::string const& url, std::string const& client) {
  BrokerOptions options;
  options.url = url;
  options.client = client;
  return options;
}

/// RMS of what `play` calls compensated [um]. The largest depends on how late this computer's processes are; it is
/// held in the tests of the loop without a broker.
double compensated_rms(std::string const& text) {
  std::smatch match;
  return std::regex_search(text, match, std::regex("\\bcompensated +[0-9.]+ +([0-9.]+)")) ? std::stod(match[1]) : 1e9;
}

// --- the loop --------------------------------------------------------------------------------------------------------

class LiveCompensation : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    directory_ = new TemporaryDirectory;
    answer(program + " run duty_003 --set 'experiment.sampling=\"30 s\"' -q -o " + at("duty.h5"));
    answer(program + " run duty_003_other -q -o " + at("other.h5"));
    answer(program + " fit " + at("other.h5") + " --error E_X --sensors T2,T4,T10,T12,T15 -o " + at("model.toml"));
  }
  static void TearDownTestSuite() { delete directory_; }
  static std::string at(std::string const& name) { return (*directory_ / name).string(); }

  [[nodiscard]] std::vector<std::string> compensation(std::vector<std::string> const& with,
                                                      std::string const& speed) const {
    std::vector<std::string> command{program,   "compensate", "--broker", broker_.url(), "--speed", speed,
                                     "--cycle", "30 s",       "--stale",  "5 min",       "--stuck", "8 min"};
    command.insert(command.end(), with.begin(), with.end());
    return command;
  }

  /// The duty with somebody who compensates. What `play` and `compensate` print.
  std::array<std::string, 2> played(std::vector<std::string> const& with, std::string const& run = "duty.h5",
                                    std::string const& speed = "1500") {
    Child compensate(compensation(with, speed), at("compensate"));
    auto const text = answer(program + " play " + at(run) + " -q --speed " + speed + " --broker " + broker_.url() +
                             " -o " + at("played.csv"));
    EXPECT_EQ(compensate.end(SIGINT), 0);
    return {text, tests::contents(at("compensate"))};
  }

  TemporaryDirectory broker_directory_;
  BrokerProcess broker_{broker_directory_.path().string()};
  static TemporaryDirectory* directory_;
};
TemporaryDirectory* LiveCompensation::directory_ = nullptr;

TEST_F(LiveCompensation, BringsTheDiameterDownWithAModelOfAnotherDuty) {
  auto const [play, compensate] = played({"--model", at("model.toml"), "--record", at("live.h5")});
  auto const record = output::read(at("live.h5"));
  EXPECT_EQ(record.readings.size(), 5U);
  EXPECT_GT(record.time_s.size(), 100);
  for (auto const& channel : record.displacements) EXPECT_GT(channel.values.cwiseAbs().maxCoeff(), 20.0);
  EXPECT_GT(figure(play, "uncompensated"), 25.0);
  EXPECT_LE(2.0 * compensated_rms(play), 5.0) << play << compensate;
  EXPECT_THAT(play, HasSubstr("at the worst instant 0.00 um worse"));
  EXPECT_THAT(compensate, Not(HasSubstr("refused")));
  EXPECT_THAT(tests::contents(at("played.csv")),
              testing::StartsWith("time_s,error_um,offset_um,compensated_um\n0,0,0,0\n"));
}

TEST_F(LiveCompensation, ObservesWithTheTwin) {
  auto const [play, compensate] = played({"--observer", "g200", "--fastest", "0.5 K/s"});
  EXPECT_GT(figure(play, "uncompensated"), 25.0);
  EXPECT_LE(2.0 * compensated_rms(play), 5.0) << play << compensate;
}

TEST_F(LiveCompensation, ObservesAsAFitHasSaved) {
  answer(program + " fit " + at("other.h5") + " --error E_X --sensors T2,T10 --twin g200 --method 'twin observer' -o " +
         at("observer.toml"));
  auto const [play, compensate] = played({"--model", at("observer.toml"), "--fastest", "0.5 K/s"});
  EXPECT_GT(figure(play, "uncompensated"), 25.0);
  EXPECT_LE(2.0 * compensated_rms(play), 5.0) << play << compensate;
  EXPECT_THAT(compensate, HasSubstr("twin observer of E_X [um] (spindle against turret, radial) on T2, T10: "));
}

TEST_F(LiveCompensation, IsNeverWorseThanNothingWithAFaultySensor) {
  std::array<std::pair<char const*, std::function<void(Eigen::VectorXd&)>>, 4> const faults{
      {{"T2 missing", [](auto& values) { values.segment(80, 120).setConstant(std::nan("")); }},
       {"T2 stuck", [](auto& values) { values.segment(80, 120).setConstant(values[80]); }},
       {"T2 jumped", [](auto& values) { values.tail(200).array() += 6.0; }},
       {"T2 out of range", [](auto& values) { values.segment(80, 120).setConstant(850.0); }}}};
  auto const duty = output::read(at("duty.h5"));
  for (auto const& [report, corrupt] : faults) {
    auto faulty = duty;
    for (auto& channel : faulty.readings)
      if (channel.name == "T2") corrupt(channel.values);
    output::write(faulty, at("faulty.h5"));
    auto const [play, compensate] = played({"--model", at("model.toml")}, "faulty.h5", "6000");
    EXPECT_THAT(compensate, HasSubstr(report));
    EXPECT_LE(figure(play, "instant"), 1.0) << report << "\n" << play << compensate;
    RecordProperty(report, play);
  }
}

/// T2 is played by a machine of its own, which ends after a third of the duty.
TEST_F(LiveCompensation, IsNeverWorseThanNothingWithASilentSensor) {
  auto others = output::read(at("duty.h5"));
  auto alone = others;
  std::erase_if(others.readings, [](auto const& channel) { return channel.name == "T2"; });
  std::erase_if(alone.readings, [](auto const& channel) { return channel.name != "T2"; });
  alone.inputs.clear();
  output::resize_rows(alone, alone.time_s.size() / 3);
  output::write(others, at("others.h5"));
  output::write(alone, at("alone.h5"));
  auto const player = [&](std::string const& run) {
    return std::vector<std::string>{program, "play", at(run), "-q", "--speed", "1500", "--broker", broker_.url()};
  };
  Child sensor(player("alone.h5"), at("sensor")), machine(player("others.h5"), at("machine"));
  broker_.wait_for_clients(2);  // both wait for somebody who compensates
  Child compensate(compensation({"--model", at("model.toml")}, "1500"), at("compensate"));
  EXPECT_EQ(machine.wait(), 0);
  EXPECT_EQ(sensor.wait(), 0);
  EXPECT_EQ(compensate.end(SIGINT), 0);
  auto const play = tests::contents(at("machine")), said = tests::contents(at("compensate"));
  EXPECT_THAT(said, HasSubstr("held; T2 stale"));
  EXPECT_LE(figure(play, "instant"), 1.0) << play << said;
  RecordProperty("T2 stale", play);
}

TEST_F(LiveCompensation, AMachineThatIsStoppedIsNotPlayedToTheEnd) {
  Child machine({program, "play", at("duty.h5"), "-q", "--speed", "1500", "--broker", broker_.url()}, at("machine"));
  broker_.wait_for_clients(1);
  EXPECT_EQ(machine.end(SIGINT), 130);
  EXPECT_THAT(tests::contents(at("machine")), HasSubstr("stopped; what is told is of the rows so far"));
}

TEST_F(LiveCompensation, SaysWhichInputsDoNotCome) {
  auto lacking = output::read(at("duty.h5"));
  std::erase_if(lacking.readings, [](auto const& channel) { return channel.name == "T10"; });
  output::write(lacking, at("lacking.h5"));
  Child compensate({program, "compensate", "--model", at("model.toml"), "--broker", broker_.url(), "--speed", "3000",
                    "--start", "3 s"},
                   at("compensate"));
  answer(program + " play " + at("lacking.h5") + " -q --speed 3000 --broker " + broker_.url());
  EXPECT_EQ(compensate.wait(), 2);
  EXPECT_THAT(tests::contents(at("compensate")), HasSubstr("no reading of T10 within 3 s"));
}

TEST_F(LiveCompensation, SaysWhatItWorksAgainstAndIsNotJudgedByAnother) {
  Child compensate(compensation({"--model", at("model.toml"), "--axis", "Z", "--channel", "E_X"}, "6000"),
                   at("compensate"));
  EXPECT_THAT(answer(program + " play " + at("duty.h5") + " -q --axis Z --speed 6000 -o " + at("judged.csv") +
                         " --broker " + broker_.url(),
                     2),
              HasSubstr("axis Z is compensated against E_X, and this run is judged by E_Z; give both the same"));
  EXPECT_EQ(compensate.end(SIGINT), 0);
  EXPECT_THAT(tests::contents(at("compensate")),
              AllOf(HasSubstr("linear of E_X [um] (spindle against turret, radial) on T2, T4, T10, T12, T15"),
                    HasSubstr("fitted to other.h5 of g200: 121 rows, RMSE")));
  EXPECT_FALSE(std::filesystem::exists(at("judged.csv")));
}

TEST_F(LiveCompensation, LeavesALastWill) {
  Child compensate({program, "compensate", "--model", at("model.toml"), "--broker", broker_.url()}, at("compensate"));
  Broker listener({broker_.url(), "listener", {}, {}, {}, {}, {}, {}}, {"thermotwin/status/compensate-X"});
  auto const next = [&] {
    auto const message = listener.receive(std::chrono::steady_clock::now() + 60s);
    return message ? message->payload : "nothing";
  };
  EXPECT_EQ(next(), "online");
  compensate.end(SIGKILL);
  EXPECT_EQ(next(), "offline");
}

TEST_F(LiveCompensation, RefusesWhatItCannotDo) {
  std::string const compensate = program + " compensate --broker " + broker_.url();
  EXPECT_THAT(answer(compensate, 2), HasSubstr("compensate needs --model FILE or --observer MACHINE"));
  tests::put(at("earlier.h5"), "of yesterday");
  EXPECT_THAT(answer(compensate + " --model " + at("model.toml") + " --record " + at("earlier.h5"), 2),
              HasSubstr("earlier.h5' is there already"));
  EXPECT_EQ(tests::contents(at("earlier.h5")), "of yesterday");
  EXPECT_THAT(answer(compensate + " --model " + at("model.toml") + " --resolution 1", 2),
              HasSubstr("--resolution: 1 has no unit"));
  EXPECT_THAT(answer(compensate + " --model " + at("model.toml") + " --highest '120 K'", 2),
              HasSubstr("-20 degC at least and -153.15 degC at most: the highest must be above the lowest"));
  EXPECT_THAT(answer(program + " compensate --broker localhost --model " + at("model.toml"), 2),
              HasSubstr("broker 'localhost': write mqtt://HOST:1883"));
  EXPECT_THAT(answer(program + " compensate --broker mqtt://127.0.0.1:1 --model " + at("model.toml"), 2),
              HasSubstr("the broker mqtt://127.0.0.1:1 cannot be reached: no broker answers there"));
  for (std::string const port : {"1883x", "99999", ""})
    EXPECT_THAT(answer(program + " compensate --broker mqtt://127.0.0.1:" + port + " --model " + at("model.toml"), 2),
                HasSubstr("write mqtt://HOST:1883"));
  EXPECT_THAT(answer(compensate + " --model " + at("model.toml") + " --axis Z", 2),
              HasSubstr("predicts E_X, and axis Z works against E_Z; give the model of E_Z, or --channel E_X"));
  EXPECT_THAT(answer(compensate + " --model " + at("model.toml") + " --axis 'X/#'", 2),
              HasSubstr("--axis 'X/#': it is a part of topics"));
  EXPECT_THAT(answer(program + " play " + at("duty.h5") + " --prefix 'a/+' --broker " + broker_.url(), 2),
              HasSubstr("--prefix 'a/+': it is a part of topics"));
  EXPECT_THAT(answer(program + " fit " + at("other.h5") + " --sensors T22 -o " + at("x.toml"), 2),
              HasSubstr("has no sensor 'T22'; did you mean 'T"));
}

// --- the connection --------------------------------------------------------------------------------------------------

/// Whether a message gets from one client to another.
bool passes(BrokerOptions options) {
  options.client = "receiver";
  Broker receiver(options, {"there"});
  options.client = "sender";
  Broker sender(options, {});
  sender.publish("there", "hello");
  auto const message = receiver.receive(std::chrono::steady_clock::now() + 60s);
  return message && message->payload == "hello";
}

std::string refusal(BrokerOptions const& options) {
  try {
    Broker const broker(options, {});
    return "taken";
  } catch (thermal::InputError const& error) {
    return error.what();
  }
}

TEST(BrokerConnection, TakesUserAndPassword) {
  TemporaryDirectory const directory;
  auto const at = [&](char const* name) { return (directory / name).string(); };
  tests::put(at("password"), "secret\n");
  tests::put(at("wrong"), "guess\n");
  answer("mosquitto_passwd -b -c " + at("users") + " twin secret");
  BrokerProcess const broker(directory.path().string(), "allow_anonymous false\npassword_file " + at("users") + "\n");
  auto options = named(broker.url(), "twin");
  EXPECT_THAT(refusal(options), HasSubstr("cannot be reached"));
  options.user = "twin";
  options.password_file = at("wrong");
  EXPECT_THAT(refusal(options), HasSubstr("cannot be reached"));
  options.password_file = at("absent");
  EXPECT_THAT(refusal(options), HasSubstr("no password to read"));
  options.password_file = at("password");
  EXPECT_TRUE(passes(options));
}

TEST(BrokerConnection, IsEncryptedAndKnowsWhomItTalksTo) {
  TemporaryDirectory const directory;
  auto const at = [&](std::string const& name) { return (directory / name).string(); };
  auto const sign = [&](std::string const& authority, std::string const& name) {
    answer("openssl req -newkey rsa:2048 -nodes -subj /CN=" + name + " -addext subjectAltName=IP:127.0.0.1 -keyout " +
           at(name + ".key") + " -x509 -days 2 -CA " + at(authority + ".pem") + " -CAkey " + at(authority + ".key") +
           " -out " + at(name + ".pem"));
  };
  for (std::string const authority : {"ours", "theirs"})
    answer("openssl req -x509 -newkey rsa:2048 -nodes -days 2 -subj /CN=" + authority + " -keyout " +
           at(authority + ".key") + " -out " + at(authority + ".pem"));
  sign("ours", "broker");
  sign("ours", "client");
  BrokerProcess const broker(directory.path().string(), "allow_anonymous true\nrequire_certificate true\ncafile " +
                                                            at("ours.pem") + "\ncertfile " + at("broker.pem") +
                                                            "\nkeyfile " + at("broker.key") + "\n");
  auto options = named(broker.url("mqtts"), "twin");
  options.ca_file = at("ours.pem");
  options.certificate_file = at("client.pem");
  options.key_file = at("client.key");
  EXPECT_TRUE(passes(options));
  options.ca_file = at("theirs.pem");
  EXPECT_THAT(refusal(options), HasSubstr("cannot be reached"));
  options.ca_file = at("ours.pem");
  options.certificate_file.clear();
  options.key_file.clear();
  EXPECT_THAT(refusal(options), HasSubstr("cannot be reached"));
}

TEST(BrokerConnection, LosesNothingWhenTheBrokerIsKilledAndComesBack) {
  TemporaryDirectory const directory;
  BrokerProcess broker(directory.path().string());
  Broker receiver(named(broker.url(), "receiver"), {"count"});
  Broker sender(named(broker.url(), "sender"), {});
  broker.wait_until_saved();  // who listens
  constexpr int messages = 2000;
  for (int i = 0; i < messages; ++i) {
    if (i == messages / 4) broker.kill();
    if (i == messages / 2) broker.start();
    EXPECT_TRUE(sender.publish("count", std::to_string(i)));
    std::this_thread::sleep_for(500us);
  }
  std::vector<bool> seen(messages);
  auto const until = std::chrono::steady_clock::now() + 60s;
  while (auto const message = receiver.receive(until)) {
    seen[std::size_t(std::stoi(message->payload))] = true;
    if (std::all_of(seen.begin(), seen.end(), [](bool s) { return s; })) break;
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), false), 0);
  EXPECT_GE(receiver.reconnections(), 1);
}

}  // namespace
}  // namespace thermotwin
