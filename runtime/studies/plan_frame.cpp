// SPDX-License-Identifier: Apache-2.0
#include "runtime/studies/plan_frame.h"

#include <algorithm>
#include <cmath>

#include "runtime/scene/sun.h"
#include "runtime/studies/study_values.h"

namespace pointrt {

PlanFrame planFrame(Vec3 origin, const Position& upwards) {
    constexpr double kUnitError = 1e-6;
    const Vec3 up = vectorOf(upwards);
    if (!(std::abs(length(up) - 1) < kUnitError)) refuseUsage("up must have unit length");
    const Vec3 north = defaultNorth(up);
    return {origin, cross(north, up), north, up};
}

PlanBounds planBounds(const TraceScene& scene, const PlanFrame& frame) {
    const SceneBounds bounds = scene.bounds();
    PlanBounds plan{{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    for (unsigned corner = 0; corner < 8; ++corner) {
        const auto side = [&](unsigned axis) { return (corner >> axis & 1 ? bounds.high : bounds.low)[axis]; };
        const Vec3 at = frame.planOf({side(0), side(1), side(2)});
        plan.low = {std::min(plan.low.x, at.x), std::min(plan.low.y, at.y), std::min(plan.low.z, at.z)};
        plan.high = {std::max(plan.high.x, at.x), std::max(plan.high.y, at.y), std::max(plan.high.z, at.z)};
    }
    return plan;
}

PlanHeights planHeights(const TraceScene& scene, const PlanFrame& frame) {
    const PlanBounds bounds = planBounds(scene, frame);
    const double low = bounds.low.z, high = bounds.high.z;
    const double margin = 0.01 * (high - low) + 1e-9 * std::abs(high); // more than rounding
    return {low - margin, high + margin};
}

} // namespace pointrt
