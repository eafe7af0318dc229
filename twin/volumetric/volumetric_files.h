#pragma once

#include <filesystem>
#include <vector>

#include "twin/setting.h"
#include "twin/volumetric/volumetric_study.h"

namespace thermotwin::twin {

/// `thermotwin volumetric`.
struct VolumetricFiles {
  std::filesystem::path machine;
  std::vector<Setting> settings;  ///< what is changed in it
  std::filesystem::path run;      ///< data set of that machine, for its drift; empty: none
  std::filesystem::path output;   ///< folder; empty: none
  std::filesystem::path picture;  ///< PNG; empty: none
  VolumetricOptions options;
};

/// Reads, studies, and writes into the folder; OutputError when it holds something already:
///
/// | file | holds |
/// |---|---|
/// | diagonals.csv | the laser's readings: diagonal, stop, command, error |
/// | functions.csv | nine functions along their axes: plain, joint, predicted, true |
/// | closure.csv | closure residuals per axis and segment |
/// | field.csv | error vectors on the grid, before and after, true |
/// | compensation.csv | what the controller adds, on the grid |
/// | compensation.cec | the same as nine cross-error tables |
/// | drift.csv | with a run: errors over its time |
/// | field.vts | error vectors before, after and of the table, for ParaView |
/// | report.json | what --json prints |
[[nodiscard]] VolumetricStudy volumetric_files(VolumetricFiles const& files);

}  // namespace thermotwin::twin
