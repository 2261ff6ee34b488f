// SPDX-License-Identifier: Apache-2.0
// Results of a study as attributes of the scan they belong to: -o NAME.pro.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "format/pointio/point_sink.h"

namespace pointrt {

/// Whether results go into a copy of the scan.
bool isProOutput(const std::string& output);

/// The .pro that all of a study's points come from: the .pro itself, or that of a scene file with a single scan.
/// @param points of the study; "": those of the scene
/// Throws Error kBadUsage "-o: ..." for tile sets, several scans and other points.
std::string scanOfResults(const std::string& points, const std::vector<std::string>& scene);

/// Takes blocks whose last columns are the results, with a row for each splat of the scan in the order of its file.
/// Writes a copy of the scan with these attributes, which replace existing ones of the same names. Throws Error
/// kBadInput for a scan of Gaussians, which have no attributes, or with too many attributes.
std::unique_ptr<PointSink> openProSink(const std::string& output, const std::string& scan,
                                       const std::vector<PointColumn>& results);

} // namespace pointrt
