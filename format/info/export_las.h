// SPDX-License-Identifier: Apache-2.0
// Splats as a LAS or LAZ file: their centres with all attributes.
#pragma once

#include <string>

#include "format/info/export_source.h"

namespace pointrt {

/// Writes every splat of source, in its order: LAZ where path ends in .laz, else
/// LAS, as planLas says. Normals and radii, which LAS has no place for, are left out. path appears complete or not at
/// all. Throws Error: kCannotWrite, also when path exists and not overwrite; kCannotRun for LAZ in a build without it.
void exportLas(const ExportSource& source, const std::string& path, bool overwrite);

} // namespace pointrt
