#pragma once

#include <functional>
#include <string>
#include <vector>

#include "output/hdf5_handle.h"

/// What the readers of data sets and of campaigns share; for output/hdf5_*.cc only.
namespace thermotwin::output::hdf5 {

/// One text of a type, which `read_into` puts as the given memory type where it is told: HDF5 has texts of fixed length
/// and others that it allocates.
std::string read_text(Id type, std::function<int(Id, void*)> const& read_into);
std::string read_text_of(Id attribute);
/// Empty: there is no such attribute.
std::string text_attribute(Id object, char const* name);

Handle open_variable(Id group, std::string const& name);

/// A variable of texts.
std::vector<std::string> read_names(Id group, std::string const& name);

/// What a group holds, in the order of writing; a file that kept none (another program's) gives the alphabet's.
std::vector<std::string> names_in(Id group);

}  // namespace thermotwin::output::hdf5
