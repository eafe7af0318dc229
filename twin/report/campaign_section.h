#pragma once

#include <cstdint>
#include <filesystem>

#include "output/report_page.h"

namespace thermotwin::twin {

/// What the runs of a campaign show, as the page draws it: per channel the quantiles over the runs at every time (5,
/// 25, 50, 75 and 95 %, by linear interpolation between the ordered values) and the last value of every run; the
/// parameters that were varied; the runs that failed, and why.
///
/// It rests on the parts that are whole, so it can be asked while the campaign goes on. Of more than `most` runs every
/// k-th is looked at, and a remark says so. Null as long as no part is whole. A channel that only a summary was kept of
/// has no quantiles. InputError when a part is damaged.
[[nodiscard]] output::Json campaign_json(std::filesystem::path const& folder, output::ReportPage& page,
                                         std::int64_t most = 2000);

}  // namespace thermotwin::twin
