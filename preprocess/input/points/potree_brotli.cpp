// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/points/potree_brotli.h"

#include <array>
#include <brotli/decode.h>
#include <cstring>

#include "preprocess/cloud/morton.h"

namespace pointrt {
namespace {

constexpr std::size_t kMortonWord = 8; // bytes: 16 bits of each of three numbers

/// Bytes of a value before compression. Positions are two Morton codes, of the high and the low 16 bits; colours are a
/// single one.
std::size_t packedSize(const PotreeColumn& column) {
    if (column.kind == PotreeKind::kPosition) return 2 * kMortonWord;
    return column.kind == PotreeKind::kColor ? kMortonWord : column.size;
}

std::array<std::uint32_t, 3> threeAt(const char* at) {
    std::uint64_t code = 0;
    std::memcpy(&code, at, sizeof code);
    return {collectBits(code), collectBits(code >> 1), collectBits(code >> 2)};
}

void unpackPosition(const char* from, char* into) {
    const auto high = threeAt(from), low = threeAt(from + kMortonWord);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::uint32_t value = high[axis] << 16 | (low[axis] & 0xffff);
        std::memcpy(into + axis * sizeof value, &value, sizeof value);
    }
}

void unpackColor(const char* from, char* into) {
    const auto values = threeAt(from);
    for (std::size_t i = 0; i < 3; ++i) {
        const auto value = static_cast<std::uint16_t>(values[i]);
        std::memcpy(into + i * sizeof value, &value, sizeof value);
    }
}

void unpackValue(const PotreeColumn& column, const char* from, char* into) {
    if (column.kind == PotreeKind::kPosition)
        unpackPosition(from, into);
    else if (column.kind == PotreeKind::kColor)
        unpackColor(from, into);
    else
        std::memcpy(into, from, column.size);
}

} // namespace

std::string unpackPotreeNode(const InputFile& file, std::string_view packed, std::span<const PotreeColumn> columns,
                             std::size_t record_bytes, std::uint64_t points) {
    std::size_t row = 0;
    for (const PotreeColumn& column : columns) row += packedSize(column);
    std::string values(row * points, '\0');
    std::size_t size = values.size();
    const bool good =
        BrotliDecoderDecompress(packed.size(), reinterpret_cast<const std::uint8_t*>(packed.data()), &size,
                                reinterpret_cast<std::uint8_t*>(values.data())) == BROTLI_DECODER_RESULT_SUCCESS &&
        size == values.size();
    if (!good) refuse(file, fmt::format("the Brotli data of a node of {} points is invalid", points));
    std::string records(record_bytes * points, '\0');
    const char* from = values.data();
    for (const PotreeColumn& column : columns) // all values of one column, then those of the next
        for (std::uint64_t i = 0; i < points; ++i, from += packedSize(column))
            unpackValue(column, from, records.data() + i * record_bytes + column.at);
    return records;
}

} // namespace pointrt
