// SPDX-License-Identifier: GPL-3.0-or-later
// Lines that a bake prints for the user: the points it read, what it did with them, and its result.
#pragma once

#include <string>

#include "preprocess/app/report.h"

namespace pointrt {

/// "scan.laz: LAZ, 81590 points", or one line for all files.
std::string inputLine(const BakeReport& report);

/// "left out 3 of 81590 points (1 not finite, 2 outliers); moved 4630 to smooth noise": everything that was left out,
/// moved or added, and the options that turn it off.
std::string changesLine(const BakeReport& report);

/// "81238 splats, 12.3 MB, 5.10 s; up is z, from the scan's ground (change it with --up)".
std::string summaryLine(const BakeReport& report);

/// Details of the octree, for -v.
std::string octreeLine(const BakeReport& report);

} // namespace pointrt
