#pragma once

#include <string>

#include "twin/assembly.h"
#include "twin/bodies.h"
#include "twin/file/value.h"

/// Whether the places that a part's table states can stand together: each mistake is an InputError, or a FileError at
/// its place.
namespace thermotwin::twin {

/// What carries heat between two places needs two.
void check_ends(Value const& table, Assembly const& assembly);

/// What adds up over the places of a list, or is their mean, takes none of them twice.
void refuse_common_places(Value const& table, std::string const& key, Assembly const& assembly);

/// A film leads to a fluid; between solids there are joints.
void check_fluid(Value const& film, Assembly const& assembly, Bodies const& bodies);

}  // namespace thermotwin::twin
