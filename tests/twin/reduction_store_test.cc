#include "twin/reduction_store.h"

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <set>
#include <thread>

#include "tests/output/temporary_directory.h"
#include "tests/thermal/function_course.h"
#include "thermal/laws.h"

namespace thermotwin::twin {
namespace {

using tests::contents;
using tests::put;
using tests::TemporaryDirectory;

thermal::Subspace subspace(int nodes, int shapes) {
  thermal::Subspace made;
  made.shapes = Eigen::MatrixXd::Random(nodes, shapes);
  for (int i = 0; i < 3 * shapes; ++i) made.elements.push_back({i % 4, i, 1.0 / (1.0 + i)});
  return made;
}

thermal::Reduction example() {
  thermal::Reduction made;
  made.reference = {{293.15, 1.0 / 3.0, -0.0}, {std::numeric_limits<double>::denorm_min()}};
  made.fine = subspace(7, 5);
  made.coarse = subspace(7, 4);
  made.training_error = {0.1, 0.2};
  return made;
}

bool operator==(thermal::Subspace const& a, thermal::Subspace const& b) {
  return a.shapes == b.shapes && std::equal(a.elements.begin(), a.elements.end(), b.elements.begin(), b.elements.end(),
                                            [](auto const& one, auto const& other) {
                                              return one.group == other.group && one.element == other.element &&
                                                     one.weight == other.weight;
                                            });
}

void expect_same(thermal::Reduction const& a, thermal::Reduction const& b) {
  EXPECT_EQ(a.reference.temperatures, b.reference.temperatures);
  EXPECT_EQ(a.reference.input, b.reference.input);
  EXPECT_EQ(a.training_error, b.training_error);
  EXPECT_TRUE(a.fine == b.fine && a.coarse == b.coarse);
}

thermal::Reduction must_not_be_made() {
  ADD_FAILURE() << "was made anew";
  return {};
}

TEST(ReductionStore, GivesBackEveryBitOfWhatWasMade) {
  TemporaryDirectory const folder;
  ReductionStore const store(folder / "new/deep");
  auto const made = example();
  expect_same(store.find_or_make("one", [&] { return made; }), made);
  expect_same(store.find_or_make("one", must_not_be_made), made);
}

TEST(ReductionStore, WhatIsDamagedIsMadeAnewAndKeptWhole) {
  TemporaryDirectory const folder;
  ReductionStore const store(folder.path());
  auto const made = example();
  (void)store.find_or_make("one", [&] { return made; });
  auto const path = store.file("one");
  auto const whole = contents(path);
  std::vector<std::string> damaged = {
      "", "\n", "not ours", "not ours\n" + whole, whole + "x", whole.substr(0, whole.size() / 2)};
  for (std::size_t i = 0; i < whole.size(); i += whole.size() / 23) {
    damaged.push_back(whole);
    damaged.back()[i] = char(damaged.back()[i] ^ 4);
  }
  for (auto const& bytes : damaged) {
    put(path, bytes);
    int times = 0;
    expect_same(store.find_or_make("one",
                                   [&] {
                                     ++times;
                                     return made;
                                   }),
                made);
    EXPECT_EQ(times, 1);
    EXPECT_EQ(contents(path), whole);
  }
}

TEST(ReductionStore, AFileOfAnotherKeyIsNotTrusted) {
  TemporaryDirectory const folder;
  ReductionStore const store(folder.path());
  (void)store.find_or_make("other", example);
  std::filesystem::copy_file(store.file("other"), store.file("one"));
  auto const made = example();
  expect_same(store.find_or_make("one", [&] { return made; }), made);
}

TEST(ReductionStore, WhereNothingCanBeWrittenTheModelIsThereAllTheSame) {
  TemporaryDirectory const folder;
  put(folder / "file", "");
  auto const made = example();
  expect_same(ReductionStore(folder / "file").find_or_make("one", [&] { return made; }), made);
}

TEST(ReductionStore, OfManyAtOnceOneMakesAndTheOthersWait) {
  TemporaryDirectory const folder;
  auto const made = example();
  std::atomic<int> times = 0;
  std::vector<thermal::Reduction> got(6);
  {
    std::vector<std::jthread> threads;
    for (auto& result : got)
      threads.emplace_back([&] {
        result = ReductionStore(folder.path()).find_or_make("one", [&] {
          ++times;
          std::this_thread::sleep_for(std::chrono::milliseconds(20));
          return made;
        });
      });
  }
  EXPECT_EQ(times, 1);
  for (auto const& result : got) expect_same(result, made);
}

TEST(ReductionStore, AFailureIsPassedOnAndNothingIsKept) {
  TemporaryDirectory const folder;
  ReductionStore const store(folder.path());
  EXPECT_THROW((void)store.find_or_make("one", []() -> thermal::Reduction { throw std::invalid_argument("no"); }),
               std::invalid_argument);
  EXPECT_FALSE(std::filesystem::exists(store.file("one")));
}

/// A rod in air, and one run of it.
struct Rod {
  double capacity = 500.0, film = 2.0, gradient = 0.5, level = 1.0, tolerance = 0.01, share = 0.001, start = 293.15;
  std::string channel = "air";

