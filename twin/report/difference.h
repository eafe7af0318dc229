#pragma once

#include <filesystem>
#include <string>

namespace thermotwin::twin {

/// What is held against what, and where the fields go.
struct DifferenceFiles {
  std::filesystem::path first;    ///< data set .h5, .csv, or a measurement file .toml
  std::string second;             ///< data set .h5 or .csv, or a machine: file or name
  std::filesystem::path machine;  ///< to draw; empty: the one that the data carry
  std::filesystem::path folder;   ///< of the fields
  double interval = 900.0;        ///< between two frames, at least [s]
};

/// First minus second as a series of fields for ParaView (output/fields.h), at the first's times; the second is taken
/// along straight lines between its rows. Returns what was written, for people.
///
/// When both hold every node (`run --nodes`): the difference of every node's temperature, and of the displacement
/// (thermal/growth_field.h) since each run's start. Bodies are matched by name; InputError that names the first one
/// that only one run has, or whose cells are others.
///
/// Otherwise: the residual at the sensors, carried over the bodies that bear them (carried_residual.h). Where the
/// second is a machine it is run through what the first went through (prediction.h). InputError when nobody says what
/// the machine is, or no sensor with a place is common to both.
std::string write_difference(DifferenceFiles const& files);

}  // namespace thermotwin::twin
