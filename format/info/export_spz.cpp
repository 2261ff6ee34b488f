// SPDX-License-Identifier: Apache-2.0
#include "format/info/export_spz.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "format/base/error.h"
#include "format/info/gaussian_values.h"
#include "format/pointio/point_file.h"

namespace pointrt {
namespace {

constexpr std::uint32_t kVersion = 3;
/// Coordinates are signed and have 24 bits.
constexpr int kCoordinateBits = 24;
constexpr double kColorScale = 0.15; // of the constant coefficient, around grey

struct Header {
    char magic[4] = {'N', 'G', 'S', 'P'};
    std::uint32_t version = kVersion, count = 0;
    std::uint8_t degree = 0, fractional_bits = 0, flags = 0, unused = 0;
};
static_assert(sizeof(Header) == 16);

std::uint8_t byteOf(double value) { return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0l, 255l)); }

/// Signs of y and z, and of the harmonics, after half a turn about x; all 1 if it is not turned.
struct Turn {
    double yz = 1;
    std::array<int, 15> harmonics{1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
};

Turn turnOf(const std::array<float, 3>& up) {
    if (!(up[1] < -0.5f)) return {};
    // y, z, x; xy, yz, 2zz-xx-yy, xz, xx-yy; y(3xx-yy), xyz, y(4zz-..), z(2zz-..), x(4zz-..), z(xx-yy), x(xx-3yy)
    return {-1, {-1, -1, 1, -1, 1, 1, -1, 1, -1, 1, -1, -1, 1, -1, 1}};
}

/// The smallest sufficient number of integer bits, so that most bits are fractional.
int fractionalBits(const PointOutline& outline) {
    double most = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        most = std::max({most, std::abs(outline.bounds_min[axis]), std::abs(outline.bounds_max[axis])});
    const int before = most > 0 ? std::max(0, std::ilogb(most) + 1) : 0;
    if (before >= kCoordinateBits)
        throw Error(ExitCode::kBadInput, "coordinates beyond 8,388,608 do not fit into SPZ: export a .ply");
    return kCoordinateBits - 1 - before;
}

std::uint32_t countOf(const PointOutline& outline) {
    if (outline.count.value() > std::numeric_limits<std::uint32_t>::max())
        throw Error(ExitCode::kBadInput, "SPZ can hold only fewer than 2^32 Gaussians: export a .ply");
    return static_cast<std::uint32_t>(outline.count.value());
}

/// 2 bits: index of the largest of x y z w, which is made positive; the others in 10 bits each, a sign and a fraction
/// of sqrt(1/2).
std::uint32_t packRotation(std::array<double, 4> xyzw) {
    std::size_t largest = 0;
    for (std::size_t i = 1; i < 4; ++i)
        if (std::abs(xyzw[i]) > std::abs(xyzw[largest])) largest = i;
    const double sign = xyzw[largest] < 0 ? -1 : 1;
    auto bits = static_cast<std::uint32_t>(largest);
    for (std::size_t i = 0; i < 4; ++i) {
        if (i == largest) continue;
        const double value = sign * xyzw[i];
        const auto size =
            static_cast<std::uint32_t>(std::min(511.0, std::round(511 * std::sqrt(2.0) * std::abs(value))));
        bits = bits << 10 | (value < 0 ? 512u : 0u) | size;
    }
    return bits;
}

/// The arrays of all Gaussians, one after the other in the file.
struct Arrays {
    std::vector<std::uint8_t> positions, alphas, colors, scales, rotations, harmonics;
};

void appendPosition(const ProFile& file, const pro_gaussian& gaussian, const Turn& turn, int bits, Arrays& arrays) {
    for (int axis = 0; axis < 3; ++axis) {
        const double at = inputCoordinate(file, gaussian, axis);
        const double most = std::ldexp(1.0, kCoordinateBits - 1) - 1;
        const double code = std::clamp(std::round(std::ldexp(axis > 0 ? turn.yz * at : at, bits)), -most, most);
        const auto word = static_cast<std::uint32_t>(static_cast<std::int32_t>(code));
        for (int byte = 0; byte < 3; ++byte) arrays.positions.push_back(static_cast<std::uint8_t>(word >> 8 * byte));
    }
}

/// Half a turn about x multiplies a rotation by the quaternion i.
void appendRotation(const pro_gaussian& gaussian, const Turn& turn, Arrays& arrays) {
    const double w = gaussian.rotation[0], x = gaussian.rotation[1], y = gaussian.rotation[2], z = gaussian.rotation[3];
    const std::uint32_t word = packRotation(turn.yz < 0 ? std::array{w, -z, y, -x} : std::array{x, y, z, w});
    for (int byte = 0; byte < 4; ++byte) arrays.rotations.push_back(static_cast<std::uint8_t>(word >> 8 * byte));
}

/// How all Gaussians of an export are written.
struct Coding {
    Turn turn;
    int fractional_bits = 0;
    std::uint32_t degree = 0;
};

/// 0 beyond the degree of the file.
void appendHarmonics(const ProFile& file, std::size_t index, const Coding& coding, Arrays& arrays) {
    const auto codes = file.harmonics(index);
    for (std::uint32_t k = 0; k < pro_harmonic_count(coding.degree); ++k)
        for (std::size_t color = 0; color < 3; ++color) {
            const double value = 3 * k < codes.size() ? harmonicValue(file, codes[3 * k + color], k) : 0;
            arrays.harmonics.push_back(byteOf(128 + 128 * coding.turn.harmonics[k] * value));
        }
}

void appendGaussian(const ProFile& file, std::size_t index, const Coding& coding, Arrays& arrays) {
    const pro_gaussian gaussian = file.gaussian(index);
    appendPosition(file, gaussian, coding.turn, coding.fractional_bits, arrays);
    arrays.alphas.push_back(byteOf(255 * double{gaussian.opacity}));
    for (const float color : gaussian.color)
        arrays.colors.push_back(byteOf(255 * (kColorScale * constantHarmonic(color) + 0.5)));
    for (const float deviation : gaussian.deviation)
        arrays.scales.push_back(byteOf(16 * (std::log(double{deviation} * file.info().scale) + 10)));
    appendRotation(gaussian, coding.turn, arrays);
    appendHarmonics(file, index, coding, arrays);
}

/// Compresses with a gzip header, in steps.
class GzipWriter {
public:
    explicit GzipWriter(PointFile& out) : out_(out) {
        constexpr int kGzip = 16 + MAX_WBITS, kDefaultMemory = 8;
        if (deflateInit2(&stream_, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kGzip, kDefaultMemory, Z_DEFAULT_STRATEGY) !=
            Z_OK)
            throw Error(ExitCode::kCannotRun, "zlib cannot start");
    }
    ~GzipWriter() { deflateEnd(&stream_); }
    GzipWriter(const GzipWriter&) = delete;
    GzipWriter& operator=(const GzipWriter&) = delete;

