// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of whole scans once all files are read: missing data, degrees without a coordinate system, units that differ.
#pragma once

#include "preprocess/ingest/sink.h"

namespace pointrt {

/// Removes the points without data that the sink found, and counts them.
void dropNoData(Sink& sink);

/// Whether x and y of a scan can hardly be lengths: they are within the ranges of longitude and latitude, and the scan
/// is a hundred times higher than wide.
bool looksLikeDegrees(const Eigen::AlignedBox3d& box);

/// The box around a scan's points in the cloud, input coordinates.
Eigen::AlignedBox3d boxOfScan(const Cloud& cloud, const ScanRange& scan);

/// Adds a note if a scan is about a thousand times the size of another, as one in millimetres beside one in metres.
void noteUnits(Sink& sink);

} // namespace pointrt
