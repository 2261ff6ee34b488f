// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/camera_path.h"

#include <algorithm>
#include <cmath>

namespace pointrt {
namespace {

/// A part of the path, between the second and the third of four keys; keys beyond the ends are mirrored.
struct SplinePart {
    std::span<const Camera> keys;
    std::size_t first;
    double share; ///< position in the part, 0 to 1

    Vec3 at(Vec3 Camera::*member) const {
        const Vec3 b = keys[first].*member, c = keys[first + 1].*member;
        const Vec3 a = first > 0 ? keys[first - 1].*member : 2.0 * b - c;
        const Vec3 d = first + 2 < keys.size() ? keys[first + 2].*member : 2.0 * c - b;
        const double t = share;
        return 0.5 * (2.0 * b + t * (c - a) + t * t * (2.0 * a - 5.0 * b + 4.0 * c - d) +
                      t * t * t * (3.0 * (b - c) + d - a));
    }
};

double heightBetween(const Camera& from, const Camera& to, double share) {
    if (!(from.ortho_height > 0 && to.ortho_height > 0)) return (share < 0.5 ? from : to).ortho_height;
    return from.ortho_height * std::pow(to.ortho_height / from.ortho_height, share); // interpolates the zoom evenly
}

} // namespace

Camera cameraOnPath(std::span<const Camera> keys, double at) {
    const auto last = static_cast<double>(keys.size() - 1);
    const double place = std::clamp(at, 0.0, last), before = std::min(std::floor(place), std::max(0.0, last - 1));
    const auto first = static_cast<std::size_t>(before);
    const double share = place - before;
    if (share == 0) return keys[first];
    if (share == 1) return keys[first + 1];
    const SplinePart part{keys, first, share};
    const Camera &from = keys[first], &to = keys[first + 1];
    Camera camera = from;
    camera.eye = part.at(&Camera::eye);
    const Vec3 forward = part.at(&Camera::forward), right = cross(forward, part.at(&Camera::up));
    if (!(length(forward) > 0) || !(length(right) > 0)) return share < 0.5 ? from : to; // the two views are opposite
    camera.forward = normalize(forward);
    camera.right = normalize(right);
    camera.up = cross(camera.right, camera.forward);
    camera.fov_deg = from.fov_deg + share * (to.fov_deg - from.fov_deg);
    camera.ortho_height = heightBetween(from, to, share);
    return camera;
}

} // namespace pointrt
