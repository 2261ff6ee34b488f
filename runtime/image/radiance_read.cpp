// SPDX-License-Identifier: Apache-2.0
// Not stb_image: version 2.27 loops forever on pictures that end within a scan line.
#include "runtime/image/radiance_read.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <span>

#include "format/base/error.h"
#include "runtime/image/picture_room.h"
#include "runtime/util/input_file.h"
#include "runtime/util/pixel_size.h"

namespace pointrt {
namespace {

using Rgbe = std::array<std::uint8_t, 4>;

// pictures of other widths are never coded by component
constexpr std::uint32_t kMinCodedWidth = 8, kMaxCodedWidth = 32767;
constexpr std::size_t kMaxLineBytes = 4096;
constexpr std::size_t kPixelBytes = 3 * sizeof(float); // in a FloatImage
constexpr int kExponentBias = 128 + 8;                 // its bias, and eight bits of fraction

struct Source {
    const std::string& path;
    std::span<const std::uint8_t> bytes;
    std::size_t at = 0;

    [[noreturn]] void fail(const std::string& reason) const {
        throw Error{ExitCode::kBadInput, path + ": bad Radiance picture: " + reason};
    }
    std::uint8_t byte() {
        if (at == bytes.size()) fail("unexpected end of file");
        return bytes[at++];
    }
    Rgbe pixel() {
        Rgbe value;
        for (std::uint8_t& part : value) part = byte();
        return value;
    }
    std::string line() {
        std::string text;
        for (char c = static_cast<char>(byte()); c != '\n'; c = static_cast<char>(byte())) {
            if (text.size() == kMaxLineBytes) fail("a line of the header is too long");
            text += c;
        }
        if (!text.empty() && text.back() == '\r') text.pop_back();
        return text;
    }
};

FloatImage readHead(Source& source) {
    for (std::string line = source.line(); !line.empty(); line = source.line())
        if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe")
            source.fail("only 32-bit_rle_rgbe is supported");
    unsigned width = 0, height = 0;
    const std::string size = source.line();
    if (size.size() > 32 || std::sscanf(size.c_str(), "-Y %8u +X %8u", &height, &width) != 2)
        source.fail("only rows from top to bottom and left to right (-Y +X) are supported");
    if (width == 0 || height == 0 || width > kMaxPixelSide || height > kMaxPixelSide)
        source.fail("a side must have 1 to " + std::to_string(kMaxPixelSide) + " pixels");
    if (std::uint64_t{width} * height * kPixelBytes > pictureRoom(source.bytes.size()))
        source.fail(pictureRoomReason(width, height, source.bytes.size()));
    return {width, height, {}};
}

/// One component of a row: runs of 1 to 127 equal bytes, or 1 to 128 literal bytes.
void readComponent(Source& source, std::span<Rgbe> row, std::size_t component) {
    for (std::size_t x = 0; x < row.size();) {
        const std::uint8_t code = source.byte();
        const bool run = code > 128;
        const std::size_t count = run ? code - 128u : code;
        if (count == 0 || count > row.size() - x) source.fail("a run is too long");
        const std::uint8_t value = run ? source.byte() : 0;
        for (std::size_t i = 0; i < count; ++i) row[x++][component] = run ? value : source.byte();
    }
}

/// Pixel by pixel; 1 1 1 n repeats the last pixel n times, a second one directly after it 256 n times, and so on.
void readFlat(Source& source, std::span<Rgbe> row, Rgbe first) {
    unsigned shift = 0;
    std::size_t x = 0;
    for (Rgbe pixel = first;; pixel = source.pixel()) {
        if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
            if (x == 0 || shift > 16) source.fail("invalid run");
            const std::size_t count = std::size_t{pixel[3]} << shift;
            if (count > row.size() - x) source.fail("a run is too long");
            std::fill_n(row.begin() + static_cast<std::ptrdiff_t>(x), count, row[x - 1]);
            x += count;
            shift += 8;
        } else {
            row[x++] = pixel;
            shift = 0;
        }
        if (x == row.size()) return;
    }
}

void readRow(Source& source, std::span<Rgbe> row) {
    const Rgbe first = source.pixel();
    const bool coded = row.size() >= kMinCodedWidth && row.size() <= kMaxCodedWidth && first[0] == 2 && first[1] == 2 &&
                       first[2] < 128;
    if (!coded) return readFlat(source, row, first);
    if (first[2] * std::size_t{256} + first[3] != row.size()) source.fail("a row has a different width");
    for (std::size_t component = 0; component < 4; ++component) readComponent(source, row, component);
}

} // namespace

FloatImage readRadiance(const std::string& path) {
    const std::vector<std::uint8_t> bytes = readFileBytes(path);
    Source source{path, bytes};
    FloatImage image = readHead(source);
    std::vector<Rgbe> row(image.width);
    image.rgb.reserve(std::size_t{3} * image.width * image.height); // growing it later would need twice the memory
    for (std::uint32_t y = 0; y < image.height; ++y) {
        readRow(source, row);
        for (const Rgbe& p : row)
            for (std::size_t c = 0; c < 3; ++c)
                image.rgb.push_back(p[3] == 0 ? 0 : std::ldexp(static_cast<float>(p[c]), p[3] - kExponentBias));
    }
    return image;
}

} // namespace pointrt
