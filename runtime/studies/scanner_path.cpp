// SPDX-License-Identifier: Apache-2.0
#include "runtime/studies/scanner_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "runtime/studies/study_values.h"

namespace pointrt {
namespace {

using Quaternion = std::array<double, 4>; // x y z w

double dot4(const Quaternion& a, const Quaternion& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]; }

/// a * first + b * second
Quaternion mixed(double first, const Quaternion& a, double second, const Quaternion& b) {
    Quaternion sum;
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = first * a[i] + second * b[i];
    return sum;
}

Quaternion unit(const Quaternion& q) { return mixed(1 / std::sqrt(dot4(q, q)), q, 0, q); }

/// Half of the angle between two rotations, by Kahan's formula, which is exact for small angles.
double halfAngle(const Quaternion& a, const Quaternion& b) {
    const Quaternion apart = mixed(1, a, -1, b), along = mixed(1, a, 1, b);
    return 2 * std::atan2(std::sqrt(dot4(apart, apart)), std::sqrt(dot4(along, along)));
}

/// Spherical linear interpolation (Shoemake 1985) along the shorter arc.
Quaternion slerp(const Quaternion& a, Quaternion b, double share) {
    if (dot4(a, b) < 0) b = mixed(-1, b, 0, b);
    const double angle = halfAngle(a, b), sine = std::sin(angle);
    if (sine == 0) return a;
    return unit(mixed(std::sin((1 - share) * angle) / sine, a, std::sin(share * angle) / sine, b));
}

/// A counterclockwise rotation about axis 0, 1 or 2.
Quaternion about(std::size_t axis, double degrees) {
    const double half = degrees * std::numbers::pi / 360;
    Quaternion q{0, 0, 0, std::cos(half)};
    q[axis] = std::sin(half);
    return q;
}

/// Hamilton product: rotates by b, then by a.
Quaternion product(const Quaternion& a, const Quaternion& b) {
    const Vec3 u{a[0], a[1], a[2]}, v{b[0], b[1], b[2]};
    const Vec3 w = a[3] * v + b[3] * u + cross(u, v);
    return {w.x, w.y, w.z, a[3] * b[3] - dot(u, v)};
}

} // namespace

std::array<double, 4> lidarRotation(double yaw_deg, double pitch_deg, double roll_deg) {
    return product(about(2, yaw_deg), product(about(1, pitch_deg), about(0, roll_deg)));
}

Vec3 ScannerPose::rotated(Vec3 direction) const {
    const Vec3 axis{rotation[0], rotation[1], rotation[2]};
    const Vec3 aside = 2 * cross(axis, direction);
    return direction + rotation[3] * aside + cross(axis, aside);
}

ScannerPath::ScannerPath(std::vector<LidarPose> poses) : poses_(std::move(poses)) {
    for (LidarPose& pose : poses_) pose.rotation = unit(pose.rotation);
}

ScannerPose ScannerPath::at(double time) const {
    const auto next = std::upper_bound(poses_.begin(), poses_.end(), time,
                                       [](double t, const LidarPose& pose) { return t < pose.time; });
    if (next == poses_.begin()) return {vectorOf(next->position), next->rotation};
    const LidarPose& before = *(next - 1);
    if (next == poses_.end()) return {vectorOf(before.position), before.rotation};
    const double share = (time - before.time) / (next->time - before.time);
    const Vec3 from = vectorOf(before.position), to = vectorOf(next->position);
    return {from + share * (to - from), slerp(before.rotation, next->rotation, share)};
}

} // namespace pointrt
