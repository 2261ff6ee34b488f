// SPDX-License-Identifier: Apache-2.0
// Packs and unpacks Gaussians. SPEC.md states the quantisation errors, tests/format checks them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "format/pro/position_codes.h"
#include "pointrt/pro.h"

namespace {

/// Rounds and clamps to 0 ... most; NaN becomes 0.
std::uint32_t roundedCode(double value, double most) {
    return value > 0 ? static_cast<std::uint32_t>(std::lround(std::min(value, most))) : 0;
}

/// A unit quaternion as the codes of its three smaller components and the index of the largest one.
struct RotationCodes {
    std::array<std::uint32_t, 3> codes{};
    std::uint32_t largest = 0;
};

/// Unit length; no rotation for zero and non-finite input.
std::array<double, 4> normalizedRotation(const float rotation[4]) {
    double squared = 0;
    for (std::size_t i = 0; i < 4; ++i) squared += double{rotation[i]} * rotation[i];
    if (!(squared > 0) || !std::isfinite(squared)) return {1, 0, 0, 0};
    std::array<double, 4> unit{};
    for (std::size_t i = 0; i < 4; ++i) unit[i] = rotation[i] / std::sqrt(squared);
    return unit;
}

RotationCodes encodeRotation(const float rotation[4]) {
    const std::array<double, 4> unit = normalizedRotation(rotation);
    RotationCodes coded;
    for (std::uint32_t i = 1; i < 4; ++i)
        if (std::fabs(unit[i]) > std::fabs(unit[coded.largest])) coded.largest = i;
    const double sign = unit[coded.largest] < 0 ? -1 : 1; // q and -q are the same rotation
    for (std::size_t i = 0, k = 0; i < 4; ++i)
        if (i != coded.largest)
            coded.codes[k++] =
                roundedCode((sign * unit[i] / double{PRO_ROTATION_MAX} + 1) / 2 * double{PRO_ROTATION_STEPS},
                            double{PRO_ROTATION_STEPS});
    return coded;
}

/// Computed in float, as in shaders. Also normalises codes that do not belong to a unit quaternion.
void decodeRotation(const RotationCodes& coded, float rotation[4]) {
    float squared = 0;
    for (std::size_t i = 0, k = 0; i < 4; ++i) {
        if (i == coded.largest) continue;
        rotation[i] = (static_cast<float>(coded.codes[k++]) / PRO_ROTATION_STEPS * 2 - 1) * PRO_ROTATION_MAX;
        squared += rotation[i] * rotation[i];
    }
    rotation[coded.largest] = std::sqrt(std::max(1 - squared, 0.0f));
    if (squared <= 1) return;
    for (std::size_t i = 0; i < 4; ++i) rotation[i] /= std::sqrt(squared);
}

std::uint32_t encodeDeviation(float deviation, const pro_gaussians& coding) {
    if (!(deviation > 0) || !(coding.deviation_step > 0)) return 0;
    return roundedCode((std::log2(double{deviation}) - coding.deviation_low) / coding.deviation_step,
                       PRO_DEVIATION_CODE_MAX);
}

float decodeDeviation(std::uint32_t code, const pro_gaussians& coding) {
    return std::exp2(coding.deviation_low + static_cast<float>(code & PRO_DEVIATION_MASK) * coding.deviation_step);
}

/// @param step color_step, for blue twice that
std::uint32_t encodeColor(float color, float low, float step, std::uint32_t most) {
    return step > 0 ? roundedCode((double{color} - low) / step, most) : 0;
}

/// The position of a coordinate within its position step, as a code.
std::uint32_t encodeResidual(double coordinate, std::uint32_t position) {
    const double residual =
        std::floor((coordinate * double{PRO_POSITION_STEPS} - position) * double{PRO_RESIDUAL_STEPS});
    return residual > 0 ? static_cast<std::uint32_t>(std::min(residual, double{PRO_RESIDUAL_MASK})) : 0;
}

double decodeMean(std::uint32_t residual, std::uint32_t position) {
    return (position + ((residual & PRO_RESIDUAL_MASK) + 0.5) / double{PRO_RESIDUAL_STEPS}) * double{PRO_POSITION_STEP};
}

} // namespace

