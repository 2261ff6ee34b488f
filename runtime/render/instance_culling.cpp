// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/instance_culling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "runtime/render/pooled_tiles.h"

namespace pointrt {
namespace {

/// Smallest number of instances for which culling is faster: culling a ray takes about as long as missing two or three
/// instances (tests/bench/NOTES.md, "Tiles of a set").
constexpr std::size_t kFewestCulled = 4;
/// Boxes of the smaller culling programs: an unused box costs as much as a used one.
constexpr std::uint32_t kFewBoxes = 8;

using Vector = std::array<double, 3>;
/// Rows of a rotation.
using Rows = std::array<Vector, 3>;

/// Rotation from render space to the cube of an instance.
Rows rotationOf(const gpu::InstanceParams& params) {
    const double scale = params.splat.w;
    const auto row = [&](const gpu::vec4& v) { return Vector{v.x / scale, v.y / scale, v.z / scale}; };
    return {row(params.row_x), row(params.row_y), row(params.row_z)};
}

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// A point of the cube in render space, by the transposed rows.
Vector renderPoint(const gpu::InstanceParams& params, const Vector& cube) {
    const Rows rotation = rotationOf(params);
    const double scale = params.splat.w;
    const Vector rotated{(cube[0] - params.row_x.w) / scale, (cube[1] - params.row_y.w) / scale,
                         (cube[2] - params.row_z.w) / scale};
    Vector point{};
    for (std::size_t axis = 0; axis < 3; ++axis)
        point[axis] = rotation[0][axis] * rotated[0] + rotation[1][axis] * rotated[1] + rotation[2][axis] * rotated[2];
    return point;
}

/// A corner, selected by three bits, of the part of an instance that rays traverse (traversedBox in
/// shaders/trace/entry_grid.glsl), in its cube.
Vector traversedCorner(const gpu::InstanceParams& params, unsigned corner) {
    const gpu::vec4 &low = params.core_low, &high = params.core_high;
    const double margin = low.w;
    const auto end = [&](unsigned axis, float core_low, float core_high, std::uint32_t origin, std::uint32_t size) {
        const double in_grid = (corner >> axis & 1) != 0 ? std::min<double>(core_high + margin, size)
                                                         : std::max<double>(core_low - margin, 0);
        return (in_grid + origin) / params.grid_scale.x;
    };
    return {end(0, low.x, high.x, params.grid_origin.x, params.grid_size.x),
            end(1, low.y, high.y, params.grid_origin.y, params.grid_size.y),
            end(2, low.z, high.z, params.grid_origin.z, params.grid_size.z)};
}

/// A box along the axes of a frame.
struct Box {
    Vector low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};
    static constexpr double kFar = std::numeric_limits<double>::max();

    void add(const Vector& at) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], at[axis]);
            high[axis] = std::max(high[axis], at[axis]);
        }
    }
    double longestEdge() const { return std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]}); }
};

/// The box around an instance in a frame with these rows, grown by the rounding error of its coordinates.
Box boxAround(const Rows& frame, const gpu::InstanceParams& params) {
    Box box;
    double largest = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const Vector at = renderPoint(params, traversedCorner(params, corner));
        const Vector in_frame{dot(frame[0], at), dot(frame[1], at), dot(frame[2], at)};
        box.add(in_frame);
        for (const double along : in_frame) largest = std::max(largest, std::abs(along));
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box.low[axis] -= static_cast<double>(CULL_ROUNDING) * largest;
        box.high[axis] += static_cast<double>(CULL_ROUNDING) * largest;
    }
    return box;
}

/// The smallest box in whole steps from origin that contains box, as its centre and half edges.
std::array<std::uint32_t, 2> packBox(const Box& box, const Vector& origin, double steps) {
    std::array<std::uint32_t, 2> words{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double low = (box.low[axis] - origin[axis]) * steps, high = (box.high[axis] - origin[axis]) * steps;
        const double middle = std::round(0.5 * (low + high)), half = std::ceil(std::max(high - middle, middle - low));
        words[0] |= static_cast<std::uint32_t>(middle) << axis * CULL_BITS;
        words[1] |= static_cast<std::uint32_t>(half) << axis * CULL_BITS;
    }
    return words;
}

/// Whether instances may share a cull group: tiles of one set, which share an orientation that fits all their boxes, or
/// whole files.
bool mayShareGroup(const Instance& a, const Instance& b) { return a.number == b.number || (!a.tile && !b.tile); }

} // namespace

bool mayCull(const DeviceScene& scene) { return !scene.sets.empty() || scene.instances.size() >= kFewestCulled; }

gpu::CullBoxes makeCullBoxes(const DeviceScene& scene, std::span<const std::size_t> places) {
    gpu::CullBoxes packed{};
    const Rows frame = rotationOf(scene.instances[places[0]].params);
    std::vector<Box> boxes;
    Box all;
    for (const std::size_t place : places) {
        boxes.push_back(boxAround(frame, scene.instances[place].params));
        all.add(boxes.back().low);
        all.add(boxes.back().high);
    }
    // one step fewer than available: the half edges of a box are rounded up
    const double steps = (CULL_STEPS - 1) / all.longestEdge();
    const auto row = [&](std::size_t axis) {
        const auto scaled = [&](double v) { return static_cast<float>(v * steps); };
        return gpu::vec4{scaled(frame[axis][0]), scaled(frame[axis][1]), scaled(frame[axis][2]),
                         scaled(-all.low[axis])};
    };
    packed.row_x = row(0);
    packed.row_y = row(1);
    packed.row_z = row(2);
    for (std::size_t k = 0; k < places.size(); ++k) {
        const auto [middle, half] = packBox(boxes[k], all.low, steps);
        gpu::uvec4& pair = packed.boxes[k / 2];
        (k % 2 == 0 ? pair.x : pair.z) = middle;
        (k % 2 == 0 ? pair.y : pair.w) = half;
        packed.instances.x |= 1u << k;
    }
    return packed;
}

std::vector<CullGroupBoxes> makeCullGroups(const DeviceScene& scene, const std::vector<std::size_t>& places) {
    std::vector<CullGroupBoxes> groups;
    if (places.size() < kFewestCulled) return groups;
    for (const std::size_t place : places) {
        const bool joins = !groups.empty() && groups.back().places.size() < CULL_INSTANCES &&
                           mayShareGroup(scene.instances[groups.back().places[0]], scene.instances[place]);
        if (!joins) groups.emplace_back();
        groups.back().places.push_back(place);
    }
    for (CullGroupBoxes& group : groups) group.boxes = makeCullBoxes(scene, group.places);
    return groups;
}

std::uint32_t cullProgramSize(std::size_t count) { return count <= kFewBoxes ? kFewBoxes : CULL_INSTANCES; }

std::vector<std::uint32_t> cullProgramSizes(const DeviceScene& scene) {
    if (scene.tile_cache_bytes > 0) return {kFewBoxes, CULL_INSTANCES};
    std::vector<std::uint32_t> sizes;
    for (const CullGroupBoxes& each : makeCullGroups(scene, placesApart(scene, makePooledGroups(scene))))
        sizes.push_back(cullProgramSize(each.places.size()));
    return sizes;
}

} // namespace pointrt
