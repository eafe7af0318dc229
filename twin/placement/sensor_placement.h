#pragma once

#include <Eigen/Core>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scenarios/experiment.h"
#include "twin/file/value.h"
#include "twin/placement/candidate_sites.h"
#include "twin/placement/ensemble.h"
#include "twin/placement/snapshot_moments.h"

namespace thermotwin::twin {

/// What to place sensors for.
struct PlacementOptions {
  int sensors = 6;
  int dead = 0;        ///< sensors whose loss shall hurt least; every site then has room for as many spares
  double noise = 0.1;  ///< standard deviation of each sensor's own error [K]
  CandidateRules rules;
  std::vector<std::string> proposed;          ///< a set to judge: sites, sensors of the machine, or places
  EnsembleOptions design;                     ///< machines and spectra that decide
  int unseen_members = 24;                    ///< machines that took no part
  std::vector<scenarios::Experiment> unseen;  ///< what those are put through; none: spectra drawn anew
  Teacher teacher = Teacher::family;
  bool distinguish = false;  ///< choose such that missing effects are told apart, not by the error
  bool map = false;          ///< how informative every node is
};

/// What a set of sensors is worth.
struct SetFigures {
  struct Sensor {
    CandidateSite site;
    Eigen::Vector3d position{0.0, 0.0, 0.0};  ///< [m]
    double error_without_um = 0.0;            ///< of the others [1σ]
    bool idle = false;                        ///< without all idle ones the set is worse by less than 1 %
  };
  struct Channel {
    std::string name;
    double prior_um = 0.0, predicted_um = 0.0, unseen_um = 0.0;
  };

  std::vector<Sensor> sensors;  ///< the one that tells most first
  double model_um = 0.0;        ///< √V, what the search minimises
  /// 1σ to be expected of a machine that took no part, under spectra as the design's: its `experiments`, which all its
  /// machines share, or ones drawn anew. Of machines that teach themselves: under a spectrum that did not teach.
  double predicted_um = 0.0;
  double unseen_um = 0.0;                            ///< rms on machines and spectra that took no part
  double unseen_low_um = 0.0, unseen_high_um = 0.0;  ///< of their machines, 10 % and 90 %
  double worst_um = 0.0;                             ///< √V when the worst `dead` sensors are out of work
  double cost = 0.0;
  std::vector<Channel> channels;
};

/// How informative places are; NaN on bodies without candidates, where no sensor may sit.
struct InformationMap {
  Eigen::VectorXd alone_um;   ///< per node: by how much one sensor there lessens the error
  Eigen::VectorXd beside_um;  ///< the same beside the recommended set
};

/// How well missing effects are told apart: the smallest angle between the signatures of any two [rad].
struct Distinction {
  std::size_t effects = 0, pairs = 0;
  std::size_t alike = 0;  ///< pairs that a sensor at every candidate does not tell apart: cosine beyond 0.6
  double recommended = 0.0, of_all = 0.0;
  double for_displacement = 0.0;      ///< of the set that would be chosen for the displacement
  std::optional<double> fewer, more;  ///< of the best sets of one sensor less, and one more, where they can be had
  std::optional<double> proposed;
  std::string first, second;      ///< that the recommended set tells apart worst
  std::vector<std::string> idle;  ///< of the recommended: without all of them it is narrower by less than 1 %
  bool proved = false;            ///< all sets were looked at: none of that number has a wider smallest angle
};

/// A set that the user proposes, and the best that one change of it makes.
struct Proposed {
  SetFigures set;
  std::optional<SetFigures> fewer, more;  ///< without its least useful sensor; beside the most useful site
  std::string without, with;              ///< which these are
};

struct PlacementReport {
  std::string machine;
  std::set<std::string> taken;       ///< names that the machine's own sensors have
  std::vector<std::string> remarks;  ///< of these sets: what a budget ends, is idle, turns or is forbidden
  std::size_t candidates = 0;
  int members = 0, unseen_members = 0, dead = 0;
  std::size_t numbers = 0, ranged = 0;  ///< of the file: drawn for each member, and within a range that it states
  Teacher teacher = Teacher::family;
  std::vector<std::string> experiments, unseen_experiments;
  double noise = 0.0;
  double prior_um = 0.0;  ///< √V without any sensor
  double floor_um = 0.0;  ///< √V with a sensor at every candidate
  double bound_um = 0.0;  ///< √V of no set is less
  bool proved = false;    ///< all sets were looked at, and the recommended one has the least √V
  SetFigures recommended;
  std::optional<SetFigures> fewer, more;  ///< best sets of one sensor less, and one more
  std::optional<Proposed> proposed;
  std::optional<InformationMap> map;
  std::optional<Distinction> distinction;
};

/// Chooses sensors before the hardware exists: V of the tool's displacement, all channels together, over machines that
/// the file could stand for and spectra (Ensemble), by models::place; with few candidates all sets are looked at. What
/// `teacher` says the readings will be interpreted with is what V is of: one estimate for the whole family, or one for
/// each machine, known when the sensors are in use, and the mean over the machines is what the search minimises. Or,
/// to distinguish, for the smallest angle between effects that the machine may lack (EffectSignatures).
/// InputError for sensors that cannot be placed or names that are not there.
[[nodiscard]] PlacementReport place_sensors(Value const& document, PlacementOptions const& options);

[[nodiscard]] std::string placement_text(PlacementReport const& report);
[[nodiscard]] std::string placement_json(PlacementReport const& report);
/// The recommended sensors as tables of a machine file, by the names of their sites; P1, P2, … where a site has none of
/// its own, or a sensor of the machine has it.
[[nodiscard]] std::string sensor_tables(PlacementReport const& report);

}  // namespace thermotwin::twin
