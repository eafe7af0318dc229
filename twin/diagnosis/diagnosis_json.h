#pragma once

#include <string>

#include "twin/diagnosis/diagnosis_report.h"

namespace thermotwin::twin {

/// Verdict, effects with their intervals and weights, unaccounted heat, gaps per channel, estimates: everything, for
/// programs.
[[nodiscard]] std::string report_json(DiagnosisReport const& report);

}  // namespace thermotwin::twin
