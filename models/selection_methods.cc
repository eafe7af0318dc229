#include <algorithm>
#include <array>
#include <stdexcept>

#include "models/correlation_grouping.h"
#include "models/d_optimal.h"
#include "models/exhaustive_selection.h"
#include "models/forward_selection.h"
#include "models/fuzzy_equivalence.h"
#include "models/grey_relation.h"
#include "models/information_screen.h"
#include "models/mode_sensors.h"
#include "models/ordered_selection.h"
#include "models/qr_pivot.h"
#include "models/selection.h"
#include "models/time_characteristic.h"
#include "models/time_ranked_clusters.h"
#include "models/unknown_name.h"

namespace thermotwin::models {

namespace {

// In the order of the papers, then the ones that the papers lacked.
constexpr auto methods = std::to_array<SelectionMethod>({
    {"mutual_information", "the two sensors of each component that tell most about the error",
     "Li, Li, Tao, Pang 2020 (methods.md 3.2)", select_by_mutual_information},
    {"ordered_improved", "ordered clustering; number of classes by F, t, R2 and residuals of the regression",
     "Li, Li, Tao, Pang 2020 (methods.md 3.6)", select_by_ordered_clustering_improved},
    {"ordered_ratio", "ordered clustering; number of classes where one more class helps most",
     "Li, Li, Tao, Pang 2020 (methods.md 3.5)", select_by_ordered_clustering_ratio},
    {"ordered_slope", "ordered clustering; number of classes where the loss falls most steeply",
     "Li, Li, Tao, Pang 2020 (methods.md 3.5)", select_by_ordered_clustering_slope},
    {"grey_fuzzy", "fuzzy equivalence classes by correlation; of each the sensor of the highest grey relational grade",
     "Li et al. 2020, Miao, Liu, Dong, Chen 2016 (methods.md 3.8)", select_by_grey_fuzzy_clustering},
    {"time_characteristic", "the sensors that stay longest at their maximum; the error is not looked at",
     "Yin, Liao, Wang 2019 (methods.md 4.2)", select_by_time_at_maximum, false},
    {"time_of_first_maximum", "the sensors that reach their maximum first; the error is not looked at",
     "Yin, Liao, Wang 2019 (methods.md 4.2)", select_by_first_maximum, false},
    {"fuzzy_c_means", "of each fuzzy cluster of temperature courses the sensor that stays longest at its maximum",
     "Yin, Liao, Wang 2019 (methods.md 4.3)", select_by_fuzzy_amplitude, false},
    {"fuzzy_c_means_shape", "the same with courses brought to the same height before they are clustered",
     "Yin, Liao, Wang 2019 (methods.md 4.3)", select_by_fuzzy_shape, false},
    {"thermal_modes", "sensors that leave least unknown of the error, which the machine's thermal modes make up",
     "Wu, Zhang, Guo, Wang, Yang 2008 (methods.md 6.1)", select_for_modes},
    {"grey_relational", "the sensors of the highest grey relational grade with the error",
     "Miao, Liu, Dong, Chen 2016 (methods.md 7.4)", select_by_grey_relation},
    {"correlation_grouping", "groups of correlated sensors; of each the one that follows the error best",
     "classical; Sokal, Michener 1958", select_by_correlation},
    {"qr_pivot", "pivots of a QR decomposition of the readings; the error is not looked at",
     "Manohar, Brunton, Kutz, Brunton 2018", select_by_qr_pivot, false},
    {"d_optimal", "largest determinant of the readings' covariance; the error is not looked at", "Shewry, Wynn 1987",
     select_d_optimal, false},
    {"forward", "one after another what lowers the error of a blocked cross-validation most", "Whitney 1971",
     select_forward},
    {"exhaustive", "the best of all sets by blocked cross-validation, among up to 20 sensors", "the truth",
     select_exhaustive},
});

}  // namespace

std::span<SelectionMethod const> selection_methods() { return methods; }

SelectionMethod const& selection_method(std::string_view name) {
  auto const found =
      std::find_if(methods.begin(), methods.end(), [&](auto const& method) { return method.name == name; });
  if (found != methods.end()) return *found;
  std::array<std::string_view, methods.size()> known;
  std::transform(methods.begin(), methods.end(), known.begin(), [](auto const& method) { return method.name; });
  throw std::invalid_argument(unknown_name("selection method", name, known));
}

}  // namespace thermotwin::models
