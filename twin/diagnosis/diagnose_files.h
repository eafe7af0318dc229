#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "twin/diagnosis/diagnosis_report.h"

namespace thermotwin::twin {

/// `thermotwin diagnose`.
struct DiagnoseFiles {
  std::filesystem::path machine;
  std::vector<std::filesystem::path> data, held_out;
  std::filesystem::path output;  ///< of the amended machine; empty: none
  std::vector<std::string> without;
  std::function<void(std::string const&)> progress;
  FitWatch watch{};
  std::optional<std::uint64_t> start = {};             ///< seed of where the search begins
  std::function<void(DiagnosisReport const&)> show{};  ///< before the machine is written: no lack of room takes it away
};

/// Reads machine and data, diagnoses, and compares the machine before and after on both. InputError for files that
/// cannot serve.
[[nodiscard]] DiagnosisReport diagnose_files(DiagnoseFiles const& files);

}  // namespace thermotwin::twin
