#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "output/dataset.h"

namespace thermotwin::twin {

/// Rows of a run in which all of these channels have a value; changes of all of them count from the first of these. A
/// remark says how many are left out, and for want of what: "5 of 31 rows are left out: no value of E_X in 3, of T2 in
/// 4"; another one, where that first row is not the run's. InputError that names the run, with what is remarked of it
/// already, where no row is left.
[[nodiscard]] std::vector<Eigen::Index> complete_rows(std::vector<output::Channel const*> const& channels,
                                                      std::string const& run, std::vector<std::string>& remarks);

}  // namespace thermotwin::twin
