#pragma once

#include <filesystem>

#include "output/dataset_file.h"

namespace thermotwin::tests {

/// What a run of another day left, as far as its place goes.
inline void put_earlier_run(std::filesystem::path const& path) {
  output::Dataset run;
  run.title = "what the user had";
  run.time_s = Eigen::Vector2d(0.0, 10.0);
  run.provenance["experiment.file"] = "title = \"warm-up\"\n";
  output::write(run, path);
}

}  // namespace thermotwin::tests
