#pragma once

#include <string>

#include "twin/volumetric/volumetric_study.h"

namespace thermotwin::twin {

/// What `thermotwin volumetric` prints, for people and for programs.
[[nodiscard]] std::string volumetric_text(VolumetricStudy const& study);
[[nodiscard]] std::string volumetric_json(VolumetricStudy const& study);

}  // namespace thermotwin::twin
