// SPDX-License-Identifier: GPL-3.0-or-later
// As Niantic's library writes them: https://github.com/nianticlabs/spz
#include "preprocess/input/spz_streams.h"

#include <cstring>
#include <zstd.h>

namespace pointrt {
namespace {

constexpr std::uint32_t kPacked = 4; // the version since which arrays are packed one by one, with zstd

/// The start of a file of any version.
struct Start {
    std::uint32_t magic, version, count;
    std::uint8_t harmonics_degree, fractional_bits, flags;
    std::uint8_t streams; ///< since kPacked
};
static_assert(sizeof(Start) == 16);

/// Since kPacked: where the table of streams is, and bytes that mean nothing yet.
constexpr std::size_t kPackedHeader = 32;

/// Of the table: the sizes of a stream in the file and unpacked.
struct Entry {
    std::uint64_t packed_size, size;
};

/// Deflate makes 1032 bytes of one at most, zstd more; files of splats are packed ten times.
constexpr std::uint64_t kUnpackedPerByte = 100, kUnpackedAtLeast = std::uint64_t{64} << 20;

template <typename Value>
Value loadValue(const Source& source, std::size_t offset) {
    if (source.bytes.size() < sizeof(Value) || offset > source.bytes.size() - sizeof(Value))
        refuse(source, "the SPZ header is cut short");
    Value value;
    std::memcpy(&value, source.bytes.data() + offset, sizeof value);
    return value;
}

std::uint64_t bytesOfSplat(const SpzFile& file) {
    std::uint64_t bytes = 0;
    for (int i = 0; i < kSpzArrayCount; ++i) bytes += file.bytesEach(static_cast<SpzArray>(i));
    return bytes;
}

[[noreturn]] void refuseCut(const Source& source, const SpzFile& file) {
    refuse(source, fmt::format("cut short: the header promises {} Gaussian splats, {} bytes are there", file.count,
                               source.bytes.size()));
}

/// Arrays one after the other.
void sliceArrays(const Source& source, SpzFile& file) {
    std::string_view rest = source.bytes.substr(sizeof(Start));
    if (file.count > rest.size() / bytesOfSplat(file)) refuseCut(source, file);
    for (int i = 0; i < kSpzArrayCount; ++i) {
        const std::size_t size = file.count * file.bytesEach(static_cast<SpzArray>(i));
        file.arrays[i] = rest.substr(0, size);
        rest.remove_prefix(size);
    }
}

void unpack(const Source& source, std::string_view packed, std::size_t size, std::string& into) {
    into.resize(size);
    const std::size_t got = ZSTD_decompress(into.data(), size, packed.data(), packed.size());
    if (ZSTD_isError(got) || got != size) refuse(source, "the zstd data is broken");
}

void unpackArrays(const Source& source, std::size_t streams, SpzFile& file) {
    if (file.count > (kUnpackedAtLeast + kUnpackedPerByte * source.bytes.size()) / bytesOfSplat(file))
        refuse(source,
               fmt::format("the header promises {} Gaussian splats in {} bytes", file.count, source.bytes.size()));
    if (streams < kSpzArrayCount)
        refuse(source, fmt::format("has {} streams, {} are needed", streams, +kSpzArrayCount));
    const std::size_t table = loadValue<std::uint32_t>(source, sizeof(Start));
    std::size_t at = table + streams * sizeof(Entry);
    if (table < kPackedHeader || at > source.bytes.size()) refuse(source, "the table of streams lies outside the file");
    for (int i = 0; i < kSpzArrayCount; ++i) {
        const Entry entry = loadValue<Entry>(source, table + static_cast<std::size_t>(i) * sizeof(Entry));
        const std::size_t size = file.count * file.bytesEach(static_cast<SpzArray>(i));
        if (entry.packed_size > source.bytes.size() - at) refuseCut(source, file);
        if (entry.size != size)
            refuse(source,
                   fmt::format("stream {} has {} bytes, {} Gaussian splats have {}", i, entry.size, file.count, size));
        unpack(source, source.bytes.substr(at, entry.packed_size), size, file.unpacked[i]);
        file.arrays[i] = file.unpacked[i];
        at += entry.packed_size;
    }
}

} // namespace

std::size_t SpzFile::bytesEach(SpzArray array) const {
    switch (array) {
    case kSpzPositions:
        return version == 1 ? 6 : 9; // three halves, or three times 24 bits
    case kSpzAlphas:
        return 1;
    case kSpzRotations:
        return version < 3 ? 3 : 4;
    default:
        return 3;
    }
}

SpzFile openSpz(const Source& source) {
    const Start start = loadValue<Start>(source, 0);
    if (!source.bytes.starts_with("NGSP")) refuse(source, "does not start with 'NGSP', as SPZ files do once unpacked");
    if (start.version < 1 || start.version > kPacked)
        refuse(source,
               fmt::format("is of version {}; this build reads versions 1 to {} of SPZ", start.version, kPacked));
    if (start.count == 0) refuse(source, "holds no points");
    if (start.fractional_bits > 23) // of the 24 of a coordinate, one is the sign
        refuse(source,
               fmt::format("coordinates of 24 bits cannot have {} of them behind the point", start.fractional_bits));
    SpzFile file;
    file.version = start.version;
    file.count = start.count;
    file.harmonics_degree = start.harmonics_degree;
    file.fractional_bits = start.fractional_bits;
    if (start.version < kPacked)
        sliceArrays(source, file);
    else
        unpackArrays(source, start.streams, file);
    return file;
}

} // namespace pointrt
