#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "output/csv.h"
#include "output/dataset_file.h"
#include "tests/output/temporary_directory.h"
#include "twin/error_model_file.h"
#include "twin/experiment_file.h"
#include "twin/fit_error_model.h"
#include "twin/run.h"

namespace thermotwin::twin {

inline Eigen::VectorXd& readings(output::Dataset& data, std::string const& name) {
  for (auto* group : {&data.readings, &data.displacements})
    for (auto& channel : *group)
      if (channel.name == name) return channel.values;
  throw std::out_of_range(name);
}

/// A v450 with less grease than its file says.
inline output::Dataset poorly_greased(std::string const& experiment) {
  auto document = read_toml(machine_file("v450"));
  set_parameter(document, "bearing.front.grease_factor", "0.7");
  auto const file = experiment_file(experiment);
  return run(Machine::build(document), read_experiment(read_toml(file), file), {}).dataset;
}

/// Models that are fitted to runs in files.
class FitErrorModel : public testing::Test {
 protected:
  std::filesystem::path put_run(output::Dataset const& data, std::string const& name) {
    if (name.ends_with(".csv"))
      output::export_csv(data, folder_ / name);
    else
      output::write(data, folder_ / name);
    return folder_ / name;
  }
  SavedErrorModel fitted(ErrorModelFit const& fit) {
    remarks_.clear();
    return fit_error_model(fit, remarks_);
  }
  SavedErrorModel read_back(SavedErrorModel const& saved) {
    write_error_model(folder_ / "model.toml", saved);
    return read_error_model(folder_ / "model.toml");
  }
  static Eigen::RowVectorXd coefficients(SavedErrorModel const& saved) {
    return std::get<models::LinearForm>(saved.parts.at(0).model.form).coefficients.transpose();
  }

  thermotwin::tests::TemporaryDirectory folder_;
  std::vector<std::string> remarks_;
};

}  // namespace thermotwin::twin
