#pragma once

#include <filesystem>
#include <fmt/format.h>
#include <string>

#include "tests/output/temporary_directory.h"
#include "twin/study/study.h"

namespace thermotwin::twin {

inline std::string const experiment = R"(
machine = "v450"
duration = "{}"
sampling = "3 min"
[ambient]
mean = "20 degC"
[spindle]
blocks = [{{duration = "50 min", speed = "{}"}}]
)";

inline std::string const head = R"(
title = "Small"
seeds = 5
selections = ["all", "forward 2"]
models = ["linear", "ridge"]
)";

inline std::string const world = R"(
[[world]]
name = "v450"
machine = "v450"
error = "E_Z"
sensors = ["T1", "T8", "T9"]
train = ["fast.toml"]
test = ["slow.toml"]
)";

/// A folder with two short experiments and a study file of this text.
class SmallStudy {
 public:
  explicit SmallStudy(std::string const& text = head + world) {
    tests::put(folder_ / "fast.toml", fmt::format(fmt::runtime(experiment), "90 min", "6000 rpm"));
    tests::put(folder_ / "slow.toml", fmt::format(fmt::runtime(experiment), "120 min", "3000 rpm"));
    tests::put(file(), text);
  }
  [[nodiscard]] std::filesystem::path file() const { return folder_ / "small.toml"; }
  [[nodiscard]] std::filesystem::path experiment_path(std::string const& name) const { return folder_ / name; }
  [[nodiscard]] StudyReport report() const { return run_study(read_study(file())); }
  /// What reading and running it complains of.
  [[nodiscard]] std::string complaint() const {
    try {
      (void)report();
    } catch (std::exception const& error) {
      return error.what();
    }
    return "no complaint";
  }

 private:
  tests::TemporaryDirectory folder_;
};

inline Combination const& row(StudyReport const& report, std::string const& name) {
  for (auto const& row : report.rows)
    if (row.name() == name) return row;
  throw std::runtime_error("no row " + name);
}

}  // namespace thermotwin::twin
