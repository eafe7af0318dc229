#include "twin/machine_tables.h"

#include "twin/machine.h"
#include "twin/uncertain_range.h"
#include "twin/volumetric/volumetric_description.h"

namespace thermotwin::twin {

std::vector<TableRecord> describe_machine() {
  std::vector<TableRecord> tables = {
      {"machine", "the keys at the top of the file", list_fields<HeadDescription>()},
      {"spindle", "the main spindle", list_fields<SpindleDescription>()},
      {"axis", "a linear axis driven by a screw", list_fields<AxisDescription>()},
      {"material", "a solid of this machine", list_fields<MaterialDescription>()},
      {"lump", "a body of one temperature", list_fields<LumpDescription>()},
      {"bar", "a body whose temperature varies along it; faces: surface, start, end", list_fields<BarDescription>()},
      {"hollow_cylinder", "axial × radial cells; faces: outer, inner, start, end",
       list_fields<HollowCylinderDescription>()},
      {"block", "a box of cells; faces: x_min, x_max, y_min, y_max, z_min, z_max", list_fields<BlockDescription>()},
      {"channel", "a fluid that moves along a line; face: wall", list_fields<ChannelDescription>()},
      {"temperature_sensor", "an instrument at a place, or at a mean of several", list_fields<SensorDescription>()},
      {"rotation", "a rotation of the tool relative to the workpiece", list_fields<DisplacementDescription>()},
      {"displacement", "a displacement of the tool relative to the workpiece", list_fields<DisplacementDescription>()},
      {"ball_screw", "error of position along a stroke", list_fields<BallScrewDescription>()},
      {"displacement_probe", "an eddy-current or capacitive probe", list_fields<ProbeDescription>()},
      {"five_probe_nest", "X1, Y1, X2, Y2 and Z about a test bar; one table", list_fields<FiveProbeNest>()},
      {"laser", "laser interferometer along an axis; one table", list_fields<LaserInterferometer>()},
      {"volumetric", "21 error elements of a machine with three linear axes; one table",
       list_fields<VolumetricDescription>()},
      {"uncertain", "a number of this file that is known within a range only", list_fields<UncertainRange>()}};
  for (auto const& entry : effect_catalogue()) tables.push_back({entry.name, entry.meaning, entry.parameters});
  return tables;
}

std::vector<std::string> const& machine_keys() {
  static std::vector<std::string> const keys = [] {
    auto const tables = describe_machine();
    std::vector<std::string> all;
    for (auto const& field : tables.front().fields) all.push_back(field.key);
    for (std::size_t t = 1; t < tables.size(); ++t) all.push_back(tables[t].name);
    return all;
  }();
  return keys;
}

}  // namespace thermotwin::twin
