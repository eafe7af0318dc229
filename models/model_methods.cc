#include <algorithm>
#include <array>
#include <stdexcept>

#include "models/back_propagation.h"
#include "models/distributed_lag.h"
#include "models/distributed_lag_adhoc.h"
#include "models/error_model.h"
#include "models/genetic_back_propagation.h"
#include "models/least_squares_support_vector.h"
#include "models/linear.h"
#include "models/principal_component.h"
#include "models/principal_component_distributed_lag.h"
#include "models/ridge.h"
#include "models/ridge_distributed_lag.h"
#include "models/support_vector.h"
#include "models/unknown_name.h"

namespace thermotwin::models {

namespace {

constexpr std::array catalogue = {
    ModelMethod{"linear", "multiple linear regression on the readings of one instant", "paper 000, methods.md §3.6",
                fit_linear},
    ModelMethod{"support_vector", "ε-SVR with Gaussian kernel, (C, g) by blocked cross-validation on 2⁻⁴ … 2⁴",
                "paper 001, methods.md §4.4; Chang & Lin 2011", fit_support_vector},
    ModelMethod{"least_squares_support_vector", "LS-SVM with Gaussian kernel, γ = 56.2, σ² = 0.2",
                "paper 002, methods.md §5.6; Suykens & Vandewalle 1999", fit_least_squares_support_vector},
    ModelMethod{"back_propagation", "network M-(2M+1)-1 by gradient descent from a random start",
                "paper 003, methods.md §6.2", fit_back_propagation},
    ModelMethod{"genetic_back_propagation", "the same network from the start that a genetic search found",
                "paper 003, methods.md §6.3", fit_genetic_back_propagation},
    ModelMethod{"distributed_lag", "least squares on the last three readings of each sensor",
                "paper 004, methods.md §7.1", fit_distributed_lag},
    ModelMethod{"distributed_lag_adhoc", "least squares on as many readings back as the sequential rule admits",
                "paper 004, methods.md §7.1; Alt 1942", fit_distributed_lag_adhoc},
    ModelMethod{"principal_component", "regression on the components with 85 % of the variance",
                "paper 004, methods.md §7.2", fit_principal_component},
    ModelMethod{"principal_component_distributed_lag", "the same on the last three readings of each sensor",
                "paper 004, methods.md §7.3", fit_principal_component_distributed_lag},
    ModelMethod{"ridge", "ridge regression on the readings of one instant, penalty by blocked cross-validation",
                "Hoerl & Kennard 1970", fit_ridge},
    ModelMethod{"ridge_distributed_lag", "ridge regression on readings up to 80 min back, spread geometrically",
                "Hoerl & Kennard 1970; Maddala 1974", fit_ridge_distributed_lag},
};

}  // namespace

std::span<ModelMethod const> model_methods() { return catalogue; }

ModelMethod const& model_method(std::string_view name) {
  auto const* const found =
      std::find_if(catalogue.begin(), catalogue.end(), [&](ModelMethod const& method) { return method.name == name; });
  if (found != catalogue.end()) return *found;
  std::vector<std::string_view> known;
  for (auto const& method : catalogue) known.push_back(method.name);
  throw std::invalid_argument(unknown_name("model", name, known));
}

}  // namespace thermotwin::models
