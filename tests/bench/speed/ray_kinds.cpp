// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/speed/ray_kinds.h"

#include <numbers>
#include <random>

namespace pointrt::test {

namespace {

Vec3 roundToFloat(Vec3 v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

/// By a uniform point of the sphere around the tip of the normal (Shirley et al., Ray Tracing in One Weekend, 2016).
Vec3 cosineDirection(Vec3 normal, std::mt19937_64& engine) {
    const auto unit = [&] { return static_cast<double>(engine() >> 11) * 0x1p-53; }; // 53 bits: all of a double
    const double z = 1 - 2 * unit(), ring = std::sqrt(1 - z * z), angle = 2 * std::numbers::pi * unit();
    const Vec3 sum = normal + Vec3{ring * std::cos(angle), ring * std::sin(angle), z};
    return length(sum) > 0 ? normalize(sum) : normal;
}

} // namespace

const char* nameOf(RayKind kind) {
    switch (kind) {
    case RayKind::kPrimary:
        return "primary";
    case RayKind::kShadow:
        return "shadow";
    case RayKind::kMirror:
        return "mirror";
    case RayKind::kDiffuse:
        return "diffuse";
    }
    return "";
}

std::vector<Ray> raysOf(RayKind kind, std::span<const Ray> primary, std::span<const CastHit> hits, Vec3 light,
                        std::uint64_t seed) {
    if (kind == RayKind::kPrimary) return {primary.begin(), primary.end()};
    std::mt19937_64 engine(seed);
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < primary.size(); ++i) {
        if (!hits[i].hit()) continue;
        const Vec3 normal = hits[i].normal, view = primary[i].direction;
        const Vec3 surface = primary[i].origin + hits[i].t_blended * view;
        const Vec3 origin = surface + kLiftRadii * hits[i].radius * normal;
        Vec3 direction;
        if (kind == RayKind::kShadow) direction = normalize(light - origin);
        if (kind == RayKind::kMirror) direction = normalize(view - 2 * dot(view, normal) * normal);
        if (kind == RayKind::kDiffuse) direction = cosineDirection(normal, engine);
        if (kind == RayKind::kShadow && !(dot(direction, normal) > 0)) continue;
        rays.push_back({roundToFloat(origin), roundToFloat(direction), {}, 0});
    }
    return rays;
}

} // namespace pointrt::test
