#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "output/report_page.h"

namespace thermotwin::twin {

/// Whether a folder is one that `thermotwin campaign` fills.
[[nodiscard]] bool is_campaign(std::filesystem::path const& folder);

/// What tells how far a campaign is: its manifest, its parts and their journals, its end.
[[nodiscard]] std::vector<std::filesystem::path> campaign_files(std::filesystem::path const& folder);

/// A part that is whole: runs first to last are in it.
struct WholePart {
  std::filesystem::path file;
  std::int64_t number = 0, first = 0, last = 0;
};
/// In their order. InputError when the manifest is none.
[[nodiscard]] std::vector<WholePart> whole_parts(std::filesystem::path const& folder);

/// How far a campaign is, as a page shows it (the keys of ProgressFile): the last parts that became whole, and how many
/// of the runs are made. It rests on the folder alone, so it counts what every process has made, here or elsewhere, now
/// or before a kill. Times are those of the files, from the manifest's on.
[[nodiscard]] output::Json campaign_progress(std::filesystem::path const& folder);

}  // namespace thermotwin::twin
