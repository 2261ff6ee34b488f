// SPDX-License-Identifier: GPL-3.0-or-later
// SPZ files of Gaussians: https://github.com/nianticlabs/spz
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "preprocess/ingest/formats.h"
#include "preprocess/input/gaussian/spz_gaussian.h"

namespace pointrt {
namespace {

/// The bytes of one Gaussian in an array.
struct Bytes {
    const char* at;

    std::uint32_t operator[](std::size_t i) const { return static_cast<unsigned char>(at[i]); }
};

Bytes bytesOf(const SpzFile& file, SpzArray array, std::size_t index) {
    return {file.arrays[array].data() + index * file.bytesEach(array)};
}

/// IEEE 754 half: a sign, 5 bits of exponent, 10 of mantissa.
float halfToFloat(std::uint32_t half) {
    const int exponent = static_cast<int>(half >> 10 & 31), mantissa = static_cast<int>(half & 1023);
    const float sign = half >> 15 != 0 ? -1.0f : 1.0f;
    if (exponent == 31) return mantissa != 0 ? NAN : sign * INFINITY;
    return sign * (exponent == 0 ? std::ldexp(static_cast<float>(mantissa), -24)
                                 : std::ldexp(static_cast<float>(1024 + mantissa), exponent - 25));
}

double coordinateOf(const SpzFile& file, const Bytes& bytes, std::size_t axis) {
    if (file.version == 1) return static_cast<double>(halfToFloat(bytes[2 * axis] | bytes[2 * axis + 1] << 8));
    const std::uint32_t high = bytes[3 * axis] << 8 | bytes[3 * axis + 1] << 16 | bytes[3 * axis + 2] << 24;
    return std::ldexp(std::bit_cast<std::int32_t>(high) >> 8, -file.fractional_bits);
}

/// x y z in units of 1 / 127.5 from -1; w completes unit length.
Eigen::Quaternionf rotationOfThree(const Bytes& bytes) {
    const auto part = [&](std::size_t i) { return static_cast<float>(bytes[i]) / 127.5f - 1; };
    const Vec3f xyz(part(0), part(1), part(2));
    const float w = std::sqrt(std::max(0.0f, 1 - xyz.squaredNorm()));
    return {w, xyz.x(), xyz.y(), xyz.z()};
}

/// 2 bits: index of the largest of x y z w; then the others, starting with the last one, in 10 bits each, a sign and a
/// fraction of sqrt(1/2), which only the largest can exceed.
Eigen::Quaternionf rotationOfSmallest(const Bytes& bytes) {
    std::uint32_t bits = bytes[0] | bytes[1] << 8 | bytes[2] << 16 | bytes[3] << 24;
    const auto largest = static_cast<int>(bits >> 30);
    float parts[4] = {}, squares = 0;
    for (int i = 3; i >= 0; --i) {
        if (i == largest) continue;
        const float size = std::sqrt(0.5f) * static_cast<float>(bits & 511) / 511;
        parts[i] = (bits & 512) != 0 ? -size : size;
        squares += size * size;
        bits >>= 10;
    }
    parts[largest] = std::sqrt(std::max(0.0f, 1 - squares));
    return {parts[3], parts[0], parts[1], parts[2]};
}

/// Bytes in units of 1 / 128 around 128; red, green and blue of each harmonic in turn.
void readHarmonics(const SpzFile& file, std::size_t index, Gaussian& gaussian) {
    const Bytes bytes = bytesOf(file, kSpzHarmonics, index);
    const auto count = static_cast<std::size_t>(gaussianHarmonicCount(spzDegree(file)));
    for (std::size_t k = 0; k < count; ++k)
        for (std::size_t channel = 0; channel < 3; ++channel)
            gaussian.harmonics[k][static_cast<Eigen::Index>(channel)] =
                (static_cast<float>(bytes[3 * k + channel]) - 128) / 128;
}

bool isSpzStart(std::string_view bytes) { return bytes.starts_with("NGSP"); }

void readSpz(const InputFile& input, Sink& sink) {
    const SpzFile file = openSpz(input);
    const auto each = [&](const std::function<void(const Gaussian&)>& use) {
        for (std::size_t i = 0; i < file.count; ++i) use(spzGaussian(file, i));
    };
    if (file.harmonics_degree > spzDegree(file)) noteHigherHarmonics(input, sink);
    readGaussians(input, {file.count, Vec3d::UnitY(), spzDegree(file)}, each, sink); // axes: right, up, back
}

} // namespace

int spzDegree(const SpzFile& file) { return std::min(file.harmonics_degree, 3); }

/// Bytes hold logarithms of standard deviations in steps of 1/16 from -10, and harmonic colours around grey, scaled by
/// 0.15.
Gaussian spzGaussian(const SpzFile& file, std::size_t index) {
    const Bytes position = bytesOf(file, kSpzPositions, index), color = bytesOf(file, kSpzColors, index),
                scale = bytesOf(file, kSpzScales, index), rotation = bytesOf(file, kSpzRotations, index);
    constexpr float kColorScale = 0.15f;
    Gaussian gaussian;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto at = static_cast<Eigen::Index>(axis);
        gaussian.position[at] = coordinateOf(file, position, axis);
        gaussian.deviations[at] = std::exp(static_cast<float>(scale[axis]) / 16 - 10);
        const float harmonic = (static_cast<float>(color[axis]) / 255 - 0.5f) / kColorScale;
        gaussian.color[at] = colorOfHarmonic(static_cast<double>(harmonic));
    }
    gaussian.opacity = static_cast<float>(bytesOf(file, kSpzAlphas, index)[0]) / 255;
    gaussian.rotation = file.version < 3 ? rotationOfThree(rotation) : rotationOfSmallest(rotation);
    readHarmonics(file, index, gaussian);
    return gaussian;
}

const FormatReader readers::kSpz{.isStart = isSpzStart, .read = readSpz};

} // namespace pointrt
