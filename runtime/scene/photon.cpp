// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/photon.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pointrt {

using std::numbers::pi;

Frame::Frame(Vec3 axis) : n(axis) {
    s = normalize(cross(std::abs(n.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, n));
    t = cross(n, s);
}

Vec3 Frame::at(double cosine, double turn) const {
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine)), angle = 2 * pi * turn;
    return normalize(cosine * n + sine * std::cos(angle) * s + sine * std::sin(angle) * t);
}

Cone coneTo(const PhotonTarget& target, Vec3 from) {
    const Vec3 way = target.center - from;
    const double squared = dot(way, way), squared_sine = target.radius * target.radius / std::max(squared, 1e-300);
    if (squared_sine >= 1) return {{0, 0, 1}, 2};
    return {normalize(way), squared_sine / (1 + std::sqrt(1 - squared_sine))};
}

EmittedPhoton photonWithin(const Cone& cone, Vec3 origin, double u, double v) {
    return {origin, Frame(cone.axis).at(1 - cone.cap * u, v), 2 * pi * cone.cap};
}

EmittedPhoton photonFromSurface(Vec3 origin, Vec3 normal, double area, bool both_sides, const PhotonAim& aim) {
    EmittedPhoton photon = photonWithin(coneTo(aim.target, origin), origin, aim.u[0], aim.u[1]);
    const double cosine = dot(photon.direction, normal);
    photon.share *= area * (both_sides ? std::abs(cosine) : std::max(cosine, 0.0));
    return photon;
}

EmittedPhoton photonFromFlat(Vec3 origin, Vec3 normal, double area, const PhotonAim& aim) {
    EmittedPhoton photon = photonFromSurface(origin, normal, area, true, aim);
    const double lift = kPhotonLift * std::sqrt(area);
    photon.origin = photon.origin + std::copysign(lift, dot(photon.direction, normal)) * normal;
    return photon;
}

} // namespace pointrt
