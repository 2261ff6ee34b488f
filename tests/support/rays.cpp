// SPDX-License-Identifier: Apache-2.0
#include "tests/support/rays.h"

#include <algorithm>
#include <numbers>
#include <random>

namespace pointrt::test {

namespace {

constexpr double kFullTurn = 2 * std::numbers::pi;
constexpr double kGrazingMax = 10 * std::numbers::pi / 180;

/// Own distributions, because those of the standard library differ between implementations; engines do not.
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    /// Uniform in [0, 1), 53 bits.
    double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    std::size_t below(std::size_t count) { return static_cast<std::size_t>(unit() * static_cast<double>(count)); }

private:
    std::mt19937_64 engine_;
};

Vec3 roundToFloat(Vec3 v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

/// Unit vectors that form an orthonormal frame with unit n.
struct Tangents {
    Vec3 u, v;
};
Tangents tangentsOf(Vec3 n) {
    const Vec3 helper = std::abs(n.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 u = normalize(cross(n, helper));
    return {u, cross(n, u)};
}

Vec3 around(const Tangents& frame, double angle) { return std::cos(angle) * frame.u + std::sin(angle) * frame.v; }

/// Uniform on the unit disc spanned by frame: the radius is the square root of a uniform number.
Vec3 pointOnDisc(const Tangents& frame, Random& random) {
    const double radius = std::sqrt(random.unit());
    return radius * around(frame, kFullTurn * random.unit());
}

Vec3 pointOnUnitSphere(Random& random) {
    const double z = 1 - 2 * random.unit(), ring = std::sqrt(1 - z * z), angle = kFullTurn * random.unit();
    return {ring * std::cos(angle), ring * std::sin(angle), z};
}

/// The line through a point inside the sphere, starting a hundredth of a radius before it enters.
Ray startOutside(const Sphere& sphere, Vec3 through, Vec3 direction) {
    const Vec3 offset = through - sphere.center;
    const double along = dot(offset, direction);
    const double half_chord_squared = sphere.radius * sphere.radius - (dot(offset, offset) - along * along);
    const double back = along + std::sqrt(std::max(half_chord_squared, 0.0)) + 0.01 * sphere.radius;
    return {roundToFloat(through - back * direction), roundToFloat(direction), {}, 0};
}

} // namespace

std::vector<Ray> randomRays(const Sphere& bounds, std::size_t count, std::uint64_t seed) {
    Random random(seed);
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) {
        const Vec3 direction = pointOnUnitSphere(random);
        const Vec3 through = bounds.center + bounds.radius * pointOnDisc(tangentsOf(direction), random);
        ray = startOutside(bounds, through, direction);
    }
    return rays;
}

std::vector<Ray> grazingRays(std::span<const CubeSplat> splats, std::size_t count, std::uint64_t seed) {
    const Sphere bounds = boundingSphere(splats);
    Random random(seed);
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) {
        const CubeSplat& splat = splats[random.below(splats.size())];
        const Tangents frame = tangentsOf(splat.normal);
        const Vec3 through = splat.center + splat.radius * pointOnDisc(frame, random);
        const double elevation = kGrazingMax * (2 * random.unit() - 1);
        const Vec3 direction =
            std::cos(elevation) * around(frame, kFullTurn * random.unit()) + std::sin(elevation) * splat.normal;
        ray = startOutside(bounds, through, direction);
    }
    return rays;
}

} // namespace pointrt::test
