// SPDX-License-Identifier: Apache-2.0
// Packs and unpacks splats. SPEC.md states the quantisation errors, tests/format checks them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "format/pro/position_codes.h"
#include "pointrt/pro.h"

namespace {

using Vector = std::array<double, 3>;

/// Clamps to the cube; NaN becomes 0.
std::uint32_t encodePosition(float position) {
    const float code = std::floor(position * PRO_POSITION_STEPS);
    if (!(code > 0)) return 0;
    return static_cast<std::uint32_t>(std::min(code, static_cast<float>(PRO_POSITION_MASK)));
}

float decodePosition(std::uint32_t code) { return (static_cast<float>(code) + 0.5f) * PRO_POSITION_STEP; }

/// Octahedral map (Meyer et al., "On Floating-Point Normal Vectors", EGSR 2010). In float, as in the shaders.
std::array<float, 3> decodeNormal(std::uint32_t u, std::uint32_t v) {
    float x = static_cast<float>(u) / PRO_NORMAL_STEPS * 2 - 1;
    float y = static_cast<float>(v) / PRO_NORMAL_STEPS * 2 - 1;
    const float z = 1 - std::fabs(x) - std::fabs(y);
    const float fold = std::max(-z, 0.0f);
    x += x < 0 ? fold : -fold;
    y += y < 0 ? fold : -fold;
    const float scale = 1 / std::sqrt(x * x + y * y + z * z);
    return {x * scale, y * scale, z * scale};
}

/// Unit vector; +z for zero and non-finite input.
Vector normalized(const float normal[3]) {
    const double length = std::hypot(double{normal[0]}, double{normal[1]}, double{normal[2]});
    if (!(length > 0) || !std::isfinite(length)) return {0, 0, 1};
    return {normal[0] / length, normal[1] / length, normal[2] / length};
}

double squaredDistance(const Vector& a, const std::array<float, 3>& b) {
    return std::pow(a[0] - b[0], 2) + std::pow(a[1] - b[1], 2) + std::pow(a[2] - b[2], 2);
}

/// Rounding in the map is not rounding on the sphere, so this takes the closest of the four surrounding codes
/// (Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors", JCGT 2014).
std::uint32_t encodeNormal(const float normal[3]) {
    const Vector n = normalized(normal);
    const double sum = std::fabs(n[0]) + std::fabs(n[1]) + std::fabs(n[2]);
    double x = n[0] / sum, y = n[1] / sum;
    if (n[2] < 0) {
        const double folded_x = std::copysign(1 - std::fabs(y), x);
        y = std::copysign(1 - std::fabs(x), y);
        x = folded_x;
    }
    const auto low = [](double coordinate) {
        const double code = std::floor((coordinate + 1) / 2 * double{PRO_NORMAL_STEPS});
        return static_cast<std::uint32_t>(std::clamp(code, 0.0, double{PRO_NORMAL_MASK} - 1));
    };
    const std::uint32_t u0 = low(x), v0 = low(y);
    std::uint32_t best = 0;
    double best_distance = 5; // above any squared distance of two unit vectors
    for (std::uint32_t corner = 0; corner < 4; ++corner) {
        const std::uint32_t u = u0 + (corner & 1), v = v0 + (corner >> 1);
        const double distance = squaredDistance(n, decodeNormal(u, v));
        if (distance >= best_distance) continue;
        best_distance = distance;
        best = u | v << PRO_NORMAL_BITS;
    }
    return best;
}

float decodeRadius(std::uint32_t code, float radius_max, float radius_step) {
    return radius_max * std::exp2(-static_cast<float>(code) * radius_step);
}

/// The largest code whose radius is at least the given one; 0 if radius_max is smaller.
std::uint32_t encodeRadius(float radius, float radius_max, float radius_step) {
    if (!(radius_step > 0) || !(radius < radius_max)) return 0;
    const double octaves = std::log2(double{radius_max} / std::max(double{radius}, double{PRO_RADIUS_MIN}));
    const double exact = std::floor(octaves / double{radius_step});
    auto code = static_cast<std::uint32_t>(std::clamp(exact, 0.0, double{PRO_RADIUS_CODE_MAX}));
    // corrects rounding of log2 and exp2
    while (code > 0 && decodeRadius(code, radius_max, radius_step) < radius) --code;
    return code;
}

} // namespace

void pro_splat_encode(const pro_splat* splat, float radius_max, float radius_step, uint32_t words[4]) {
    const std::uint32_t x = encodePosition(splat->position[0]);
    const std::uint32_t y = encodePosition(splat->position[1]);
    const std::uint32_t z = encodePosition(splat->position[2]);
    words[0] = x | (y & PRO_Y_LOW_MASK) << PRO_POSITION_BITS;
    words[1] = y >> PRO_Y_LOW_BITS | z << PRO_Y_HIGH_BITS;
    words[2] = encodeNormal(splat->normal) | std::uint32_t{splat->material} << PRO_MATERIAL_SHIFT;
    words[3] = std::uint32_t{splat->color[0]} | std::uint32_t{splat->color[1]} << 8 |
               std::uint32_t{splat->color[2]} << 16 |
               encodeRadius(splat->radius, radius_max, radius_step) << PRO_RADIUS_SHIFT;
}

void pro_splat_decode(const uint32_t words[4], float radius_max, float radius_step, pro_splat* splat) {
    const auto codes = pointrt::format::positionCodes(words);
    for (std::size_t axis = 0; axis < 3; ++axis) splat->position[axis] = decodePosition(codes[axis]);
    const auto normal = decodeNormal(words[2] & PRO_NORMAL_MASK, words[2] >> PRO_NORMAL_BITS & PRO_NORMAL_MASK);
    std::copy(normal.begin(), normal.end(), splat->normal);
    splat->radius = decodeRadius(words[3] >> PRO_RADIUS_SHIFT, radius_max, radius_step);
    for (unsigned channel = 0; channel < 3; ++channel)
        splat->color[channel] = static_cast<std::uint8_t>(words[3] >> (8 * channel) & 0xFF);
    splat->material = static_cast<std::uint8_t>(words[2] >> PRO_MATERIAL_SHIFT);
}

int pro_splat_is_ball(const uint32_t words[4]) { return (words[1] & PRO_SPLAT_BALL) != 0; }

void pro_splat_set_ball(uint32_t words[4]) { words[1] |= PRO_SPLAT_BALL; }
