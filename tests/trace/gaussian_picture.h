// SPDX-License-Identifier: Apache-2.0
// Pictures of Gaussians and their difference from known answers.
#pragma once

#include <cmath>

#include "tests/gaussians/srgb.h"
#include "tests/trace/render_helper.h"

namespace pointrt::test {

inline constexpr std::uint32_t kGaussianPixels = 48;

/// Settings for pictures of Gaussians alone, on black.
inline RenderSettings lookingFrom(Vec3 eye, Vec3 target, std::uint32_t size = kGaussianPixels) {
    RenderSettings settings = square(size);
    settings.camera.eye = eye;
    settings.camera.target = target;
    settings.camera.fov_deg = 40;
    settings.lights = 0;
    settings.background = Background{};
    return settings;
}

/// A square facing z, 10 units long.
inline ShapeDescription screenAt(double z, std::uint32_t material) {
    return {ShapeKind::kQuad, {0, 0, z}, {5, 0, 0}, {0, 5, 0}, {0, 0, 1}, material};
}

/// Peak signal to noise, dB, of display-encoded colours.
/// @param expected the linear light of the pixel through which a ray of this direction goes
template <typename Expected>
double psnrAgainst(const Rendered& rendered, const RenderSettings& settings, const Expected& expected) {
    double squares = 0;
    for (std::uint32_t y = 0; y < settings.height; ++y)
        for (std::uint32_t x = 0; x < settings.width; ++x) {
            const Color truth = expected(centerRayDirection(settings, rendered.camera, x, y));
            for (int c = 0; c < 3; ++c) {
                const double off =
                    srgbFromLinear(pixel(rendered.film, x, y, c)) - srgbFromLinear(truth[static_cast<std::size_t>(c)]);
                squares += off * off;
            }
        }
    return -10 * std::log10(squares / (3.0 * settings.width * settings.height) + 1e-20);
}

} // namespace pointrt::test
