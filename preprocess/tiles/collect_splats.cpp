// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/collect_splats.h"

#include <algorithm>
#include <cmath>

#include "preprocess/octree/disc_box.h"

namespace pointrt {

namespace {

/// The core within its cube.
const Box kCore{Vec3f::Constant(0.25f), Vec3f::Constant(0.75f)};

Vec3f cubePosition(const PositionCode& code) {
    Vec3f position;
    for (int axis = 0; axis < 3; ++axis)
        position[axis] =
            (static_cast<float>(code[static_cast<std::size_t>(axis)] + kRimSteps) + 0.5f) * PRO_POSITION_STEP;
    return position;
}

/// Largest distance along an axis from a code to the core, cube units: a lower bound of the distance.
float leastDistance(const PositionCode& code) {
    std::int32_t most = 0;
    for (const std::int32_t each : code) most = std::max({most, -each, each - kCoreSteps + 1});
    return static_cast<float>(most) * PRO_POSITION_STEP;
}

/// radius: cube units
bool reachesCore(const PositionCode& code, std::uint32_t normal_word, float radius) {
    // a slab's corner lies sqrt(1 + kBlendSlab^2) radii from the centre; one more radius for blending
    static const float kReach = 1 + std::sqrt(1 + kBlendSlab * kBlendSlab);
    if (leastDistance(code) > kReach * radius) return false;
    const Disc disc{cubePosition(code), normalOf(normal_word), radius};
    const Box near{kCore.lo.array() - radius, kCore.hi.array() + radius};
    return discOverlapsBox(disc, growBySlab(near, disc, kBlendSlab));
}

} // namespace

void collectSplats(const TileKey& tile, double edge, const TileKey& from, const SplatsView& splats,
                   CollectedSplats& collected) {
    const double scale = 2 * edge;
    for (std::size_t i = 0; i < splats.positions.size(); ++i) {
        const auto code = codeIn(tile, from, splats.positions[i]);
        if (!code) continue;
        const bool own = isInCore(*code);
        if (!own && !reachesCore(*code, splats.normals[i], static_cast<float>(splats.radius(i) / scale))) continue;
        appendSplat(collected.splats, splats, i, *code);
        collected.own += own;
    }
}

} // namespace pointrt
