// SPDX-License-Identifier: Apache-2.0
#include "runtime/tracer/photon_emission.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

namespace pointrt {

namespace {

using std::numbers::pi;

Vec3 vec(const gpu::vec4& v) { return {v.x, v.y, v.z}; }

/// Vectors at right angles to the unit vector n and to each other.
struct Frame {
    Vec3 s, t, n;
    explicit Frame(Vec3 axis) : n(axis) {
        s = normalize(cross(std::abs(n.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, n));
        t = cross(n, s);
    }
    /// The direction at this cosine from n, turned by turn (of 1).
    Vec3 at(double cosine, double turn) const {
        const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine)), angle = 2 * pi * turn;
        return normalize(cosine * n + sine * std::cos(angle) * s + sine * std::sin(angle) * t);
    }
};

/// R4 sequence: steps by powers of the root of x^5 = x + 1 (Roberts, The Unreasonable Effectiveness of Quasirandom
/// Sequences, 2018).
std::array<double, 4> quasiRandom(std::uint64_t i) {
    constexpr double kRoot = 1.1673039782614187;
    std::array<double, 4> u{};
    double step = 1;
    for (double& value : u) {
        step /= kRoot;
        value = std::fmod(0.5 + step * static_cast<double>(i + 1), 1.0);
    }
    return u;
}

/// The directions from a point into the target's sphere: all of them from inside.
struct Cone {
    Vec3 axis;
    double cap = 2; ///< 1 minus the cosine of its half angle
    double solidAngle() const { return 2 * pi * cap; }
};

Cone coneTo(const PhotonTarget& target, Vec3 from) {
    const Vec3 way = target.center - from;
    const double squared = dot(way, way), squared_sine = target.radius * target.radius / std::max(squared, 1e-300);
    if (squared_sine >= 1) return {{0, 0, 1}, 2};
    return {normalize(way), squared_sine / (1 + std::sqrt(1 - squared_sine))};
}

/// A photon before it is weighed: flux as a share of the light's power row, for one photon of one.
struct Emitted {
    Vec3 origin, direction;
    double share = 0;
};

Emitted within(const Cone& cone, Vec3 origin, double u, double v) {
    return {origin, Frame(cone.axis).at(1 - cone.cap * u, v), cone.solidAngle()};
}

Emitted fromPoint(const gpu::Light& light, const PhotonTarget& target, const std::array<double, 4>& u) {
    const Vec3 origin = vec(light.position);
    return within(coneTo(target, origin), origin, u[0], u[1]);
}

Emitted fromSpot(const gpu::Light& light, const PhotonTarget& target, const std::array<double, 4>& u) {
    const Vec3 origin = vec(light.position), axis = vec(light.axis);
    const Cone lit{axis, 1 - double{light.axis.w}}, wanted = coneTo(target, origin);
    // either cone may be a small part of the other
    Emitted photon = within(lit.cap < wanted.cap ? lit : wanted, origin, u[0], u[1]);
    if (1 - dot(photon.direction, wanted.axis) > wanted.cap * (1 + 1e-9)) photon.share = 0;
    // dimmed as shaders/light/lights.glsl does
    const double inside = dot(photon.direction, axis) - double{light.axis.w};
    const double x = std::clamp(inside / std::max(double{light.edge_u.x} - double{light.axis.w}, 1e-7), 0.0, 1.0);
    photon.share *= x * x * (3 - 2 * x);
    return photon;
}

/// From a point of a lamp's surface with a unit normal and the area that it stands for.
Emitted fromSurface(Vec3 origin, Vec3 normal, double area, bool both_sides, const PhotonTarget& target, double u,
                    double v) {
    Emitted photon = within(coneTo(target, origin), origin, u, v);
    const double cosine = dot(photon.direction, normal);
    photon.share *= area * (both_sides ? std::abs(cosine) : std::max(cosine, 0.0));
    return photon;
}

Emitted fromSphere(const gpu::Light& light, const PhotonTarget& target, const std::array<double, 4>& u) {
    const double radius = light.axis.w;
    const Vec3 way = target.center - vec(light.position);
    const double distance = std::max(length(way), 1e-300);
    // the cap of the lamp whose points have some of the target over their horizon
    const double cap = 1 - std::clamp((radius - target.radius) / distance, -1.0, 1.0);
    const Vec3 normal = Frame(distance > 1e-300 ? normalize(way) : Vec3{0, 0, 1}).at(1 - cap * u[2], u[3]);
    // a little outside: the lamp is a shape
    constexpr double kOutside = 1 + 1e-4;
    return fromSurface(vec(light.position) + radius * kOutside * normal, normal, 2 * pi * cap * radius * radius, false,
                       target, u[0], u[1]);
}

Emitted fromQuad(const gpu::Light& light, const PhotonTarget& target, const std::array<double, 4>& u) {
    const Vec3 half_u = vec(light.edge_u), half_v = vec(light.edge_v), normal = vec(light.axis);
    const double area = 4 * length(half_u) * length(half_v);
    const Vec3 on_lamp = vec(light.position) + (2 * u[2] - 1) * half_u + (2 * u[3] - 1) * half_v;
    Emitted photon = fromSurface(on_lamp, normal, area, true, target, u[0], u[1]);
    const double lift = 1e-4 * std::sqrt(area);
    photon.origin = photon.origin + std::copysign(lift, dot(photon.direction, normal)) * normal;
    return photon;
}

/// From a disc as wide as the target, outside of the scene, in the direction of a point of the sun.
Emitted fromSun(const gpu::Light& light, const PhotonTarget& target, RenderSphere scene,
                const std::array<double, 4>& u) {
    const double cap = 1 - double{light.axis.w};
    const Vec3 towards = Frame(vec(light.axis)).at(1 - cap * u[2], u[3]);
    const Frame across(towards);
    const double ring = target.radius * std::sqrt(u[0]), angle = 2 * pi * u[1];
    const double distance = length(target.center - scene.center) + 1.01 * scene.radius;
    const Vec3 origin =
        target.center + distance * towards + ring * std::cos(angle) * across.s + ring * std::sin(angle) * across.t;
    // points at the rim of a wide sun shine on its middle's plane askew (shaders/light/lights.glsl)
    return {origin, -1.0 * towards, pi * target.radius * target.radius * 2 / (2 - cap)};
}

Emitted emit(const gpu::Light& light, const PhotonTarget& target, RenderSphere scene, const std::array<double, 4>& u) {
    if (light.position.w == LIGHT_SPHERE) return fromSphere(light, target, u);
    if (light.position.w == LIGHT_QUAD) return fromQuad(light, target, u);
    if (light.position.w == LIGHT_SUN) return fromSun(light, target, scene, u);
    if (light.position.w == LIGHT_SPOT) return fromSpot(light, target, u);
    if (light.position.w == LIGHT_SKY) return {};
    return fromPoint(light, target, u);
}

double brightness(const gpu::Light& light) { return (light.power.x + light.power.y + light.power.z) / 3.0; }

/// Photons that find out how much light a pair carries.
constexpr std::uint32_t kTrialPhotons = 256;

double pairFlux(const gpu::Light& light, const PhotonTarget& target, RenderSphere scene) {
    double sum = 0;
    for (std::uint32_t i = 0; i < kTrialPhotons; ++i) sum += emit(light, target, scene, quasiRandom(i)).share;
    return sum / kTrialPhotons * brightness(light);
}

gpu::PathState pathOf(const Emitted& photon, const gpu::Light& light, double scale, std::uint32_t code) {
    const auto pack = [](Vec3 v) {
        return gpu::vec3{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
    };
    gpu::PathState path{};
    path.origin = pack(photon.origin);
    path.direction = pack(photon.direction);
    path.throughput = pack(photon.share * scale * vec(light.power));
    path.target = code;
    path.bits = NO_OWNER << PATH_OWNER_SHIFT;
    return path;
}

} // namespace

std::vector<gpu::PathState> emitPhotons(std::span<const gpu::Light> lights, std::span<const PhotonTarget> targets,
                                        RenderSphere scene, std::uint32_t count) {
    std::vector<double> fluxes;
    for (const gpu::Light& light : lights)
        for (const PhotonTarget& target : targets) fluxes.push_back(pairFlux(light, target, scene));
    double total = 0;
    for (const double flux : fluxes) total += flux;
    std::vector<gpu::PathState> paths;
    if (!(total > 0)) return paths;
    std::size_t pair = 0;
    std::uint64_t first = 0; // pairs go on in one sequence, so that they are not alike
    for (const gpu::Light& light : lights)
        for (const PhotonTarget& target : targets) {
            const auto share = static_cast<std::uint64_t>(std::ceil(count * (fluxes[pair++] / total)));
            for (std::uint64_t i = 0; i < share; ++i) {
                const Emitted photon = emit(light, target, scene, quasiRandom(first + i));
                if (photon.share > 0)
                    paths.push_back(pathOf(photon, light, 1.0 / static_cast<double>(share), target.code));
            }
            first += share;
        }
    return paths;
}

} // namespace pointrt
