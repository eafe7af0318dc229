#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "thermal/parameter_columns.h"
#include "twin/diagnosis/binned_run.h"
#include "twin/machine.h"

namespace thermotwin::twin {

struct ChannelReading;

/// What the channels show more per unit of each parameter, (channel · rows + row) × parameter; a row's stand together.
using ReadingByParameter = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Its columns, times a factor, to some of a matrix whose columns stand together.
void put_columns(ReadingByParameter const& response, double factor, std::vector<Eigen::Index> const& places,
                 Eigen::Ref<Eigen::MatrixXd> to);

/// The twin along a measured run, and the tangent-linear system about that course (physics.md 8.3):
///
///   ds/dt = A(t) s + ∂f/∂θ,   δz = H s,   A = ∂f/∂y,
///
/// integrated for all parameters at once with the two-stage L-stable method of Alexander (SIAM J. Numer. Anal. 14
/// (1977) 1006, eq. 2.9), γ = 1 − 1/√2, whose stages share one factorisation. The course itself is run in modes if the
/// network is small and has them, since the inputs of a day jump often, or else by CVODES; the forward sensitivities
/// along it (thermal::ForwardSensitivities) agree with these to a part in a thousand, but take CVODES' many steps.
class LinearisedRun {
 public:
  LinearisedRun(Machine const& machine, BinnedRun const& data);

  /// What the machine's channels would show: row × channel [SI].
  [[nodiscard]] Eigen::MatrixXd prediction() const { return prediction_of(*machine_); }
  /// The same temperatures seen by a machine whose sensors and displacements differ.
  [[nodiscard]] Eigen::MatrixXd prediction_of(Machine const& other) const;

  /// ∂f/∂θ at one end of a step, node × parameter [K/s per unit of θ].
  using Forcing = std::function<void(thermal::Evaluation&, double time, std::vector<double> const& state,
                                     std::vector<double> const& input, thermal::NodeByParameter& forcing)>;

  /// ∂z/∂θ. `initial`: node × parameter, dy/dθ where the steps begin. `first_step`: before it nothing is forced.
  [[nodiscard]] ReadingByParameter response(Forcing const& forcing, Eigen::MatrixXd const& initial,
                                            std::size_t first_step = 0) const {
    auto const no_leap = [](thermal::Evaluation&, std::size_t, thermal::NodeByParameter&) { return false; };
    return response(forcing, initial, no_leap, first_step);
  }
  /// The same for numbers of the machine. `forced_nodes`: nodes from there on have no forcing, −1: all have. A mass
  /// that a hypothesis brings along does not depend on its amplitude, as that goes to nothing.
  [[nodiscard]] ReadingByParameter response(thermal::ParameterColumns const& parameters,
                                            Eigen::MatrixXd const& initial = {}, int forced_nodes = -1) const;
  /// What the channels show more for every second that the inputs jumped earlier, at each of these times: f there with
  /// the inputs after the jump, less f with those before it, stored at once.
  [[nodiscard]] ReadingByParameter response_to_earlier(std::vector<double> const& jumps) const;
  /// To all of them a second earlier: what a clock that is a second behind theirs shows.
  [[nodiscard]] ReadingByParameter response_to_all_earlier() const;
  /// Σ wᵢ (Tᵢ(t) − Tᵢ(0)) with other weights for the machine's linear channels, row × channel: ∂z/∂θ of what moves the
  /// tool and no temperature.
  [[nodiscard]] Eigen::MatrixXd growth(std::vector<NodeWeights> const& displacements) const;
  [[nodiscard]] BinnedRun const& data() const { return *data_; }
  [[nodiscard]] Machine const& machine() const { return *machine_; }
  /// What every body receives more of in this machine than in another of the same nodes, at this machine's
  /// temperatures where each step begins: Σ C (dT/dt − dT/dt of the other) over the body's nodes [W].
  [[nodiscard]] std::map<std::string, Eigen::VectorXd> more_heat_than(Machine const& other) const;
  /// What every body receives more of per unit of a number, likewise [W per unit].
  [[nodiscard]] std::map<std::string, Eigen::VectorXd> more_heat_per_unit(
      thermal::NetworkDerivative const& number) const;
  /// Mean heat [W], while the spindle or an axis moves and while all stands.
  struct MeanHeat {
    double moving = 0.0, standing = 0.0;
  };
  /// Of what is given where each step begins.
  [[nodiscard]] MeanHeat mean(Eigen::VectorXd const& heat) const;

 private:
  /// One end of a step: the state there and the operating point on this side of a jump.
  struct End {
    double time;
    std::vector<double> state, input;
    std::vector<double> course;  ///< all channels of the data
    std::vector<double> bend;    ///< slope of the nodes' temperatures beyond that of the straight line [K/s]
  };
  /// Something along a step: its values at the ends, and its slopes there beyond that of the straight line.
  struct Piece {
    double from = 0.0, to = 0.0, bend_from = 0.0, bend_to = 0.0;
  };
  [[nodiscard]] std::map<std::string, Eigen::VectorXd> heat_of_bodies(
      std::function<void(End const&, Eigen::VectorXd& rates)> const& rates_at) const;
  void trace();
  [[nodiscard]] bool continues(std::size_t step) const;
  void bend(End& begin, End& end, std::vector<double> const& rate_at_begin,
            std::vector<double> const& rate_at_end) const;
  /// By which s jumps where a step begins; whether it does.
  using Leap = std::function<bool(thermal::Evaluation&, std::size_t step, thermal::NodeByParameter& s)>;
  [[nodiscard]] ReadingByParameter response(Forcing const& forcing, Eigen::MatrixXd const& initial, Leap const& leap,
                                            std::size_t first_step) const;
  /// Of `count` columns; `column_of` a step: that to which the jump at its begin belongs, or −1.
  [[nodiscard]] ReadingByParameter response_to_earlier(
      Eigen::Index count, std::function<Eigen::Index(std::size_t step)> const& column_of) const;
  /// Behind a first-order lag, exactly: a cubic, and what decays from the begin on.
  struct Lagged {
    Piece piece;
    double decaying = 0.0;  ///< at the begin
  };
  static Lagged lagged(double shown, Piece const& piece, double lag, double length);
  [[nodiscard]] double temperature(int node, End const& at) const;
  [[nodiscard]] Piece along(NodeWeights const& weights, std::size_t step) const;
  [[nodiscard]] Piece since_start(NodeWeights const& weights, std::size_t step) const;
  [[nodiscard]] Piece before_lag(ChannelReading const& channel, std::size_t step) const;
  /// The rows of one channel from its pieces, behind its lag.
  template <class Pieces>
  [[nodiscard]] Eigen::VectorXd rows_of(std::size_t channel, Pieces const& pieces, double lag) const;
  using ChannelByNode = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  [[nodiscard]] ChannelByNode weights() const;

  Machine const* machine_;
  BinnedRun const* data_;
  std::vector<End> begins_, ends_;  ///< of the steps
};

/// Whether the spindle or an axis moves at that time.
[[nodiscard]] bool is_moving(thermal::Course const& course, double time);

}  // namespace thermotwin::twin
