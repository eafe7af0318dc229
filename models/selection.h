#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "models/batch.h"
#include "models/mutual_information.h"
#include "models/ordered_clustering.h"

namespace thermotwin::models {

class SharedScreen;

struct SelectionOptions {
  std::optional<int> count;                ///< how many sensors; without it the method's own rule decides
  std::uint64_t seed = 1;                  ///< of permutations, random starts and shuffles
  double resolution = 0.0625;              ///< of the temperature readings [K], for the rank by time characteristic
  MutualInformationOptions information{};  ///< how the pre-screen counts; seed and block are its own
  Normalisation normalisation = Normalisation::across_sensors;  ///< of the readings that ordered clustering parts
  Eigen::MatrixXd mode_shapes{};  ///< p × modes: temperature of each sensor in each thermal mode, for "thermal_modes"
  std::shared_ptr<SharedScreen> shared{};  ///< with other methods, on the same batches with the same seed; may be none
};

/// What a method went by of a sensor or of a number of classes ("T3", "k = 4"): figures by name.
struct Evidence {
  std::string of;
  std::vector<std::pair<std::string, double>> figures;
};

/// What a method chose.
struct Selection {
  std::vector<Eigen::Index> sensors;  ///< columns of the batch, best first
  Eigen::VectorXd score;              ///< p: how informative the method holds each sensor; larger is better
  std::string remark;                 ///< what its user should know ("k = 4 by the improved rule"), or empty
  std::vector<Evidence> evidence{};   ///< of the information screen and of numbers of classes, where it has them
};

/// A way of choosing temperature points. The catalogue below is what studies, files and the command line read.
struct SelectionMethod {
  std::string_view name;     ///< as written in files, snake_case
  std::string_view meaning;  ///< one line
  std::string_view source;   ///< paper and section, or literature
  Selection (*select)(std::span<Batch const>, SelectionOptions const&);
  bool sees_error = true;  ///< false: the same choice whatever the error is
};

/// Every method, in the order of the papers, then the ones that the papers lacked.
std::span<SelectionMethod const> selection_methods();

/// The method of that name; refuses others with the nearest known name (std::invalid_argument).
SelectionMethod const& selection_method(std::string_view name);

}  // namespace thermotwin::models
