// SPDX-License-Identifier: Apache-2.0
// Writes points as LAS or LAZ.
#pragma once

#include <memory>

#include "format/pointio/point_file.h"
#include "format/pointio/point_sink.h"

namespace pointrt {

/// Writes points with the layout of planLas. Throws Error kCannotRun if packed is set in a build without LAZ.
std::unique_ptr<PointSink> lasPoints(PointFile file, const PointOutline& outline, bool packed);

} // namespace pointrt
