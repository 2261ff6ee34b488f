// SPDX-License-Identifier: Apache-2.0
#include "tests/gaussians/picture_difference.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pointrt::test {

namespace {

/// A step of 8 bits, and room for the rounding of floats.
constexpr double kStep = 1.0 / 255 + 1e-6;

double channelDifference(float a, float b) {
    if (!std::isfinite(a) || !std::isfinite(b)) return 1;
    return std::abs(double{a} - double{b});
}

} // namespace

PictureDifference differenceOf(const FloatPicture& a, const FloatPicture& b) {
    if (a.width != b.width || a.height != b.height || a.channels != 3 || b.channels != 3)
        throw std::runtime_error("the pictures differ in size, or are not of three channels");
    PictureDifference result;
    double squares = 0;
    std::size_t pixels_off = 0;
    const std::size_t pixels = a.values.size() / 3;
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        double largest = 0;
        for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
            const double difference = channelDifference(a.values[i], b.values[i]);
            squares += difference * difference;
            largest = std::max(largest, difference);
        }
        result.max_difference = std::max(result.max_difference, largest);
        pixels_off += largest > kStep;
    }
    result.psnr_db = -10 * std::log10(squares / static_cast<double>(a.values.size()));
    result.share_off = static_cast<double>(pixels_off) / static_cast<double>(pixels);
    return result;
}

} // namespace pointrt::test