    void append(const void* data, std::size_t bytes) {
        constexpr std::size_t kMost = 1 << 30; // zlib counts in 32 bits
        for (std::size_t at = 0; at < bytes; at += kMost)
            deflateAll(static_cast<const Bytef*>(data) + at, std::min(kMost, bytes - at), Z_NO_FLUSH);
    }
    void finish() { deflateAll(nullptr, 0, Z_FINISH); }

private:
    void deflateAll(const Bytef* data, std::size_t bytes, int flush) {
        stream_.next_in = const_cast<Bytef*>(data);
        stream_.avail_in = static_cast<uInt>(bytes);
        do {
            std::array<Bytef, 1 << 16> packed;
            stream_.next_out = packed.data();
            stream_.avail_out = packed.size();
            deflate(&stream_, flush);
            out_.append(packed.data(), packed.size() - stream_.avail_out);
        } while (stream_.avail_out == 0);
    }

    PointFile& out_;
    z_stream stream_{};
};

} // namespace

void exportSpz(const ExportSource& source, const std::string& path, bool overwrite) {
    const Coding coding{turnOf(source.up), fractionalBits(source.outline), source.harmonics_degree};
    Header header;
    header.count = countOf(source.outline);
    header.degree = static_cast<std::uint8_t>(coding.degree);
    header.fractional_bits = static_cast<std::uint8_t>(coding.fractional_bits);
    Arrays arrays;
    source.forEachPart([&](const ProFile& file, std::span<const std::uint32_t> splats) {
        for (const std::uint32_t index : splats) appendGaussian(file, index, coding, arrays);
    });
    PointFile out(path, overwrite ? format::Existing::kReplaced : format::Existing::kKept);
    GzipWriter packed(out);
    packed.append(&header, sizeof header);
    for (const std::vector<std::uint8_t>* array :
         {&arrays.positions, &arrays.alphas, &arrays.colors, &arrays.scales, &arrays.rotations, &arrays.harmonics})
        packed.append(array->data(), array->size());
    packed.finish();
    out.commit();
}

} // namespace pointrt
