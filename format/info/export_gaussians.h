// SPDX-License-Identifier: Apache-2.0
// Exports Gaussians as viewers and trainers of 3D Gaussian splatting read them.
#pragma once

#include <string>

#include "format/info/export_source.h"

namespace pointrt {

/// Writes the Gaussians of source, in its order, as a PLY of 3D Gaussian splatting (Kerbl et al. 2023): float
/// properties x y z, nx ny nz (0), f_dc_0 to 2, f_rest_* (all of red, then green, then blue), opacity as a logit,
/// scale_0 to 2 as logarithms of deviations in input units, rot_0 to 3 (w x y z). "-" is standard output. Throws Error
/// kCannotWrite, also if path exists and overwrite is false.
/// @param source has Gaussians
void exportGaussians(const ExportSource& source, const std::string& path, bool overwrite);

} // namespace pointrt
