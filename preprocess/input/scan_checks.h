// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of whole scans once all files are read: missing data, degrees without a coordinate system, units that differ.
#pragma once

#include <span>

#include "preprocess/ingest/sink.h"

namespace pointrt {

/// Removes the points without data that the sink found, and counts them.
void dropNoData(Sink& sink);

/// Whether x and y of a scan can hardly be lengths: they are within the ranges of longitude and latitude, and the scan
/// is a hundred times higher than wide.
bool looksLikeDegrees(const Eigen::AlignedBox3d& box);

/// The same for a file's scans in the cloud, taken together.
bool looksLikeDegrees(const Cloud& cloud, std::span<const ScanRange> scans);

/// Adds a note if a scan is about a thousand times the size of another, as if one were in millimetres and the other in
/// metres.
void noteUnits(Sink& sink);

} // namespace pointrt
