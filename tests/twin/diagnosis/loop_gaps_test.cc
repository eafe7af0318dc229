#include "twin/diagnosis/loop_gaps.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>

#include "tests/twin/diagnosis/diagnosis_bench.h"
#include "tests/twin/only.h"
#include "twin/diagnosis/diagnosis.h"
#include "twin/diagnosis/gap.h"
#include "twin/file/document.h"

namespace thermotwin::twin {
namespace {

/// Every solid that is drawn and expands, for every displacement: its free growth over its longest edge; a rotation by
/// its expansion alone.
TEST(LoopGaps, AreSharesOfFreeGrowth) {
  Machine const machine = Machine::build(tests::v450());
  auto const gaps = loop_gaps(machine);
  auto const of = [&](std::string const& name) {
    auto const gap = std::find_if(gaps.begin(), gaps.end(), [&](auto const& g) { return g.name == name; });
    if (gap == gaps.end()) throw std::runtime_error("no gap '" + name + "'");
    double sum = 0.0;
    int others = 0;
    for (std::size_t d = 0; d < gap->growth.size(); ++d) {
      if (machine.displacements[d].name + name.substr(name.find(' ')) != name) others += int(gap->growth[d].size());
      for (auto const& [node, weight] : gap->growth[d]) sum += weight;
    }
    EXPECT_EQ(others, 0) << name;
    return sum;
  };
  EXPECT_NEAR(of("E_Z by cartridge"), 11.8e-6 * 0.320, 1e-12);
  EXPECT_NEAR(of("E_Y by column_front"), 10.5e-6 * 1.1, 1e-12);
  EXPECT_NEAR(of("A by column_front"), 10.5e-6, 1e-12);
  EXPECT_EQ(std::count_if(gaps.begin(), gaps.end(), [](auto const& g) { return g.name.ends_with("front_ring"); }), 0);
}

/// What is written for steps beyond the loop moves displacements as the fit supposed: a rotation is not handed on.
TEST(LoopGaps, AreWrittenAsStepsBeyondTheLoop) {
  std::map<std::string, double> const amounts = {
      {"A by column_rear", 0.2}, {"E_Y by bed", -0.1}, {"E_Z by head_front", 0.3}};
  Value document = tests::v450();
  Machine const before = Machine::build(document);
  auto const gaps = loop_gaps(before);
  std::vector<double> x;
  for (auto const& gap : gaps) x.push_back(amounts.contains(gap.name) ? amounts.at(gap.name) : 0.0);
  for (auto const& [channel, text] : loops_beyond(document, gaps, x)) {
    auto const [table, key] = find_parameter(document, channel + ".beyond");
    set_key(*table, key, std::get<Value::List>(parse_toml("a = " + text, "a").find("a")->content));
  }
  Machine const after = Machine::build(document);
  for (std::size_t d = 0; d < before.displacements.size(); ++d) {
    std::map<int, double> more;
    for (auto const& [node, weight] : after.displacements[d].weights) more[node] += weight;
    for (auto const& [node, weight] : before.displacements[d].weights) more[node] -= weight;
    for (std::size_t g = 0; g < gaps.size(); ++g)
      for (auto const& [node, weight] : gaps[g].growth[d]) more[node] -= x[g] * weight;
    for (auto const& [node, weight] : more) EXPECT_NEAR(weight, 0.0, 1e-10) << before.displacements[d].name;
  }
}

/// A file that has such steps already keeps them.
TEST(LoopGaps, AreWrittenBesideThoseOfTheFile) {
  Value const document = parse_toml(
      "[[displacement]]\nname = \"E_Z\"\nbeyond = [{ of = \"bed\", length = \"24 mm\", weight = 0.5 }]\n", "mine.toml");
  auto const loops = loops_beyond(document, {{"E_Z by head", "E_Z", "head", 0.012, {}}}, {-1.0});
  ASSERT_EQ(loops.size(), 1);
  EXPECT_EQ(loops[0].channel, "displacement.E_Z");
  EXPECT_EQ(loops[0].text,
            "[{ of = \"head\", length = \"12 mm\", weight = -1 }, { of = \"bed\", length = \"24 mm\", weight = 0.5 }]");
}

/// The head bends as well: its front's warmth tilts the spindle, which the file of the machine does not say. That is no
/// compensation, nor anything else that is missing, and the file that is written bends, too.
TEST(LoopGaps, AreNotMissing) {
  Value truth = tests::v450();
  Value bending = parse_toml(R"(segment = [{ of = "head_front", length = "400 mm", weight = -0.3 }])", "head");
  for (auto& rotation : std::get<Value::List>(truth.find("rotation")->content)) {
    auto& segments = std::get<Value::List>(rotation.find("segment")->content);
    segments.push_back(std::get<Value::List>(bending.find("segment")->content)[0]);
  }
  auto run = tests::measured(truth, tests::two_speeds());
  tests::add_noise(run, 0.02, 0.05e-6, 7);
  auto const diagnosis = diagnose(tests::v450(), {bin(run, 300.0)}, {});
  EXPECT_EQ(name_of(diagnosis.verdict), "nothing");
  for (auto const& [channel, times] : diagnosis.noise_heard) EXPECT_LT(times, 2.0) << channel;
  auto const left = gaps(Machine::build(tests::v450()), Machine::build(diagnosis.document), {bin(run, 300.0)}, nullptr);
  for (std::string const name : {"A", "E_Y"}) {
    auto const gap = tests::only(left, [&](auto const& one) { return one.channel == name; });
    EXPECT_LT(gap.after, 0.2 * gap.before) << name;
  }
}

}  // namespace
}  // namespace thermotwin::twin
