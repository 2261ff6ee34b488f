// SPDX-License-Identifier: GPL-3.0-or-later
// Attributes of the points in the order of the splats, as the file holds them.
#pragma once

#include <vector>

#include "pointrt/pro.h"
#include "preprocess/cloud/cloud.h"
#include "preprocess/octree/quantize.h"

namespace pointrt {

/// Fits the attributes to the limits of a .pro: unique names of at most 31 bytes of UTF-8 without control characters,
/// and at most 32 attributes. Adds a note for each change.
void fitAttributes(Cloud& cloud);

/// The index in the cloud of the point that gives each splat its attributes: its own point, or filled_from for splats
/// that fill gaps.
std::vector<std::uint32_t> sourcePoints(const PackedSplats& splats);

/// The values in the order of the splats: those of point_of_splat[i] for splat i. Frees attributes one by one.
std::vector<Attribute> gatherAttributes(std::vector<Attribute>& attributes,
                                        const std::vector<std::uint32_t>& point_of_splat);

/// For pro_write_content; points into attributes, which must be fitted.
std::vector<pro_attribute> attributeViews(const std::vector<Attribute>& attributes);

/// PRO_SENSOR_DOUBLES per scan; empty if no sensor is known.
std::vector<double> sensorRows(const std::vector<Scan>& scans);

} // namespace pointrt
