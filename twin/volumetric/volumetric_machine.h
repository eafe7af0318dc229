#pragma once

#include "output/dataset.h"
#include "twin/file/value.h"
#include "twin/instruments/laser_interferometer.h"
#include "twin/volumetric/volumetric_description.h"
#include "twin/volumetric/volumetric_model.h"

namespace thermotwin::twin {

/// A machine file's `[volumetric]` and `[laser]`, ready to be measured.
struct VolumetricMachine {
  VolumetricDescription description;
  LaserInterferometer laser;
  Workspace workspace;
  GeometricErrors cold;  ///< as the file gives or draws them

  [[nodiscard]] VolumetricModel model(GeometricErrors errors) const;
};

/// From a document that was read. FileError with the place of what is wrong, InputError without the table.
[[nodiscard]] VolumetricMachine read_volumetric(Value const& document);

/// The elements after `time` [s] of a run of that machine (its nearest sample), which counts from its own start:
///
/// * linear element of an axis with a screw: the screw's error of position at its channels ("E_P_120mm"), or, without
///   them, along the laser's targets on that axis, as a table along the axis; the sign follows screw_from, screw_to;
/// * every `growth` adds factor · channel to its element, at all positions alike.
///
/// True displacements of a simulated run, the measured ones of any other. InputError for a channel that is not there.
[[nodiscard]] GeometricErrors warmed(VolumetricMachine const& machine, output::Dataset const& run, double time);

}  // namespace thermotwin::twin
