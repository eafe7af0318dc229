#pragma once

#include <nvector/nvector_serial.h>

namespace thermotwin::thermal {

/// A vector of SUNDIALS' serial kind whose operations (those of CVODES' steps) go over long arrays with all threads, in
/// blocks that do not depend on their number. Clones are of the same kind.
[[nodiscard]] N_Vector make_vector(sunindextype length, SUNContext context);

[[nodiscard]] inline double* data(N_Vector v) { return NV_DATA_S(v); }

}  // namespace thermotwin::thermal
