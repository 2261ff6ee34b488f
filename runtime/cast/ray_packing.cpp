// SPDX-License-Identifier: Apache-2.0
#include "runtime/cast/ray_packing.h"

#include <algorithm>
#include <cmath>

#include "format/base/error.h"
#include "runtime/cast/ray_interval.h"

namespace pointrt {
namespace {

bool isFinite(Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

Vec3 inverseOf(Vec3 v) { return {1 / v.x, 1 / v.y, 1 / v.z}; }

constexpr gpu::CastRay kMissesAll{{0, 0, 0}, -1, {0, 0, 1}, 0};

/// Packs valid rays whose squared direction length is a normal number (std::isnormal).
struct Packer {
    const RayFrame& frame;
    RayLimits limits;
    double units = 1 / frame.space.scale; ///< render units per world unit

    gpu::CastRay packed(Vec3 world_origin, Vec3 world_direction, double squared_length, RayStart& start) const {
        const Vec3 origin = units * (world_origin - frame.space.origin), direction = units * world_direction;
        const RayInterval interval =
            clipToBox({limits.t_min, limits.t_max}, origin, inverseOf(direction), frame.low, frame.high);
        if (interval.isEmpty()) return kMissesAll;
        const double world_length = std::sqrt(squared_length), inverse = 1 / world_length;
        start = {interval.from, frame.space.scale * inverse};
        const gpu::vec4 from = pack(origin + interval.from * direction), along = pack(inverse * world_direction);
        const double reach = (limits.t_max - interval.from) * (world_length * units);
        return {{from.x, from.y, from.z},
                static_cast<float>(std::min<double>(reach, CAST_FARTHEST)),
                {along.x, along.y, along.z},
                0};
    }
};

/// Whether the fast path applies. Otherwise the ray is invalid, or its direction is very short or very long.
bool isCommon(double squared_length, Vec3 origin) {
    return std::isnormal(squared_length) && std::isfinite(origin.x + origin.y + origin.z);
}

/// For rays that isCommon rejects.
ScaledRay scaledOdd(const RayRow& ray, std::size_t number) {
    if (!isFinite(ray.origin)) throw RayError(number, "the origin is not finite");
    if (!isFinite(ray.direction)) throw RayError(number, "the direction is not finite");
    const Vec3 sizes = absolute(ray.direction);
    const double size = std::max({sizes.x, sizes.y, sizes.z});
    if (size == 0) throw RayError(number, "the direction is 0");
    return {ray.origin, {ray.direction.x / size, ray.direction.y / size, ray.direction.z / size}, size};
}

gpu::CastRay packedOdd(const RayFrame& frame, const ScaledRay& ray, const RayLimits& limits, RayStart& start) {
    const gpu::CastRay packed = packRay(frame, ray, {limits.t_min * ray.size, limits.t_max * ray.size}, start);
    start = {start.t / ray.size, start.per_unit / ray.size};
    return packed;
}

template <typename Number>
void packAll(const RayFrame& frame, const Number* numbers, const RayLimits& limits, std::size_t first,
             std::span<gpu::CastRay> rows, std::span<RayStart> starts) {
    const Packer packer{frame, limits};
    const Number* six = numbers + 6 * first;
    for (std::size_t i = 0; i < rows.size(); ++i, six += 6) {
        const Vec3 origin{six[0], six[1], six[2]}, direction{six[3], six[4], six[5]};
        const double squared = dot(direction, direction);
        rows[i] = isCommon(squared, origin)
                      ? packer.packed(origin, direction, squared, starts[i])
                      : packedOdd(frame, scaledOdd({origin, direction}, first + i), limits, starts[i]);
    }
}

} // namespace

RayRow rowAt(const RayRows& rays, std::size_t number) {
    const auto row = [&](const auto* six) { return RayRow{{six[0], six[1], six[2]}, {six[3], six[4], six[5]}}; };
    return rays.doubles ? row(rays.doubles + 6 * number) : row(rays.floats + 6 * number);
}

ScaledRay scaledRay(const RayRows& rays, std::size_t number) {
    const RayRow row = rowAt(rays, number);
    if (isCommon(dot(row.direction, row.direction), row.origin)) return {row.origin, row.direction, 1};
    return scaledOdd(row, number);
}

void requireLimits(const RayLimits& limits) {
    if (!(limits.t_min >= 0 && limits.t_min <= limits.t_max && std::isfinite(limits.t_min)))
        throw Error(ExitCode::kBadUsage, "t_min must be finite and at least 0, and t_max at least t_min");
}

void packRays(const RayFrame& frame, const RayRows& rays, const RayLimits& limits, std::size_t first,
              std::span<gpu::CastRay> rows, std::span<RayStart> starts) {
    if (rays.doubles)
        packAll(frame, rays.doubles, limits, first, rows, starts);
    else
        packAll(frame, rays.floats, limits, first, rows, starts);
}

gpu::CastRay packRay(const RayFrame& frame, const ScaledRay& ray, const RayLimits& limits, RayStart& start) {
    return Packer{frame, limits}.packed(ray.origin, ray.direction, dot(ray.direction, ray.direction), start);
}

} // namespace pointrt
