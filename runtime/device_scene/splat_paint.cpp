// SPDX-License-Identifier: Apache-2.0
#include "runtime/device_scene/splat_paint.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "format/base/parallel.h"
#include "pointrt/pro.h"

namespace pointrt {
namespace {

/// Splats per block, so that their numbers stay in the L1 cache.
constexpr std::size_t kBlock = 1024;

using Numbers = std::array<double, kBlock>;

/// Consecutive splats, as in the file and painted.
struct Block {
    const std::uint32_t* file_words; ///< of the block's first splat and the following ones
    std::size_t first, count;
    std::uint32_t* painted;
};

Srgb8 colorOf(std::uint32_t word) {
    return {static_cast<std::uint8_t>(word), static_cast<std::uint8_t>(word >> 8),
            static_cast<std::uint8_t>(word >> 16)};
}

void setColor(std::uint32_t* splat, Srgb8 color) {
    splat[3] = (splat[3] & ~PRO_COLOR_MASK) | color[0] | color[1] << 8 | color[2] << 16;
}

void setRow(std::uint32_t* splat, std::uint32_t row) {
    constexpr std::uint32_t kRest = (1u << PRO_MATERIAL_SHIFT) - 1;
    splat[2] = (splat[2] & kRest) | row << PRO_MATERIAL_SHIFT;
}

std::uint32_t rowOfFile(const Block& block, std::size_t i) {
    return block.file_words[i * PRO_SPLAT_WORDS + 2] >> PRO_MATERIAL_SHIFT;
}

void paintColors(std::monostate, const Block&) {}

void paintColors(const NumberColors& colors, const Block& block) {
    Numbers numbers;
    if (colors.numbers)
        readNumbers(*colors.numbers, block.first, std::span(numbers).first(block.count));
    else
        numbers.fill(std::nan(""));
    for (std::size_t i = 0; i < block.count; ++i)
        setColor(block.painted + i * PRO_SPLAT_WORDS, colors.scale(numbers[i]));
}

std::uint8_t byteOf(double component) { return static_cast<std::uint8_t>(std::lround(127.5 * (component + 1))); }

void paintColors(const NormalColors& colors, const Block& block) {
    for (std::size_t i = 0; i < block.count; ++i) {
        pro_splat splat;
        pro_splat_decode(block.file_words + i * PRO_SPLAT_WORDS, 1, 0, &splat);
        const Vec3 normal{splat.normal[0], splat.normal[1], splat.normal[2]};
        Srgb8 color;
        for (std::size_t c = 0; c < 3; ++c) color[c] = byteOf(std::clamp(dot(colors.rotation[c], normal), -1.0, 1.0));
        setColor(block.painted + i * PRO_SPLAT_WORDS, color);
    }
}

void paintRows(const SplatOverride::OfRow& of, std::uint8_t, const Block& block) {
    for (std::size_t i = 0; i < block.count; ++i)
        if (rowOfFile(block, i) == of.row) setRow(block.painted + i * PRO_SPLAT_WORDS, of.row);
}

void paintRows(const SplatOverride::OfColors& of, std::uint8_t row, const Block& block) {
    for (std::size_t i = 0; i < block.count; ++i) {
        const Srgb8 color = colorOf(block.file_words[i * PRO_SPLAT_WORDS + 3]);
        bool is_between = true;
        for (std::size_t c = 0; c < 3; ++c) is_between &= of.low[c] <= color[c] && color[c] <= of.high[c];
        if (is_between) setRow(block.painted + i * PRO_SPLAT_WORDS, row);
    }
}

void paintRows(const SplatOverride::OfNumbers& of, std::uint8_t row, const Block& block) {
    Numbers numbers;
    readNumbers(of.numbers, block.first, std::span(numbers).first(block.count));
    for (std::size_t i = 0; i < block.count; ++i) {
        if (holdsNumber(of.ranges, numbers[i])) setRow(block.painted + i * PRO_SPLAT_WORDS, row);
    }
}

void paintBlock(const SplatPaint& paint, const Block& block) {
    std::copy_n(block.file_words, block.count * PRO_SPLAT_WORDS, block.painted);
    std::visit([&](const auto& colors) { paintColors(colors, block); }, paint.colors);
    for (const SplatOverride& each : paint.overrides)
        std::visit([&](const auto& of) { paintRows(of, each.row, block); }, each.splats);
}

} // namespace

void paintSplats(const SplatPaint& paint, const std::uint32_t* file_words, std::size_t first,
                 std::span<std::uint32_t> painted) {
    const std::size_t count = painted.size() / PRO_SPLAT_WORDS;
    forAll((count + kBlock - 1) / kBlock, [&](std::size_t k) {
        const std::size_t at = k * kBlock;
        paintBlock(paint, {file_words + (first + at) * PRO_SPLAT_WORDS, first + at, std::min(kBlock, count - at),
                           &painted[at * PRO_SPLAT_WORDS]});
    });
}

} // namespace pointrt