  [[nodiscard]] std::string key() const {
    thermal::NetworkBuilder builder;
    auto const rod = builder.add_body("rod", {capacity, 200.0});
    auto const air = builder.add_boundary({"air", 0.0, {{builder.channel(channel), gradient}}});
    builder.connect(builder.part("rod"), rod, {thermal::Port::Kind::node, 1}, 3.0);
    builder.connect(builder.part("rod"), rod, air, film);
    auto const network = builder.build();
    thermal::FunctionCourse const course(
        {channel}, [this](double t, std::span<double> u) { u[0] = t < 90.0 ? level : 2.0; }, {90.0});
    thermal::ReductionTask task;
    task.training.push_back({&course, {start, 293.15}, 300.0});
    task.watched.push_back({{{0, 1.0}}, tolerance});
    task.initial_rises = Eigen::MatrixXd::Ones(2, 1);
    task.share = share;
    return reduction_key(network, task);
  }
};

TEST(ReductionKey, ChangesWithEverythingThatAReductionReads) {
  std::set<std::string> const keys = {
      Rod{}.key(),
      Rod{.capacity = 501.0}.key(),
      Rod{.film = 2.0000000001}.key(),
      Rod{.gradient = 0.6}.key(),
      Rod{.level = 1.5}.key(),
      Rod{.tolerance = 0.02}.key(),
      Rod{.share = 0.002}.key(),
      Rod{.start = 294.15}.key(),
      Rod{.channel = "room"}.key(),
  };
  EXPECT_EQ(keys.size(), 9u);
  EXPECT_EQ(Rod{}.key(), Rod{}.key());
}

class CacheFolder : public testing::Test {
 protected:
  static void set(char const* name, char const* value) { value ? ::setenv(name, value, 1) : ::unsetenv(name); }
  void SetUp() override {
    for (auto& [name, value] : before_)
      if (char const* now = std::getenv(name)) value = now;
  }
  void TearDown() override {
    for (auto const& [name, value] : before_) set(name, value ? value->c_str() : nullptr);
  }

 private:
  std::map<char const*, std::optional<std::string>> before_ = {
      {"THERMOTWIN_CACHE", {}}, {"XDG_CACHE_HOME", {}}, {"HOME", {}}};
};

TEST_F(CacheFolder, IsOursThenTheDesktopsThenTheHomes) {
  set("THERMOTWIN_CACHE", "/ours");
  set("XDG_CACHE_HOME", "/caches");
  set("HOME", "/home/me");
  EXPECT_EQ(cache_folder(), "/ours");
  set("THERMOTWIN_CACHE", nullptr);
  EXPECT_EQ(cache_folder(), "/caches/thermotwin");
  set("XDG_CACHE_HOME", "");
  EXPECT_EQ(cache_folder(), "/home/me/.cache/thermotwin");
  set("HOME", nullptr);
  EXPECT_EQ(cache_folder(), std::nullopt);
  set("HOME", "/home/me");
  set("THERMOTWIN_CACHE", "");
  EXPECT_EQ(cache_folder(), std::nullopt);
}

}  // namespace
}  // namespace thermotwin::twin
