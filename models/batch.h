#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

namespace thermotwin::models {

/// One run as the methods of selection and regression see it: readings of named temperature sensors, and the thermal
/// error that they shall explain. Rows are instants, columns are sensors; N instants, p sensors.
struct Batch {
  std::string name;
  Eigen::VectorXd time;                 ///< N, ascending [s]; equidistant where a method uses lags
  std::vector<std::string> sensors;     ///< p names, each once
  std::vector<std::string> components;  ///< p: the machine's component on which each sensor sits
  Eigen::MatrixXd temperature_rise;     ///< N × p: change since the first instant [K]
  Eigen::VectorXd error;                ///< N: thermal error [µm]
  Eigen::MatrixXd before{};             ///< of a batch cut out of a run: the readings before it, in the same steps;
                                        ///< none: before the first instant the machine rested
};

/// Throws std::invalid_argument with a sentence that names the batch, unless sizes agree, names are unique,
/// time ascends and every number is finite.
void check(Batch const& batch);

/// Whether two batches of the same sensors hold the same readings at the same times, whatever the errors.
bool same_readings(Batch const& a, Batch const& b);

/// Whether they hold the same errors, too, whatever they are called.
bool same_data(Batch const& a, Batch const& b);

/// The batches one below the other; all must have the same sensors in the same order (std::invalid_argument otherwise).
Batch stacked(std::span<Batch const> batches);

/// The batch with only these columns, in this order.
Batch with_sensors(Batch const& batch, std::span<Eigen::Index const> sensors);

/// Adds rows of a batch as a run of their own, or to the last run if the batch was cut out of one.
void add_rows(std::vector<Eigen::Index>& run_lengths, Batch const& batch, Eigen::Index rows);

/// Rows of each run of these batches, one below the other.
std::vector<Eigen::Index> run_lengths(std::span<Batch const> batches);

/// Column numbers of these names; a name that the batch does not have is refused with the names that it has.
std::vector<Eigen::Index> columns_of(Batch const& batch, std::span<std::string const> names);

}  // namespace thermotwin::models
