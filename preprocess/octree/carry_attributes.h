// SPDX-License-Identifier: GPL-3.0-or-later
// Attributes of the cloud's points to those of the splats, as the file holds them.
#pragma once

#include <vector>

#include "pointrt/pro.h"
#include "preprocess/cloud/cloud.h"
#include "preprocess/octree/quantize.h"

namespace pointrt {

/// Makes names and number of attributes what a .pro can hold: 31 bytes of UTF-8 without control characters, each once,
/// 32 of them; what had to change or go is noted.
void fitAttributes(Cloud& cloud);

/// The point whose attributes each splat carries, an index in the cloud: its own, or of one that fills a gap that of
/// filled_from.
std::vector<std::uint32_t> pointsOfSplats(const PackedSplats& splats);

/// The values in the order of the splats: splat i has those of point_of_splat[i]. attributes is emptied array by array.
std::vector<Attribute> carryAttributes(std::vector<Attribute>& attributes,
                                       const std::vector<std::uint32_t>& point_of_splat);

/// For pro_write_content; points into attributes, whose names must fit.
std::vector<pro_attribute> attributeViews(const std::vector<Attribute>& attributes);

/// PRO_SENSOR_DOUBLES a scan; empty where no sensor is known.
std::vector<double> sensorRows(const std::vector<Scan>& scans);

} // namespace pointrt
