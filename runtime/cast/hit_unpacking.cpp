// SPDX-License-Identifier: Apache-2.0
#include "runtime/cast/hit_unpacking.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "format/base/error.h"
#include "pointrt/pro.h"
#include "runtime/cast/ray_interval.h"
#include "runtime/cast/shape_hit.h"
#include "shaders/shared/params.h"

namespace pointrt {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

void requireSize(std::size_t size, std::size_t wanted, const char* name) {
    if (size != 0 && size != wanted)
        throw Error(ExitCode::kBadUsage, std::string(name) + ": expected " + std::to_string(wanted) + " numbers, got " +
                                             std::to_string(size));
}

Vec3 turnedTowards(Vec3 normal, Vec3 direction) { return dot(normal, direction) > 0 ? -1.0 * normal : normal; }

Vec3 splatNormal(std::uint32_t word) {
    const std::uint32_t words[PRO_SPLAT_WORDS] = {0, 0, word, 0};
    pro_splat splat;
    pro_splat_decode(words, 1, 1, &splat); // only the normal is valid
    return {splat.normal[0], splat.normal[1], splat.normal[2]};
}

template <typename Number>
void put(std::span<Number> array, std::size_t row, Vec3 v) {
    array[3 * row] = static_cast<Number>(v.x);
    array[3 * row + 1] = static_cast<Number>(v.y);
    array[3 * row + 2] = static_cast<Number>(v.z);
}

/// The normal in the world.
Vec3 placedNormal(const Placement& placement, Vec3 normal) {
    const std::array<Vec3, 3>& rotation = placement.rotation;
    return {dot(rotation[0], normal), dot(rotation[1], normal), dot(rotation[2], normal)};
}

Vec3 normalAt(const InstanceList& list, const RayHit& hit, Vec3 position) {
    if (hit.instance == kShape) return shapeNormal(list.shapes[hit.splat], position);
    return placedNormal(list.instances[hit.instance].placement, splatNormal(hit.normal));
}

void putIds(const InstanceList& list, std::size_t row, const RayHit& hit, const HitArrays& arrays) {
    const bool is_splat = hit.instance < list.instances.size();
    const std::uint32_t elsewhere = hit.instance == kShape ? kShapesInstance : kNoHit;
    if (!arrays.splat_ids.empty()) arrays.splat_ids[row] = is_splat ? hit.splat : kNoHit;
    if (!arrays.instance_ids.empty())
        arrays.instance_ids[row] = is_splat ? list.instances[hit.instance].scene_instance : elsewhere;
    if (!arrays.tile_ids.empty()) arrays.tile_ids[row] = is_splat ? list.instances[hit.instance].tile : kNoHit;
}

} // namespace

void requireSizes(const HitArrays& arrays, std::size_t count) {
    requireSize(arrays.t_hit.size(), count, "t_hit");
    requireSize(arrays.splat_ids.size(), count, "splat_ids");
    requireSize(arrays.instance_ids.size(), count, "instance_ids");
    requireSize(arrays.normals.size(), 3 * count, "normals");
    requireSize(arrays.positions.size(), 3 * count, "positions");
    requireSize(arrays.tile_ids.size(), count, "tile_ids");
}

/// The device finds the nearest disc among the quantised discs of cells; the exact disc may be hit slightly beyond a
/// limit.
RayHit hitOf(const gpu::CastHit& found, std::uint32_t instance, const RayStart& start, const RayLimits& limits,
             const RayHit& otherwise) {
    if (found.splat == NO_INDEX) return otherwise;
    const double t = std::clamp(start.t + start.per_unit * static_cast<double>(found.t), limits.t_min, limits.t_max);
    return {t, instance, found.splat, found.normal};
}

void putHit(const InstanceList& list, const RayRows& rays, std::size_t row, const RayHit& hit,
            const HitArrays& arrays) {
    if (!arrays.t_hit.empty()) arrays.t_hit[row] = hit.instance != kNothing ? hit.t : kInfinity;
    putIds(list, row, hit, arrays);
    if (!arrays.normals.empty() || !arrays.positions.empty()) putVectors(list, rays, row, hit, arrays);
}

void putVectors(const InstanceList& list, const RayRows& rays, std::size_t row, const RayHit& hit,
                const HitArrays& arrays) {
    const bool is_hit = hit.instance != kNothing;
    const RayRow ray = rowAt(rays, row);
    const Vec3 position = is_hit ? ray.origin + hit.t * ray.direction : Vec3{kNaN, kNaN, kNaN};
    if (!arrays.positions.empty()) put(arrays.positions, row, position);
    if (!arrays.normals.empty())
        put(arrays.normals, row, is_hit ? turnedTowards(normalAt(list, hit, position), ray.direction) : Vec3{});
}

} // namespace pointrt
