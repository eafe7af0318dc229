#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "output/campaign_file.h"

namespace thermotwin::tests {

/// A part of a campaign whose runs have one sensor, an angle and a displacement at three times: run r reads r + 10 t,
/// and its parameter is r².
inline void put_part(std::filesystem::path const& path, std::int64_t first, std::int64_t count,
                     bool one_failed = false) {
  using Kind = output::CampaignVariable::Kind;
  output::CampaignLayout layout;
  layout.axes = {{"time", "s", "time", Eigen::VectorXd::LinSpaced(3, 0.0, 120.0)},
                 {"reading", "1", "sensor", std::vector<std::string>{"T1"}},
                 {"displacement", "1", "channel", std::vector<std::string>{"A", "E_Z"}}};
  layout.variables = {{Kind::real64, "parameters/a.b", "W/K", "a.b", {}},
                      {Kind::real32, "readings", "degC", "", {"time", "reading"}},
                      {Kind::real32, "displacements", "um", "", {"time", "displacement"}}};
  output::CampaignPart part{first, count, {}, {}};
  std::vector<double> squares;
  std::vector<float> readings, displacements;
  for (auto run = first; run < first + count; ++run) {
    squares.push_back(double(run * run));
    bool const failed = one_failed && run == first;
    if (failed) part.failures.emplace(run, "too fast");
    for (int t = 0; t < 3; ++t) {
      readings.push_back(failed ? std::nanf("") : float(run + 10 * t));
      for (int c = 0; c < 2; ++c) displacements.push_back(float(100 * c + run));
    }
  }
  part.values = {squares, readings, displacements};
  output::write_part(layout, part, path);
}

}  // namespace thermotwin::tests
