// SPDX-License-Identifier: Apache-2.0
#include "tests/gaussians/oracle_camera.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace pointrt::test {

namespace {

/// Sines below this count as up being along the view.
constexpr double kParallelSine = 1e-6;

struct HashedPair {
    std::uint32_t x, y;
};

/// PCG-3D (Jarzynski and Olano, Hash Functions for GPU Rendering, 2020), without its third word.
HashedPair hashOf(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    constexpr std::uint32_t kFactor = 1664525, kTerm = 1013904223;
    x = x * kFactor + kTerm;
    y = y * kFactor + kTerm;
    z = z * kFactor + kTerm;
    const auto mix = [&] {
        x += y * z;
        y += z * x;
        z += x * y;
    };
    mix();
    x ^= x >> 16;
    y ^= y >> 16;
    z ^= z >> 16;
    mix();
    return {x, y};
}

/// The upper 24 bits of both, as a float holds them, added with wrap-around in the unit interval.
double shifted(std::uint32_t shift, std::uint32_t steps) {
    return std::ldexp(static_cast<double>(((shift >> 8) + (steps >> 8)) & 0xFFFFFFu), -24);
}

} // namespace

OracleCamera lookAt(const OracleView& view, std::uint32_t width, std::uint32_t height) {
    OracleCamera camera;
    const Double3 forward = minus(view.target, view.eye);
    if (!(length(forward) > 0)) throw std::invalid_argument("the camera's eye and target are equal");
    if (!(view.fov_deg > 0 && view.fov_deg < 180))
        throw std::invalid_argument("the field of view must be above 0 and below 180 degrees");
    camera.eye = view.eye;
    camera.forward = unit(forward);
    const Double3 right = cross(camera.forward, view.up);
    if (!(length(right) > kParallelSine * length(view.up))) throw std::invalid_argument("up is along the view");
    camera.right = unit(right);
    camera.up = cross(camera.right, camera.forward);
    camera.tan_half_fov = std::tan(view.fov_deg / 2 * std::numbers::pi / 180);
    camera.width = width;
    camera.height = height;
    return camera;
}

OracleRay rayThrough(const OracleCamera& camera, double x, double y) {
    const double aspect = static_cast<double>(camera.width) / camera.height;
    const double across = (2 * x / camera.width - 1) * camera.tan_half_fov * aspect;
    const double upwards = (1 - 2 * y / camera.height) * camera.tan_half_fov;
    const Double3 on_plane = plus(camera.forward, plus(times(across, camera.right), times(upwards, camera.up)));
    return {camera.eye, unit(on_plane)};
}

PixelOffset sampleOffset(std::uint32_t pixel, std::uint32_t sample, std::uint32_t seed) {
    // the R2 sequence (Roberts 2018): steps of 1/p and 1/p^2 for the plastic number p, times 2^32; the factor of the
    // seed is 2^32 over the golden ratio
    const HashedPair shift = hashOf(pixel, 0, seed * 0x9E3779B9u);
    return {shifted(shift.x, sample * 0xC13FA9A9u), shifted(shift.y, sample * 0x91E10DA6u)};
}

} // namespace pointrt::test
