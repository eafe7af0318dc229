#pragma once

#include <string>

#include "output/report_page.h"

namespace thermotwin::twin {

/// What `thermotwin diagnose --json` printed (docs/diagnosis.md), with what people need besides: `sentence` that names
/// what is missing, and with each effect its `meaning`, `separated_by` and amplitude as `text`. InputError for an
/// effect that the catalogue does not have; Json::exception when the answer is damaged.
[[nodiscard]] output::Json diagnosis_json(output::Json diagnosis, std::string const& name);

}  // namespace thermotwin::twin
