// SPDX-License-Identifier: Apache-2.0
#include "runtime/trace/hit_unpacking.h"

#include <algorithm>
#include <limits>
#include <string>

#include "format/base/error.h"
#include "pointrt/pro.h"
#include "shaders/shared/params.h"

namespace pointrt {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity(), kNaN = std::numeric_limits<double>::quiet_NaN();

bool isHit(const gpu::CastHit& hit) { return hit.splat != NO_INDEX; }

void requireSize(std::size_t size, std::size_t wanted, const char* name) {
    if (size != 0 && size != wanted)
        throw Error(ExitCode::kBadUsage, std::string(name) + " has " + std::to_string(size) + " numbers, and " +
                                             std::to_string(wanted) + " are needed");
}

/// Which disc is nearest was told by cell discs, which are rounded: the exact one may lie beyond a limit by that.
double hitDistance(const gpu::CastHit& hit, const RayStart& start, const RayLimits& limits) {
    return std::clamp(start.t + start.per_unit * static_cast<double>(hit.t), limits.t_min, limits.t_max);
}

Vec3 normalTowards(std::uint32_t word, Vec3 direction) {
    const std::uint32_t words[PRO_SPLAT_WORDS] = {0, 0, word, 0};
    pro_splat splat;
    pro_splat_decode(words, 1, 1, &splat); // but for the normal it means nothing
    const Vec3 normal{splat.normal[0], splat.normal[1], splat.normal[2]};
    return dot(normal, direction) > 0 ? -1.0 * normal : normal;
}

template <typename Number>
void put(std::span<Number> array, std::size_t row, Vec3 v) {
    array[3 * row] = static_cast<Number>(v.x);
    array[3 * row + 1] = static_cast<Number>(v.y);
    array[3 * row + 2] = static_cast<Number>(v.z);
}

} // namespace

void requireSizes(const HitArrays& arrays, std::size_t count) {
    requireSize(arrays.t_hit.size(), count, "t_hit");
    requireSize(arrays.splat_ids.size(), count, "splat_ids");
    requireSize(arrays.instance_ids.size(), count, "instance_ids");
    requireSize(arrays.normals.size(), 3 * count, "normals");
    requireSize(arrays.positions.size(), 3 * count, "positions");
}

void unpackHits(const FoundHits& found, const RayRows& rays, const RayLimits& limits, const HitArrays& arrays) {
    const bool asks_space = !arrays.normals.empty() || !arrays.positions.empty();
    for (std::size_t i = 0; i < found.hits.size(); ++i) {
        const gpu::CastHit& hit = found.hits[i];
        const std::size_t row = found.first + i;
        const bool is_hit = isHit(hit);
        const double t = is_hit ? hitDistance(hit, found.starts[i], limits) : kInfinity;
        if (!arrays.t_hit.empty()) arrays.t_hit[row] = t;
        if (!arrays.splat_ids.empty()) arrays.splat_ids[row] = is_hit ? hit.splat : kNoHit;
        if (!arrays.instance_ids.empty()) arrays.instance_ids[row] = is_hit ? found.instances[hit.place] : kNoHit;
        if (!asks_space) continue;
        const RayRow ray = rowAt(rays, row);
        if (!arrays.normals.empty())
            put(arrays.normals, row, is_hit ? normalTowards(hit.normal, ray.direction) : Vec3{});
        if (!arrays.positions.empty())
            put(arrays.positions, row, is_hit ? ray.origin + t * ray.direction : Vec3{kNaN, kNaN, kNaN});
    }
}

} // namespace pointrt
