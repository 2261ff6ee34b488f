// SPDX-License-Identifier: Apache-2.0
#include "runtime/trace/ray_packing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "format/base/error.h"

namespace pointrt {
namespace {

/// A stretch of a ray.
struct Stretch {
    double from = 0, to = 0; ///< empty where from is above to, or one of them is no number
};

void cut(Stretch& stretch, double origin, double direction, double low, double high) {
    if (direction == 0) {
        if (origin < low || origin > high) stretch.to = -std::numeric_limits<double>::infinity();
        return;
    }
    const double inverse = 1 / direction, a = (low - origin) * inverse, b = (high - origin) * inverse;
    stretch.from = std::max(stretch.from, std::min(a, b));
    stretch.to = std::min(stretch.to, std::max(a, b));
}

bool isInside(const RayFrame& frame, Vec3 p) {
    return p.x >= frame.low.x && p.y >= frame.low.y && p.z >= frame.low.z && p.x <= frame.high.x &&
           p.y <= frame.high.y && p.z <= frame.high.z;
}

/// Of the stretch, what runs through the box of all that can be hit. A ray that starts within needs not be moved.
Stretch inReach(const RayFrame& frame, Vec3 origin, Vec3 unit, Stretch stretch) {
    if (stretch.from == 0 && isInside(frame, origin)) return stretch;
    cut(stretch, origin.x, unit.x, frame.low.x, frame.high.x);
    cut(stretch, origin.y, unit.y, frame.low.y, frame.high.y);
    cut(stretch, origin.z, unit.z, frame.low.z, frame.high.z);
    return stretch;
}

bool isFinite(Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Squares of very short and very long directions are no numbers.
double safeLength(Vec3 v) {
    const double squared = dot(v, v);
    return std::isnormal(squared) ? std::sqrt(squared) : std::hypot(v.x, v.y, v.z);
}

/// Not by way of the inverse length, which for very short ones is none.
Vec3 unitOf(Vec3 v, double its_length) {
    const double inverse = 1 / its_length;
    if (std::isnormal(inverse)) return v * inverse;
    return {v.x / its_length, v.y / its_length, v.z / its_length};
}

void requireRay(const RayRow& ray, std::size_t number) {
    if (!isFinite(ray.origin)) throw RayError(number, "the origin is not finite");
    if (!isFinite(ray.direction)) throw RayError(number, "the direction is not finite");
    if (ray.direction == Vec3{}) throw RayError(number, "the direction is 0");
}

constexpr gpu::CastRay kMeetsNothing{{0, 0, 0}, -1, {0, 0, 1}, 0};

gpu::CastRay packed(const RayFrame& frame, const RayRow& ray, const RayLimits& limits, RayStart& start) {
    const double world_length = safeLength(ray.direction), units = world_length / frame.space.scale;
    const Vec3 origin = renderPoint(frame.space, ray.origin), unit = unitOf(ray.direction, world_length);
    const double t_max = limits.t_max * units;
    const Stretch stretch = inReach(frame, origin, unit, {limits.t_min * units, t_max});
    if (!(stretch.from <= stretch.to)) return kMeetsNothing;
    start.per_unit = 1 / units;
    start.t = stretch.from * start.per_unit;
    const gpu::vec4 from = pack(origin + stretch.from * unit), along = pack(unit);
    const double reach = std::min<double>(t_max - stretch.from, CAST_FARTHEST);
    return {{from.x, from.y, from.z}, static_cast<float>(reach), {along.x, along.y, along.z}, 0};
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
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const RayRow ray = rowAt(rays, first + i);
        requireRay(ray, first + i);
        rows[i] = packed(frame, ray, limits, starts[i]);
    }
}

} // namespace pointrt
