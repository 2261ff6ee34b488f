// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/panorama.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "runtime/scene/camera.h"
#include "shaders/shared/panorama.h"

namespace pointrt {

// Must agree with panoramaRay in shaders/lib/camera_ray.glsl.
PanoramaRay panoramaRay(const Camera& camera, double across, double down) {
    constexpr double kPi = std::numbers::pi;
    const bool in_stereo = camera.eyes_apart > 0, is_left = down < 0.5;
    const double row = !in_stereo ? down : is_left ? 2 * down : 2 * down - 1;
    const double longitude = (2 * across - 1) * kPi, latitude = (0.5 - row) * kPi;
    const double sine = std::sin(longitude), cosine = std::cos(longitude), level = std::cos(latitude);
    const Vec3 direction = level * (sine * camera.right + cosine * camera.forward) + std::sin(latitude) * camera.up;
    const double aside =
        (is_left ? -0.5 : 0.5) * camera.eyes_apart * std::min(1.0, level / double{PANORAMA_FULL_STEREO_COSINE});
    return {camera.eye + aside * (cosine * camera.right - sine * camera.forward), normalize(direction)};
}

Camera levelCamera(const Camera& camera, Vec3 up) {
    constexpr double kVerticalSine = 1e-6; // far above rounding errors, far below visible
    Camera level = camera;
    level.up = normalize(up);
    const Vec3 ahead = camera.forward - dot(camera.forward, level.up) * level.up;
    level.forward = length(ahead) > kVerticalSine ? normalize(ahead) : -1.0 * frontSide(up);
    level.right = cross(level.forward, level.up);
    return level;
}

PixelSize panoramaSize(std::uint32_t width, bool in_stereo) { return {width, in_stereo ? width : width / 2}; }

} // namespace pointrt
