#pragma once

#include <string>

/// What people look up while they write a file, from the tables that the reader of the file uses. At most 100 columns
/// wide.
namespace thermotwin::twin {

/// Solids and fluids at 20 °C, a line each.
[[nodiscard]] std::string material_list();

/// The input channels of an experiment: what a machine can be given, and a record can hold. A line each.
[[nodiscard]] std::string channel_list();

}  // namespace thermotwin::twin
