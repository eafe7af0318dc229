#pragma once

#include <string>
#include <vector>

#include "twin/diagnosis/diagnosis.h"
#include "twin/diagnosis/gap.h"
#include "twin/diagnosis/plausibility.h"

namespace thermotwin::twin {

/// A diagnosis with what it made of the machine.
struct DiagnosisReport {
  Diagnosis diagnosis;
  std::vector<ChannelGap> fitted, held_out;
  std::vector<Doubt> doubts;         ///< about the data
  std::vector<std::string> remarks;  ///< the same, of less weight
};

/// Before what stands in for something unknown.
inline constexpr char const* no_name = "Something is missing that none of the effects tried explains.";

/// The verdict in one sentence; what stands in for something unknown follows a colon.
[[nodiscard]] std::string headline(Diagnosis const& diagnosis);

/// The best experiment that needs no further sensor; nullptr where none is proposed.
[[nodiscard]] Remedy const* proposal_of(Diagnosis const& diagnosis);

/// What speaks against a verdict, or beside it, a sentence or two each.
[[nodiscard]] std::vector<std::string> cautions(Diagnosis const& diagnosis);

/// In plain words, for people.
[[nodiscard]] std::string report_text(DiagnosisReport const& report);

}  // namespace thermotwin::twin
