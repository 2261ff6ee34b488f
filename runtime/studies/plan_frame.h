// SPDX-License-Identifier: Apache-2.0
// Coordinates in a plan, and the vertical rays from above or below the scene.
#pragma once

#include "pointrt/measure.hpp"
#include "runtime/util/vec.h"

namespace pointrt {

/// East, north and up: x, y, z if up is +Z. Relative to an origin, so that plans of national grids keep their
/// precision.
struct PlanFrame {
    Vec3 origin, east, north, up;

    /// x east, y north, z up of a point.
    Vec3 planOf(Vec3 point) const {
        const Vec3 d = point - origin;
        return {dot(d, east), dot(d, north), dot(d, up)};
    }
    Vec3 pointAt(Vec3 plan) const { return origin + plan.x * east + plan.y * north + plan.z * up; }
};

/// Throws TraceError kBadUsage unless up is finite and of unit length to 1e-6.
PlanFrame planFrame(Vec3 origin, const Position& up);

/// The lowest and the highest x, y and z of the scene's bounds in a plan.
struct PlanBounds {
    Vec3 low, high;
};
PlanBounds planBounds(const TraceScene& scene, const PlanFrame& frame);

/// The lowest and highest z of the scene in a plan, with a margin, so that rays that start there hit everything.
struct PlanHeights {
    double low = 0, high = 0;
};
PlanHeights planHeights(const TraceScene& scene, const PlanFrame& frame);

} // namespace pointrt
