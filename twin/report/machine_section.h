#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "output/report_page.h"
#include "twin/machine.h"
#include "twin/report/shown_run.h"

namespace thermotwin::twin {

/// The machine that a run was made with, built again from the run's own echo of its file and settings; without such an
/// echo the one that a measurement file names, from the file of that name beside it, or else the shipped one; none when
/// neither says. InputError when the echo no longer makes a machine, or none has that name.
[[nodiscard]] std::optional<Machine> machine_of(ShownRun const& run);

/// The machine as the page draws it: its surface, body by body, and its sensors.
///
/// `field` is there when the run kept every node (`run --nodes`): temperature and displacement of the surface's points
/// as few shapes with common courses (output/field_modes.h; the displacement is linear in the temperature), to
/// max(0.01 K, 0.1 % of the span), and mean, lowest and highest temperature of every body, exactly.
/// Empty (null) when no body of the machine has a place in space.
[[nodiscard]] output::Json machine_json(Machine const& machine, output::Dataset const& data, output::ReportPage& page);

/// A place on the machine with a name, and what it is.
struct MarkedPlace {
  std::string name, title;
  Eigen::Vector3d position{0.0, 0.0, 0.0};  ///< [m]
};

/// The machine with places marked and two numbers per node in place of temperatures: `field` goes from the first at
/// time 0 to the second at time 1. InputError when these are fewer than the nodes of its bodies; null as above.
[[nodiscard]] output::Json painted_machine_json(Machine const& machine, Eigen::VectorXd const& first,
                                                Eigen::VectorXd const& second, std::vector<MarkedPlace> const& marks,
                                                output::ReportPage& page);

}  // namespace thermotwin::twin
