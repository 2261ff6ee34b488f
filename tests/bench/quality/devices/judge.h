// SPDX-License-Identifier: Apache-2.0
// What is asked of pictures of a world beyond what is asked of any picture: its walls, its trees, how it looks lit.
#pragma once

#include <nlohmann/json.hpp>

#include "tests/bench/quality/devices/cases.h"
#include "tests/bench/quality/raw/picture_errors.h"

namespace pointrt::quality {

/// Lines of sight through crowns that nothing hides before they come there.
struct GapCounts {
    std::size_t sights = 0, truth = 0, picture = 0; ///< all; and those that come out again
};
GapCounts countGaps(const World& world, const Sights& truth, const Sights& picture, const UnitCamera& camera);

/// Degrees without sign between the normals of truth and picture, where the truth is a wall's and seen.
std::vector<float> wallDegrees(const WorldTracing& world, const RawPoints& raw, double seen_reach, const Sights& truth,
                               const Sights& picture, const UnitCamera& camera);

/// A lit picture in grey: a lamp a little above the eye's right, Lambert's law and a tenth of light from all sides,
/// black where nothing is. The same light on truth and splats, without shadows, so that both differ only in what is
/// seen. Throws Error (kCannotWrite).
void writeLit(const std::string& path, const Sights& sights, const UnitCamera& camera);

/// Figures of one picture: those of figuresOf as "all" and "seen", "wall_normal_mean" and "gap", "gap_truth" where
/// there are walls and trees. Beside the picture's name it writes NAME.lit.png, NAME.truth.png and
/// NAME.errors.png (writeErrors).
nlohmann::ordered_json judgePicture(const DeviceCase& row, const WorldTracing& world, const RawPoints& raw,
                                    const Pinhole& camera, const std::string& picture_path);

} // namespace pointrt::quality
