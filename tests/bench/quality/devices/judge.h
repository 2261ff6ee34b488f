// SPDX-License-Identifier: Apache-2.0
// Additional measures for pictures of a world: its walls, its trees, and how it looks lit.
#pragma once

#include <nlohmann/json.hpp>

#include "tests/bench/quality/devices/cases.h"
#include "tests/bench/quality/raw/picture_errors.h"

namespace pointrt::quality {

/// Numbers of sightlines into crowns of trees with nothing in front.
struct GapCounts {
    std::size_t sights = 0;             ///< all
    std::size_t truth = 0, picture = 0; ///< those that pass through the crown, in the truth and in the picture
};
GapCounts countGaps(const World& world, const Sights& truth, const Sights& picture, const UnitCamera& camera);

/// Unsigned angles in degrees between the normals of truth and picture, on walls that were scanned.
std::vector<float> wallDegrees(const WorldTracing& world, const RawPoints& raw, double seen_reach, const Sights& truth,
                               const Sights& picture, const UnitCamera& camera);

/// Writes a lit picture in grey: a lamp slightly above and to the right of the eye, Lambert's law plus 10% ambient
/// light, black background. Truth and splats have the same light and no shadows, so that they differ only in geometry.
/// Throws Error (kCannotWrite).
void writeLit(const std::string& path, const Sights& sights, const UnitCamera& camera);

/// Figures of one picture: those of figuresOf as "all" and "seen"; "wall_normal_mean" if there are walls; "gap" and
/// "gap_truth" if there are trees. Also writes NAME.lit.png, NAME.truth.png and NAME.errors.png (writeErrors).
nlohmann::ordered_json judgePicture(const DeviceCase& row, const WorldTracing& world, const RawPoints& raw,
                                    const Pinhole& camera, const std::string& picture_path);

} // namespace pointrt::quality
