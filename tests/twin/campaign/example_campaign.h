#pragma once

#include <string>

#include "tests/output/temporary_directory.h"
#include "twin/campaign/campaign.h"

namespace thermotwin::twin {

/// 3 x 2 values, 2 cases, 2 experiments, 2 repetitions: 48 runs of two hours.
inline std::string const example_campaign = R"toml(
title = "example"
experiments = ["golden_b_2000", "golden_b_6000"]
machine = "v450"
repetitions = 2
seed = 100
tolerance = 1e-3
set = ["experiment.duration=2 h"]
keep = ["readings", "summary"]
part = 7

[[grid]]
path = "bearing.front.grease_factor"
values = [0.4, 0.5, 0.6]

[[grid]]
path = "experiment.ambient.mean"
from = "18 degC"
to = "26 degC"
count = 2

[[case]]
set = ["bearing.rear.grease_factor=0.5"]

[[case]]
set = ["bearing.rear.grease_factor=0.7", "experiment.ambient.drift=0.1 K/h"]
)toml";

inline Campaign read_campaign(thermotwin::tests::TemporaryDirectory const& directory, std::string const& text) {
  thermotwin::tests::put(directory / "campaign.toml", text);
  return Campaign::read(directory / "campaign.toml");
}

inline std::string changed_example(std::string const& from, std::string const& to) {
  auto text = example_campaign;
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace thermotwin::twin
