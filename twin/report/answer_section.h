#pragma once

#include <filesystem>
#include <string>

#include "output/report_page.h"
#include "thermal/error.h"

namespace thermotwin::twin {

/// Whether a report shows the path as an answer: `.json`, or the folder of a campaign; else it is a data set.
[[nodiscard]] bool is_answer(std::filesystem::path const& path);

/// InputError for a folder, which no report takes but that of a campaign: which answer in it one does take.
void refuse_folder(std::filesystem::path const& path);

/// A file's JSON; InputError "damaged at line 2, column 1: not JSON".
[[nodiscard]] output::Json read_json(std::filesystem::path const& file);

/// What the library says of JSON that lacks something, or has something else in its place.
[[nodiscard]] thermal::InputError no_answer(std::filesystem::path const& file, std::exception const& error);

/// Adds the section for what another command answered as JSON, known by its keys: `diagnose` ("diagnosis"), `study`
/// ("study"), `place` ("placement"), `volumetric` ("volumetric"), or how far one has come ("progress"); of a campaign's
/// folder that, too, and what its runs show ("campaign").
///
/// The document is the command's own, with what people need besides: a diagnosis its sentence (diagnosis_section.h), a
/// study without the values of each repetition, a placement the machine with the map of informative places when the
/// answer holds it. The machine of a placement is `machine`, or else the shipped one that it names. InputError when the
/// file is no such answer, or damaged. Returns what the page can be called by.
[[nodiscard]] std::string add_answer(std::filesystem::path const& file, std::filesystem::path const& machine,
                                     output::ReportPage& page);

}  // namespace thermotwin::twin
