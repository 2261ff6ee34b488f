// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/merge_input.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>

#include "preprocess/cloud/morton.h"

namespace pointrt {

namespace {

/// Position of a child's splat in the parent's core, [0, 1) on each axis: exact, as a child has one bit more than the
/// parent and floats have three. Clamps splats that cleaning moved outside to the border.
Vec3f placeOf(const TileKey& parent, const TileKey& child, const PositionCode& code) {
    Vec3f place;
    constexpr float kSteps = 2 * kCoreSteps; // steps of the child's level
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t corner = child.cell[axis] - 2 * std::int64_t{parent.cell[axis]};
        const float step = static_cast<float>(corner * kCoreSteps + code[axis]) + 0.5f;
        place[static_cast<int>(axis)] = std::clamp(step, 0.5f, kSteps - 0.5f) / kSteps;
    }
    return place;
}

struct Keyed {
    std::uint64_t curve;
    MergeSource source;
    bool operator<(const Keyed& other) const {
        if (curve != other.curve) return curve < other.curve;
        if (source.tile != other.source.tile) return source.tile < other.source.tile;
        return source.splat < other.source.splat;
    }
};

} // namespace

std::uint64_t curveCode(const Vec3f& place) {
    constexpr float kSteps = 1 << kMortonBits;
    const auto step = [](float each) { return static_cast<std::uint64_t>(each * kSteps); };
    return mortonCode(step(place.x()), step(place.y()), step(place.z()));
}

MergeInput takeMergeInput(const TileKey& parent, const std::vector<MergeChild>& children, double edge) {
    std::vector<Keyed> keys;
    for (std::uint32_t c = 0; c < children.size(); ++c)
        for (std::uint32_t i = 0; i < children[c].splats.positions.size(); ++i)
            keys.push_back({curveCode(placeOf(parent, children[c].tile, children[c].splats.positions[i])), {c, i}});
    tbb::parallel_sort(keys);
    MergeInput input;
    input.sources.resize(keys.size());
    input.discs.positions.resize(keys.size());
    input.discs.normals.resize(keys.size());
    input.discs.radii.resize(keys.size());
    tbb::parallel_for(std::size_t{0}, keys.size(), [&](std::size_t k) {
        const MergeSource source = input.sources[k] = keys[k].source;
        const MergeChild& child = children[source.tile];
        input.discs.positions[k] = placeOf(parent, child.tile, child.splats.positions[source.splat]);
        input.discs.normals[k] = normalOf(child.splats.normals[source.splat]);
        input.discs.radii[k] = static_cast<float>(child.splats.radius(source.splat) / edge);
    });
    return input;
}

PositionCode codeAt(const Vec3f& place) {
    PositionCode code;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const float step = place[static_cast<int>(axis)] * static_cast<float>(kCoreSteps);
        code[axis] = std::clamp(static_cast<std::int32_t>(step), 0, kCoreSteps - 1);
    }
    return code;
}

} // namespace pointrt
