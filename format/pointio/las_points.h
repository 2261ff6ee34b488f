// SPDX-License-Identifier: Apache-2.0
// Points as LAS or LAZ.
#pragma once

#include <memory>

#include "format/pointio/point_file.h"
#include "format/pointio/point_sink.h"

namespace pointrt {

/// As planLas lays it out. Throws Error kCannotRun for packed ones in a build without LAZ.
std::unique_ptr<PointSink> lasPoints(PointFile file, const PointOutline& outline, bool packed);

} // namespace pointrt