void pro_gaussian_encode(const pro_gaussian* gaussian, const pro_gaussians* coding, const uint32_t splat[4],
                         uint32_t words[4]) {
    const RotationCodes rotation = encodeRotation(gaussian->rotation);
    const auto positions = pointrt::format::positionCodes(splat);
    std::array<std::uint32_t, 3> residuals{}, deviations{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        residuals[axis] = encodeResidual(gaussian->mean[axis], positions[axis]);
        deviations[axis] = encodeDeviation(gaussian->deviation[axis], *coding);
    }
    const std::uint32_t opacity =
        roundedCode(double{gaussian->opacity} * double{PRO_OPACITY_STEPS}, double{PRO_OPACITY_STEPS});
    const float low = coding->color_low, step = coding->color_step;
    words[0] = rotation.codes[0] | rotation.codes[1] << PRO_ROTATION_BITS |
               rotation.largest << PRO_ROTATION_LARGEST_SHIFT | residuals[0] << PRO_RESIDUAL_X_SHIFT;
    words[1] = rotation.codes[2] | deviations[0] << PRO_DEVIATION_SHIFT | residuals[1] << PRO_RESIDUAL_Y_SHIFT |
               opacity << PRO_OPACITY_LOW_SHIFT;
    words[2] = deviations[1] | deviations[2] << PRO_DEVIATION_SHIFT |
               opacity >> PRO_OPACITY_LOW_BITS << PRO_OPACITY_HIGH_SHIFT;
    words[3] = residuals[2] |
               encodeColor(gaussian->color[0], low, step, PRO_GAUSSIAN_COLOR_MASK) << PRO_GAUSSIAN_RED_SHIFT |
               encodeColor(gaussian->color[1], low, step, PRO_GAUSSIAN_COLOR_MASK) << PRO_GAUSSIAN_GREEN_SHIFT |
               encodeColor(gaussian->color[2], low, 2 * step, PRO_GAUSSIAN_BLUE_MASK) << PRO_GAUSSIAN_BLUE_SHIFT;
}

void pro_gaussian_decode(const pro_gaussians* coding, const uint32_t splat[4], const uint32_t words[4],
                         pro_gaussian* gaussian) {
    const auto positions = pointrt::format::positionCodes(splat);
    gaussian->mean[0] = decodeMean(words[0] >> PRO_RESIDUAL_X_SHIFT, positions[0]);
    gaussian->mean[1] = decodeMean(words[1] >> PRO_RESIDUAL_Y_SHIFT, positions[1]);
    gaussian->mean[2] = decodeMean(words[3], positions[2]);
    gaussian->deviation[0] = decodeDeviation(words[1] >> PRO_DEVIATION_SHIFT, *coding);
    gaussian->deviation[1] = decodeDeviation(words[2], *coding);
    gaussian->deviation[2] = decodeDeviation(words[2] >> PRO_DEVIATION_SHIFT, *coding);
    decodeRotation({{words[0] & PRO_ROTATION_MASK, words[0] >> PRO_ROTATION_BITS & PRO_ROTATION_MASK,
                     words[1] & PRO_ROTATION_MASK},
                    words[0] >> PRO_ROTATION_LARGEST_SHIFT & PRO_ROTATION_LARGEST_MASK},
                   gaussian->rotation);
    const std::uint32_t opacity = words[1] >> PRO_OPACITY_LOW_SHIFT | words[2] >> PRO_OPACITY_HIGH_SHIFT
                                                                                      << PRO_OPACITY_LOW_BITS;
    gaussian->opacity = static_cast<float>(opacity) / PRO_OPACITY_STEPS;
    const auto colorOf = [&](std::uint32_t code) {
        return coding->color_low + static_cast<float>(code) * coding->color_step;
    };
    gaussian->color[0] = colorOf(words[3] >> PRO_GAUSSIAN_RED_SHIFT & PRO_GAUSSIAN_COLOR_MASK);
    gaussian->color[1] = colorOf(words[3] >> PRO_GAUSSIAN_GREEN_SHIFT & PRO_GAUSSIAN_COLOR_MASK);
    gaussian->color[2] = colorOf(2 * (words[3] >> PRO_GAUSSIAN_BLUE_SHIFT));
}

void pro_gaussian_at(const pro_gaussians* gaussians, const uint32_t* splats, uint32_t index, pro_gaussian* gaussian) {
    const std::size_t k = index;
    pro_gaussian_decode(gaussians, splats + k * PRO_SPLAT_WORDS, gaussians->words + k * PRO_GAUSSIAN_WORDS, gaussian);
    const std::span exact(gaussians->exact, gaussians->exact_count);
    const auto found = std::ranges::lower_bound(exact, index, {}, &pro_exact_gaussian::index);
    if (found == exact.end() || found->index != index) return;
    std::copy_n(found->rotation, 4, gaussian->rotation);
    std::copy_n(found->deviation, 3, gaussian->deviation);
    gaussian->opacity = found->opacity;
}

uint32_t pro_harmonic_count(uint32_t degree) {
    return degree <= PRO_HARMONICS_DEGREE_MAX ? (degree + 1) * (degree + 1) - 1 : 0;
}
