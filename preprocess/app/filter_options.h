// SPDX-License-Identifier: GPL-3.0-or-later
// Command line values for the selection and the transform of points.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "preprocess/ingest/columns.h"

namespace pointrt {

/// Parses "MINX,MINY,MINZ,MAXX,MAXY,MAXZ". Throws Error (kBadUsage) unless it is six numbers with each minimum at most
/// its maximum.
Eigen::AlignedBox3d parseBounds(const std::string& text);

/// Parses a list of classes from 0 to 255, such as "2,6,9-17", to 256 flags. Throws Error (kBadUsage).
/// @param option name for the message
std::vector<bool> parseClasses(const std::string& option, const std::string& text);

/// Parses "auto", "none" or names separated by commas. Throws Error (kBadUsage) for an empty name.
AttributeChoice parseAttributes(const std::string& text);

/// Reads the 16 numbers, row by row, of a 4x4 matrix that maps column vectors (x, y, z, 1), as CloudCompare and PDAL
/// write it. Throws Error (kBadInput) if the file cannot be read, has another number of values or a last row other than
/// 0 0 0 1, or if the matrix is singular.
Eigen::Affine3d readTransform(const std::string& path);

/// The unit vector for "x" to "-z"; zero for "auto". Throws Error (kBadUsage).
Eigen::Vector3d parseUp(const std::string& text);

/// Strength of cleaning: 1 for "auto", 0 for "off", or a number from 0.1 to 10. Throws Error (kBadUsage).
double parseClean(const std::string& text);

} // namespace pointrt
