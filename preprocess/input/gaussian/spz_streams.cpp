// SPDX-License-Identifier: GPL-3.0-or-later
// The format of Niantic's library: https://github.com/nianticlabs/spz
#include "preprocess/input/gaussian/spz_streams.h"
#include "preprocess/ingest/unpack_limit.h"

#include <cstring>
#include <zstd.h>

namespace pointrt {
namespace {

constexpr std::uint32_t kPacked = 4; // from this version on arrays are compressed one by one with zstd

constexpr int kMostDegree = 4; // of the harmonics

/// The header of a file of any version.
struct Start {
    std::uint32_t magic, version, count;
    std::uint8_t harmonics_degree, fractional_bits, flags;
    std::uint8_t streams; ///< from version kPacked on
};
static_assert(sizeof(Start) == 16);

/// From version kPacked on: offset of the table of streams, and reserved bytes.
constexpr std::size_t kPackedHeader = 32;

/// Table entry: compressed and uncompressed size of a stream.
struct Entry {
    std::uint64_t packed_size, size;
};

template <typename Value>
Value loadValue(const InputFile& input, std::size_t offset) {
    if (input.bytes.size() < sizeof(Value) || offset > input.bytes.size() - sizeof(Value))
        refuse(input, "the SPZ header is truncated");
    Value value;
    std::memcpy(&value, input.bytes.data() + offset, sizeof value);
    return value;
}

std::uint64_t bytesOfSplat(const SpzFile& file) {
    std::uint64_t bytes = 0;
    for (int i = 0; i < kSpzArrayCount; ++i) bytes += file.bytesEach(static_cast<SpzArray>(i));
    return bytes;
}

[[noreturn]] void refuseCut(const InputFile& input, const SpzFile& file) {
    refuse(input, fmt::format("truncated: the header promises {} Gaussian splats, {} bytes are there", file.count,
                              input.bytes.size()));
}

/// Uncompressed arrays, one after the other.
void sliceArrays(const InputFile& input, SpzFile& file) {
    std::string_view rest = input.bytes.substr(sizeof(Start));
    if (file.count > rest.size() / bytesOfSplat(file)) refuseCut(input, file);
    for (int i = 0; i < kSpzArrayCount; ++i) {
        const std::size_t size = file.count * file.bytesEach(static_cast<SpzArray>(i));
        file.arrays[i] = rest.substr(0, size);
        rest.remove_prefix(size);
    }
}

void unpack(const InputFile& input, std::string_view packed, std::size_t size, std::string& into) {
    into.resize(size);
    const std::size_t got = ZSTD_decompress(into.data(), size, packed.data(), packed.size());
    if (ZSTD_isError(got) || got != size) refuse(input, "the zstd data is invalid");
}

void unpackArrays(const InputFile& input, std::size_t streams, SpzFile& file) {
    if (file.count > mostUnpacked(input.bytes.size()) / bytesOfSplat(file))
        refuse(input,
               fmt::format("the header promises {} Gaussian splats in {} bytes", file.count, input.bytes.size()));
    const int needed = file.harmonics_degree > 0 ? kSpzArrayCount : kSpzHarmonics;
    if (streams < static_cast<std::size_t>(needed))
        refuse(input, fmt::format("has {} streams, but {} are needed", streams, needed));
    const std::size_t table = loadValue<std::uint32_t>(input, sizeof(Start));
    std::size_t at = table + streams * sizeof(Entry);
    if (table < kPackedHeader || at > input.bytes.size()) refuse(input, "the table of streams lies outside the file");
    for (int i = 0; i < needed; ++i) {
        const Entry entry = loadValue<Entry>(input, table + static_cast<std::size_t>(i) * sizeof(Entry));
        const std::size_t size = file.count * file.bytesEach(static_cast<SpzArray>(i));
        if (entry.packed_size > input.bytes.size() - at) refuseCut(input, file);
        if (entry.size != size)
            refuse(input, fmt::format("stream {} has {} bytes, but {} Gaussian splats need {}", i, entry.size,
                                      file.count, size));
        unpack(input, input.bytes.substr(at, entry.packed_size), size, file.unpacked[i]);
        file.arrays[i] = file.unpacked[i];
        at += entry.packed_size;
    }
}

} // namespace

std::size_t SpzFile::bytesEach(SpzArray array) const {
    switch (array) {
    case kSpzPositions:
        return version == 1 ? 6 : 9; // three half floats, or three times 24 bits
    case kSpzAlphas:
        return 1;
    case kSpzRotations:
        return version < 3 ? 3 : 4;
    case kSpzHarmonics:
        return 3 *
               (static_cast<std::size_t>(harmonics_degree + 1) * static_cast<std::size_t>(harmonics_degree + 1) - 1);
    default:
        return 3;
    }
}

SpzFile openSpz(const InputFile& input) {
    const Start start = loadValue<Start>(input, 0);
    if (!input.bytes.starts_with("NGSP"))
        refuse(input, "does not start with 'NGSP' after decompression, as SPZ files do");
    if (start.version < 1 || start.version > kPacked)
        refuse(input, fmt::format("has version {}; this build reads SPZ versions 1 to {}", start.version, kPacked));
    if (start.count == 0) refuse(input, "holds no points");
    if (start.fractional_bits > 23) // of the 24 of a coordinate, one is the sign
        refuse(input, fmt::format("coordinates of 24 bits cannot have {} fractional bits", start.fractional_bits));
    if (start.harmonics_degree > kMostDegree)
        refuse(input, fmt::format("has spherical harmonics of degree {}; SPZ files have up to {}",
                                  start.harmonics_degree, kMostDegree));
    SpzFile file;
    file.version = start.version;
    file.count = start.count;
    file.harmonics_degree = start.harmonics_degree;
    file.fractional_bits = start.fractional_bits;
    if (start.version < kPacked)
        sliceArrays(input, file);
    else
        unpackArrays(input, start.streams, file);
    return file;
}

} // namespace pointrt
