#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "output/dataset.h"

namespace thermotwin::output {

/// Which columns a table gets, in this order after the time.
struct CsvGroups {
  bool inputs = true;
  bool readings = true;
  bool displacements = true;
  bool truth = false;  ///< noise-free readings and displacements
  bool heat = false;
};

/// A field of a table: in quotes where it has commas, quotes or line breaks.
[[nodiscard]] std::string csv_field(std::string const& text);

/// Writes a table: header `time_s,<name>_<unit>,…` ("T1_degC", "E_Z_um", "spindle.speed_rpm"), numbers with the fewest
/// digits that read back as the same double, a missing sample as an empty field.
///
/// Truth and heat stand behind their group, "truth.T1_degC", "heat.motor_W". So does a column that reading would take
/// for one of another group: "readings.oil.tank_degC". Positioning, node temperatures and provenance do not fit into a
/// table and stay out. Throws thermal::InputError when the data set is not in order.
void export_csv(Dataset const& dataset, std::ostream& stream, CsvGroups const& groups = {});

/// The same, atomically; throws OutputError when the file cannot be written.
void export_csv(Dataset const& dataset, std::filesystem::path const& path, CsvGroups const& groups = {});

/// Whether a table of this data set begins so, with truth and heat or without them.
[[nodiscard]] bool is_header_of(Dataset const& dataset, std::string const& line);

/// What stays out of a table, for people: "the laser's passes along z", "the temperatures of the nodes".
[[nodiscard]] std::vector<std::string> left_out_of_csv(Dataset const& dataset);

/// Reads a table with such a header, whoever wrote it: `time_s` is due, strictly increasing; an empty field is a
/// missing sample. The unit is what follows the last '_' of a column's name; "C" means degC.
///
/// A column's group is what stands before the name, or else: a name with a dot is an input ("spindle.speed"), a
/// temperature a reading, a length or an angle a displacement, and everything else an input ("spindle_rpm").
/// Throws thermal::InputError with file, line and column.
[[nodiscard]] Dataset import_csv(std::filesystem::path const& path);

}  // namespace thermotwin::output
