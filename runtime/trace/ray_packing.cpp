// SPDX-License-Identifier: Apache-2.0
#include "runtime/trace/ray_packing.h"

#include <algorithm>
#include <cmath>

#include "format/base/error.h"

namespace pointrt {
namespace {

/// A stretch of a ray, in lengths of its direction.
struct Stretch {
    double from = 0, to = 0; ///< empty where from is above to
};

/// What of the stretch is between two planes. Where the ray runs along them it is all or nothing; in one of them 0 *
/// inf is no number, and min and max, with their arguments in this order, pass it over.
void cut(Stretch& stretch, double origin, double direction, double low, double high) {
    const double inverse = 1 / direction, a = (low - origin) * inverse, b = (high - origin) * inverse;
    stretch.from = std::max(stretch.from, std::min(a, b));
    stretch.to = std::min(stretch.to, std::max(a, b));
}

bool isFinite(Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

constexpr gpu::CastRay kMeetsNothing{{0, 0, 0}, -1, {0, 0, 1}, 0};

/// Packs rays that are some, with directions whose squares are numbers.
struct Packer {
    const RayFrame& frame;
    RayLimits limits;
    double units = 1 / frame.space.scale; ///< render units in a world unit

    gpu::CastRay packed(Vec3 world_origin, Vec3 world_direction, double squared_length, RayStart& start) const {
        const Vec3 origin = units * (world_origin - frame.space.origin), direction = units * world_direction;
        Stretch stretch{limits.t_min, limits.t_max};
        cut(stretch, origin.x, direction.x, frame.low.x, frame.high.x);
        cut(stretch, origin.y, direction.y, frame.low.y, frame.high.y);
        cut(stretch, origin.z, direction.z, frame.low.z, frame.high.z);
        if (!(stretch.from <= stretch.to)) return kMeetsNothing;
        const double world_length = std::sqrt(squared_length), inverse = 1 / world_length;
        start = {stretch.from, frame.space.scale * inverse};
        const gpu::vec4 from = pack(origin + stretch.from * direction), along = pack(inverse * world_direction);
        const double reach = (limits.t_max - stretch.from) * (world_length * units);
        return {{from.x, from.y, from.z},
                static_cast<float>(std::min<double>(reach, CAST_FARTHEST)),
                {along.x, along.y, along.z},
                0};
    }
};

/// Of a ray that is out of the common: a wrong one, or one with a very short or very long direction, which is taken in
/// other lengths.
gpu::CastRay packedOdd(const RayFrame& frame, const RayRow& ray, std::size_t number, const RayLimits& limits,
                       RayStart& start) {
    if (!isFinite(ray.origin)) throw RayError(number, "the origin is not finite");
    if (!isFinite(ray.direction)) throw RayError(number, "the direction is not finite");
    const Vec3 sizes = absolute(ray.direction);
    const double size = std::max({sizes.x, sizes.y, sizes.z});
    if (size == 0) throw RayError(number, "the direction is 0");
    const Vec3 direction{ray.direction.x / size, ray.direction.y / size, ray.direction.z / size};
    const RayLimits in_sizes{limits.t_min * size, limits.t_max * size};
    const gpu::CastRay packed = Packer{frame, in_sizes}.packed(ray.origin, direction, dot(direction, direction), start);
    start = {start.t / size, start.per_unit / size};
    return packed;
}

template <typename Number>
void packAll(const RayFrame& frame, const RayRows& rays, const Number* numbers, const RayLimits& limits,
             std::size_t first, std::span<gpu::CastRay> rows, std::span<RayStart> starts) {
    const Packer packer{frame, limits};
    const Number* six = numbers + 6 * first;
    for (std::size_t i = 0; i < rows.size(); ++i, six += 6) {
        const Vec3 origin{six[0], six[1], six[2]}, direction{six[3], six[4], six[5]};
        const double squared = dot(direction, direction), sum = origin.x + origin.y + origin.z;
        rows[i] = std::isnormal(squared) && std::isfinite(sum)
                      ? packer.packed(origin, direction, squared, starts[i])
                      : packedOdd(frame, rowAt(rays, first + i), first + i, limits, starts[i]);
    }
}

} // namespace

RayRow rowAt(const RayRows& rays, std::size_t number) {
    const auto row = [&](const auto* six) { return RayRow{{six[0], six[1], six[2]}, {six[3], six[4], six[5]}}; };
    return rays.doubles ? row(rays.doubles + 6 * number) : row(rays.floats + 6 * number);
}

void requireLimits(const RayLimits& limits) {
    if (!(limits.t_min >= 0 && limits.t_min <= limits.t_max && std::isfinite(limits.t_min)))
        throw Error(ExitCode::kBadUsage, "t_min must be 0 or more and finite, and t_max no less");
}

void packRays(const RayFrame& frame, const RayRows& rays, const RayLimits& limits, std::size_t first,
              std::span<gpu::CastRay> rows, std::span<RayStart> starts) {
    if (rays.doubles)
        packAll(frame, rays, rays.doubles, limits, first, rows, starts);
    else
        packAll(frame, rays, rays.floats, limits, first, rows, starts);
}

} // namespace pointrt
