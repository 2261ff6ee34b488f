// SPDX-License-Identifier: Apache-2.0
// Writes points as PCD 0.7, binary.
#pragma once

#include <memory>

#include "format/pointio/point_file.h"
#include "format/pointio/point_sink.h"

namespace pointrt {

std::unique_ptr<PointSink> pcdPoints(PointFile file, const PointOutline& outline);

} // namespace pointrt
