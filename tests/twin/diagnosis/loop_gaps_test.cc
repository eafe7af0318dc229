#include "twin/diagnosis/loop_gaps.h"

#include <algorithm>
#include <gtest/gtest.h>

#include "tests/twin/diagnosis/diagnosis_bench.h"
#include "twin/diagnosis/diagnosis.h"

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

/// The head bends as well: its front's warmth tilts the spindle, which the file of the machine does not say. That is no
/// compensation, nor anything else that is missing.
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
}

}  // namespace
}  // namespace thermotwin::twin
