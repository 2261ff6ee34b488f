// SPDX-License-Identifier: Apache-2.0
// Writes points as E57 (ASTM E2807): one scan in the file's frame.
#pragma once

#include <memory>

#include "format/pointio/point_file.h"
#include "format/pointio/point_sink.h"

namespace pointrt {

std::unique_ptr<PointSink> e57PointSink(PointFile file, const PointOutline& outline);

} // namespace pointrt
