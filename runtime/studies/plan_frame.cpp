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

PlanHeights planHeights(const TraceScene& scene, const PlanFrame& frame) {
    const SceneBounds bounds = scene.bounds();
    PlanHeights heights{HUGE_VAL, -HUGE_VAL};
    for (unsigned corner = 0; corner < 8; ++corner) {
        const auto side = [&](unsigned axis) { return (corner >> axis & 1 ? bounds.high : bounds.low)[axis]; };
        const double height = frame.planOf({side(0), side(1), side(2)}).z;
        heights.low = std::min(heights.low, height);
        heights.high = std::max(heights.high, height);
    }
    const double margin = 0.01 * (heights.high - heights.low) + 1e-9 * std::abs(heights.high); // beyond rounding
    return {heights.low - margin, heights.high + margin};
}

} // namespace pointrt
