#pragma once

#include <Eigen/Core>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "thermal/evaluation.h"
#include "twin/compensation/heated_states.h"
#include "twin/compensation/model_input.h"
#include "twin/diagnosis/warm_start.h"
#include "twin/machine.h"

namespace thermotwin::twin {

struct ObserverOptions {
  double heat_noise = 5e-3;    ///< of the twin: deviation of each node's temperature after one second [K/√s]
  double sensor_noise = 0.05;  ///< of a reading, with what its place differs from its node [K]
  double longest_step = 10.0;  ///< of the integration, up to a thousand of them between two decisions [s]

  bool operator==(ObserverOptions const&) const = default;
};

/// The twin running beside the machine, driven by its inputs and corrected by its sensors: an extended Kalman filter
/// (Jazwinski, Stochastic Processes and Filtering Theory, 1970, §8.3) on the network's own equations,
///
///   dy/dt = f(y, u) + w,   z_j = Σ w_ji T_i(y) + v_j,   P ← Φ P Φᵀ + q h I,  Φ = (I − h ∂f/∂y)⁻¹
///
/// integrated with ROS2 (Verwer, Spee, Blom, Hundsdorfer, SIAM J. Sci. Comput. 20 (1999) 1456: two stages, L-stable,
/// order 2), its sensors taken one by one. The error is what a displacement channel makes of its nodes, or a ball screw
/// of them at one of its positions.
///
/// The machine is at the temperature of the air around it when the first readings come, unless four of them or more say
/// that it is not (warm_start.h): switched on while the machine is warm, it begins with what its sensors tell of every
/// node (heated_states.h). Readings count as changes since then, so that constant offsets of the sensors do not matter.
/// A sensor that is first heard later is taken to have changed by what the twin says its place has. One that is not
/// believed is left out, and the twin goes on; an input that is missing leaves it without an estimate.
class TwinObserver {
 public:
  /// `sensors` correct it, in this order; none given: all that the machine has on bodies.
  ///
  /// InputError for a channel that the machine does not have, or an error along a screw that loses its pretension, a
  /// sensor that it does not have on a body, a machine with relays (whose switching the observer would have to guess),
  /// or more nodes than a dense covariance is made for.
  TwinObserver(Machine machine, std::string const& displacement, ObserverOptions const& options = {},
               std::optional<std::vector<std::string>> const& sensors = {});

  [[nodiscard]] ObserverOptions const& options() const { return options_; }
  [[nodiscard]] Machine const& machine() const { return machine_; }
  /// How warm each node is when the first readings come [K], where that is known.
  void begin_at(std::vector<double> temperatures) { known_start_ = std::move(temperatures); }
  /// The machine's inputs, required, then the sensors, each by itself dispensable.
  [[nodiscard]] std::vector<ModelInput> const& inputs() const { return inputs_; }
  /// Of one that began while the machine was warm.
  struct WarmBegin {
    std::string farthest;      ///< first readings: "T1 +6.4 K, T2 +6.3 K, T5 +6.0 K" over the air
    std::string contradicted;  ///< the sensor that all others contradict; empty: none
    double deviation = 0.0;    ///< of what the displacement then was from its error with the machine at rest [µm, 1σ]
  };
  [[nodiscard]] std::optional<WarmBegin> const& warm_begin() const { return warm_begin_; }
  /// Thermal error [µm] at `time` [s], which never goes back. NaN among the sensors: not believed.
  [[nodiscard]] double error(double time, std::span<double const> values);

  /// What it says that a sensor's temperature has changed by since the first readings [K]. InputError for another name.
  [[nodiscard]] double change(std::string const& sensor) const;
  [[nodiscard]] Eigen::VectorXd temperatures() const;  ///< of the nodes, as estimated [K]

 private:
  /// A channel that the network or the displacement needs, in SI.
  struct Channel {
    std::string name;
    double value = 0.0, first = 0.0;
  };
  void list_channels();
  void list_inputs();
  void list_sensors(std::optional<std::vector<std::string>> const& names);
  void start(double time, std::span<double const> values);
  void start_at(std::vector<double> const& temperatures);
  void start_in_air(std::span<double const> values);
  void start_warm(std::span<double const> values);
  [[nodiscard]] RunBegin begin(std::span<double const> readings) const;
  void set_channels(std::span<double const> values);
  [[nodiscard]] double given(std::string const& name, std::span<double const> values, double otherwise) const;
  [[nodiscard]] double floor_air(std::span<double const> values) const;  ///< at the machine's zero [K]
  void advance(double time);
  void step(double h);
  void correct(std::span<double const> values, double elapsed);
  [[nodiscard]] double seen(NodeWeights const& weights) const;
  [[nodiscard]] Eigen::VectorXd gradient(NodeWeights const& weights) const;
  [[nodiscard]] double displaced() const;

  Machine machine_;
  Displacement displacement_;
  ObserverOptions options_;
  std::vector<Channel> channels_;  ///< those of the network first, in its order
  std::vector<ModelInput> inputs_;
  std::vector<std::size_t> sensors_;  ///< of the machine: the last of the inputs
  std::shared_ptr<thermal::Evaluation> evaluation_;

  /// Made when a warm machine asks for it.
  struct Heated {
    std::once_flag once;
    std::optional<HeatedStates> states;
  };
  std::shared_ptr<Heated> heated_ = std::make_shared<Heated>();  ///< of all copies
  std::optional<std::vector<double>> known_start_;
  std::optional<WarmBegin> warm_begin_;
  bool started_ = false;
  double time_ = 0.0;
  Eigen::VectorXd state_, zero_readings_;  ///< of a reading [degC], NaN until the sensor is heard
  std::vector<double> zero_seen_;          ///< per sensor [K]
  Eigen::MatrixXd covariance_;
  double zero_displaced_ = 0.0;
};

}  // namespace thermotwin::twin
