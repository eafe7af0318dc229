#pragma once

#include <sundials/sundials_nvector.h>

namespace thermotwin::thermal {

/// A vector for CVODES, with the operations of its steps. Clones are of the same kind.
///
/// Long vectors are gone over by all threads, in blocks that do not depend on their number, and late: what is asked for
/// is done when somebody wants to see a vector or its norm, for each block of all vectors at once. A dozen sums of a
/// step then go over memory once.
[[nodiscard]] N_Vector make_vector(sunindextype length, SUNContext context);

/// Its entries, as all that was asked for has left them.
[[nodiscard]] double* data(N_Vector v);

}  // namespace thermotwin::thermal
