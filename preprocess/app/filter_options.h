// SPDX-License-Identifier: GPL-3.0-or-later
// Words of the command line about which points are read, and where they go.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "preprocess/input/columns.h"

namespace pointrt {

/// "MINX,MINY,MINZ,MAXX,MAXY,MAXZ". Throws Error (kBadUsage) when it is not six numbers with no minimum above its
/// maximum.
Eigen::AlignedBox3d parseBounds(const std::string& text);

/// Marks the classes of a list, "2,6,9-17": 256 flags. Throws Error (kBadUsage) on anything else, and above 255.
/// option: for the message
std::vector<bool> parseClasses(const std::string& option, const std::string& text);

/// "auto", "none" or names with commas between them. Throws Error (kBadUsage) on an empty name.
AttributeChoice parseAttributes(const std::string& text);

/// A file of 16 numbers, the rows of a 4x4 matrix that takes columns (x, y, z, 1) to where they go, as CloudCompare and
/// PDAL write it. Throws Error (kBadInput) when it cannot be read, is of another size, has a last row other than
/// 0 0 0 1, or flattens space.
Eigen::Affine3d readTransform(const std::string& path);

/// A unit vector of "x" to "-z"; zero of "auto". Throws Error (kBadUsage).
Eigen::Vector3d parseUp(const std::string& text);

/// Strength of cleaning: "auto" is 1, "off" 0, or a number from 0.1 to 10.
double parseClean(const std::string& text);

} // namespace pointrt
