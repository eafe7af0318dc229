#pragma once

#include <optional>

#include "output/report_page.h"
#include "twin/machine.h"
#include "twin/report/shown_run.h"

namespace thermotwin::twin {

/// The machine that a run was made with, built again from the run's own echo of its file and settings; none without
/// such an echo. InputError when the echo no longer makes a machine.
[[nodiscard]] std::optional<Machine> machine_of(ShownRun const& run);

/// The machine as the page draws it: its surface, body by body, and its sensors.
///
/// `field` is there when the run kept every node (`run --nodes`): temperature and displacement of the surface's points
/// as few shapes with common courses (output/field_modes.h; the displacement is linear in the temperature), to
/// max(0.01 K, 0.1 % of the span), and mean, lowest and highest temperature of every body, exactly.
/// Empty (null) when no body of the machine has a place in space.
[[nodiscard]] output::Json machine_json(Machine const& machine, output::Dataset const& data, output::ReportPage& page);

}  // namespace thermotwin::twin
