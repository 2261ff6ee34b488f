// SPDX-License-Identifier: Apache-2.0
// Types and helpers that the kinds of light share.
#pragma once

#include <cmath>
#include <cstdint>

#include "runtime/util/degree.h"
#include "runtime/util/vec.h"
#include "shaders/shared/scene_layout.h"

namespace pointrt {

struct LightNames {
    const char* type;   ///< in scene files
    const char* called; ///< in messages, with its article
    const char* label;  ///< in the window
    const char* hint;   ///< next to the label
};

/// The surface of a lamp: the unit form of a shape, at center + x * u + y * v + z * w.
struct LampSurface {
    std::uint32_t shape; ///< SHAPE_*
    Vec3 center, u, v, w;
    bool seen_by_camera = true;
};
/// For lights without a surface.
struct NoSurface {};

/// Where to place a light that is added to a scene.
struct LightPlace {
    Vec3 position, ahead; ///< ahead: unit vector to the centre of the scene
    Vec3 up;              ///< unit length
    double scene_radius = 1;
    double distance = 2; ///< from the centre of the scene
};
/// In scene radii: like a window or a softbox next to a person.
constexpr double kLampRadius = 0.2, kPanelHalfEdge = 0.4;

inline double cosineOf(double degrees) { return std::cos(degrees * kDegree); }

/// Any unit vector perpendicular to v.
inline Vec3 across(Vec3 v) {
    return normalize(std::abs(v.x) < 0.7 ? cross(v, Vec3{1, 0, 0}) : cross(v, Vec3{0, 1, 0}));
}

} // namespace pointrt
