// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/input/turntable_rotation.h"

#include <algorithm>
#include <cmath>

namespace pointrt {

Vec3 usableAxis(Vec3 up) {
    const double largest = std::max({std::abs(up.x), std::abs(up.y), std::abs(up.z)});
    return largest > 0 && (largest > 1e100 || largest < 1e-100) ? Vec3{up.x / largest, up.y / largest, up.z / largest}
                                                                : up;
}

Attitude attitudeOf(const ViewCamera& view) {
    const ViewAxes axes = axesOf(view);
    const Vec3 axis = normalize(view.up);
    const Vec3 level = cross(axis, axes.right);
    // near the poles, right may come from a tilted heading
    const Vec3 right = normalize(axes.right - axis * dot(axes.right, axis));
    return {right, std::atan2(dot(axes.forward, axis), dot(axes.forward, level))};
}

Vec3 forwardOf(const Attitude& attitude, Vec3 axis) {
    return cross(axis, attitude.right) * std::cos(attitude.elevation) + axis * std::sin(attitude.elevation);
}

Vec3 rotated(Vec3 v, Vec3 axis, double radians) { // Rodrigues' formula
    return v * std::cos(radians) + cross(axis, v) * std::sin(radians) + axis * (dot(axis, v) * (1 - std::cos(radians)));
}

ViewCamera placed(ViewCamera view, Vec3 pivot, double distance, const Attitude& attitude) {
    const Vec3 forward = forwardOf(attitude, normalize(view.up));
    view.pivot = pivot;
    view.eye = pivot - forward * distance;
    view.heading = cross(attitude.right, forward);
    return view;
}

} // namespace pointrt
