#include "models/principal_component_distributed_lag.h"

#include "models/distributed_lag.h"
#include "models/principal_component.h"

namespace thermotwin::models {

ErrorModel fit_principal_component_distributed_lag(std::span<Batch const> batches, FitOptions const&) {
  return component_model("principal_component_distributed_lag",
                         training_set(batches, lags_up_to(distributed_lag_order)));
}

}  // namespace thermotwin::models
