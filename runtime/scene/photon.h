// SPDX-License-Identifier: Apache-2.0
// Photons that leave a light towards what mirrors or refracts them: drawn by the light's row, in render units.
#pragma once

#include <array>
#include <cstdint>

#include "runtime/util/vec.h"

namespace pointrt {

/// Something that throws caustics, in a sphere around it; render units.
struct PhotonTarget {
    Vec3 center;
    double radius = 0;
    std::uint32_t code = 0; ///< as shaders/shade/photon.comp.glsl compares it: owner, and a shape's number above it
};

/// Around everything; photons of suns start outside of it.
struct RenderSphere {
    Vec3 center;
    double radius = 0;
};

/// Where photons are sent, and four numbers in [0, 1) that tell each from the others.
struct PhotonAim {
    const PhotonTarget& target;
    RenderSphere scene;
    std::array<double, 4> u;
};

/// A photon before it is weighed: flux as a share of the light's power row, for one photon of one.
struct EmittedPhoton {
    Vec3 origin, direction;
    double share = 0;
};

/// Vectors at right angles to the unit vector n and to each other.
struct Frame {
    Vec3 s, t, n;
    explicit Frame(Vec3 axis);
    /// The direction at this cosine from n, turned by turn (of 1).
    Vec3 at(double cosine, double turn) const;
};

/// The directions from a point into the target's sphere: all of them from inside.
struct Cone {
    Vec3 axis;
    double cap = 2; ///< 1 minus the cosine of its half angle
};
Cone coneTo(const PhotonTarget& target, Vec3 from);

/// Evenly in the cone's solid angle.
EmittedPhoton photonWithin(const Cone& cone, Vec3 origin, double u, double v);

/// Photons start a little off a lamp's surface, which is a shape: a share of its size.
constexpr double kPhotonLift = 1e-4;

/// From a point of a lamp's surface with a unit normal and the area that it stands for, by the first two of aim.u.
EmittedPhoton photonFromSurface(Vec3 origin, Vec3 normal, double area, bool both_sides, const PhotonAim& aim);
/// The same of flat lamps, which shine on both sides, lifted off them.
EmittedPhoton photonFromFlat(Vec3 origin, Vec3 normal, double area, const PhotonAim& aim);

} // namespace pointrt
