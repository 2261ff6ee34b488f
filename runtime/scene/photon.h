// SPDX-License-Identifier: Apache-2.0
// Emission of photons from a light, given by its device row, towards objects that cast caustics; render units.
#pragma once

#include <array>
#include <cstdint>

#include "runtime/util/vec.h"

namespace pointrt {

/// The bounding sphere of an object that casts caustics; render units.
struct PhotonTarget {
    Vec3 center;
    double radius = 0;
    /// Identifies the target in shaders/shade/photon.comp.glsl: owner, and a shape's number in higher bits.
    std::uint32_t code = 0;
};

/// The bounding sphere of the scene; photons of suns start outside.
struct RenderSphere {
    Vec3 center;
    double radius = 0;
};

/// The target of a photon, and four random numbers in [0, 1).
struct PhotonAim {
    const PhotonTarget& target;
    RenderSphere scene;
    std::array<double, 4> u;
};

/// An emitted photon. share: its flux as the only photon, divided by the light's strength.
struct EmittedPhoton {
    Vec3 origin, direction;
    double share = 0;
};

/// An orthonormal basis around the unit vector n.
struct Frame {
    Vec3 s, t, n;
    explicit Frame(Vec3 axis);
    /// The direction at this cosine from n; turn: azimuth in turns, 0 to 1.
    Vec3 at(double cosine, double turn) const;
};

/// The cone of directions from a point to the target's sphere; all directions if the point is inside.
struct Cone {
    Vec3 axis;
    double cap = 2; ///< 1 minus the cosine of its half angle
};
Cone coneTo(const PhotonTarget& target, Vec3 from);

/// A photon with a direction uniform in the cone's solid angle; u and v in [0, 1).
EmittedPhoton photonWithin(const Cone& cone, Vec3 origin, double u, double v);

/// Photons start above the lamp's surface, which is a shape, by this share of its size.
constexpr double kPhotonLift = 1e-4;

/// A photon from a point of a lamp's surface with a unit normal. area: of the sampled surface; uses aim.u[0] and [1].
EmittedPhoton photonFromSurface(Vec3 origin, Vec3 normal, double area, bool both_sides, const PhotonAim& aim);
/// The same for flat lamps, which emit on both sides, offset from the surface.
EmittedPhoton photonFromFlat(Vec3 origin, Vec3 normal, double area, const PhotonAim& aim);

} // namespace pointrt
