// SPDX-License-Identifier: Apache-2.0
// Files of a profile.
#pragma once

#include <string>
#include <vector>

#include "pointrt/measure.hpp"

namespace pointrt {

/// decimals: of the numbers in these texts.
struct ProfileDrawing {
    std::vector<ProfilePoint> points; ///< as from surfaceProfile
    std::string unit;                 ///< of lengths, for labels; may be empty
    int decimals = 3;
    bool has_band = false; ///< low and high differ from height
};

/// A row for each point: station, x, y, z, height; with layers also their number, with a band also low and high. Where
/// there is no hit, z, height, low and high are empty.
std::string profileCsv(const ProfileDrawing& profile);
/// A 3D polyline in the scan's coordinates for each run of stations with hits, or a point for each hit if stations have
/// several hits.
std::string profileDxf(const ProfileDrawing& profile);
/// A chart of height over station, heights exaggerated by a round factor if they are flat; gaps stay gaps.
std::string profileSvg(const ProfileDrawing& profile);

} // namespace pointrt
