#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "output/dataset.h"

namespace thermotwin::twin {

/// Rows of a run in which all of these channels have a value. A remark says how many are left out, and for want of
/// what: "5 of 31 rows are left out: no value of E_X in 3, of T2 in 4". InputError that names the run, with what is
/// remarked of it already, where no row is left.
[[nodiscard]] std::vector<Eigen::Index> complete_rows(std::vector<output::Channel const*> const& channels,
                                                      std::string const& run, std::vector<std::string>& remarks);

/// The row that a channel's changes count from: of its first value. A remark says so where that is not the first row.
[[nodiscard]] Eigen::Index first_value(output::Channel const& channel, std::vector<std::string>& remarks);

}  // namespace thermotwin::twin
