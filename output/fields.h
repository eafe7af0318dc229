#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "thermal/geometry.h"

namespace thermotwin::output {

/// What fields show at one time, per node of the network; nodes beyond the geometry's last (fluids) are not looked at.
struct Frame {
  Eigen::VectorXd temperature_degC;  ///< of a difference or a residual: in K, NaN where it is not known
  Eigen::VectorXd heat_source_W;     ///< made in the node; empty: none
  Eigen::Matrix3Xd displacement_m;   ///< of the cells' centres; empty: none
  Eigen::VectorXd sensor_degC;       ///< at the sensors of FieldOptions, in their order
};

struct SensorPlace {
  std::string name;
  Eigen::Vector3d position_m{0.0, 0.0, 0.0};
};

/// What the numbers of a series are.
enum class FieldMeaning {
  state,       ///< of a machine
  difference,  ///< of two machines: temperature [K] and displacement
  residual     ///< of a measurement and a machine: temperature [K]
};

struct FieldOptions {
  double reference_degC = 20.0;                 ///< temperature_rise_K is counted from here
  std::map<std::string, std::string> metadata;  ///< goes into every file as field data
  std::vector<SensorPlace> sensors{};
  Eigen::Vector3d up{0.0, 0.0, 1.0};
  FieldMeaning meaning = FieldMeaning::state;
};

/// A series of fields that ParaView opens: `<directory>/fields.pvd` names the times, `field_0000.vtu`, … hold the
/// cells.
///
/// Cell data: temperature_degC, temperature_rise_K, heat_source_W_per_m3, displacement_um, node, body (a number),
/// body_name. Point data: displacement_um, continuous within a body; "Warp By Vector" with scale 1e-6 × magnification.
/// Field data: body_names, TimeValue [s], the metadata. Coordinates in metre, in the machine's axes.
/// Sensors are a second series, `sensors.pvd` with `sensors_0000.vtp`, …: points with temperature_degC and name.
/// `arranged.pvsm` opens both in ParaView (paraview_state.h), colours and magnification for all frames so far.
///
/// A difference has temperature_difference_K (cells and sensors) and displacement_difference_um (cells and points) in
/// place of temperature, rise, heat and displacement; a residual only temperature_residual_K. A sensor that shows
/// nothing at a time (NaN) is not among that time's points.
///
/// Every file is replaced atomically and the .pvd names only what is there, so that it is readable at any moment.
class FieldSeries {
 public:
  /// Throws OutputError when the directory cannot be made, thermal::InputError when the geometry is empty.
  FieldSeries(std::filesystem::path directory, thermal::Geometry const& geometry, FieldOptions options = {});
  ~FieldSeries();
  FieldSeries(FieldSeries const&) = delete;
  FieldSeries& operator=(FieldSeries const&) = delete;

  /// Throws thermal::InputError when the frame has fewer values than the geometry has nodes.
  void add(double time_s, Frame const& frame);

  [[nodiscard]] std::filesystem::path index_path() const;

 private:
  struct Grid;
  void add_sensors(double time_s, Frame const& frame);
  void widen(Frame const& frame);
  void arrange(Frame const& frame);

  std::filesystem::path directory_;
  FieldOptions options_;
  std::vector<double> times_s_;
  double lowest_degC_ = 1e9, highest_degC_ = -1e9, largest_m_ = 0.0;
  std::unique_ptr<Grid> grid_;
};

/// One file of a series, as VTK reads it back.
struct FieldSummary {
  double time_s = 0.0;
  std::map<std::string, std::string> metadata;
  std::vector<std::string> body_names;

  Eigen::VectorXd volume_m3;  ///< per cell, as are the following
  Eigen::VectorXd temperature_degC, temperature_rise_K, heat_source_W_per_m3;
  Eigen::Matrix3Xd displacement_um;
  Eigen::VectorXi node, body;
  std::vector<std::string> body_name;

  Eigen::Matrix3Xd points_m;  ///< per point, as is the following
  Eigen::Matrix3Xd point_displacement_um;
};

/// Throws thermal::InputError when it is no file of a series.
[[nodiscard]] FieldSummary read_field(std::filesystem::path const& path);

}  // namespace thermotwin::output
