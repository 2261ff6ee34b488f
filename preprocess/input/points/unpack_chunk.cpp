// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/points/unpack_chunk.h"
#include "preprocess/ingest/unpack_limit.h"

#include <algorithm>
#include <bzlib.h>
#include <lz4frame.h>
#include <memory>
#include <zstd.h>

namespace pointrt {
namespace {

bool unpackLz4(std::string_view packed, std::string& unpacked) {
    LZ4F_dctx* made = nullptr;
    if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION))) throw std::bad_alloc();
    const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(made,
                                                                                       LZ4F_freeDecompressionContext);
    std::size_t done = 0;
    while (!packed.empty()) {
        std::size_t room = unpacked.size() - done, taken = packed.size();
        const std::size_t hint =
            LZ4F_decompress(context.get(), unpacked.data() + done, &room, packed.data(), &taken, nullptr);
        if (LZ4F_isError(hint) || (room == 0 && taken == 0)) return false;
        done += room;
        packed.remove_prefix(taken);
        if (hint == 0) break; // the frame is complete
    }
    return done == unpacked.size();
}

bool unpackBzip2(std::string_view packed, std::string& unpacked) {
    auto size = static_cast<unsigned>(unpacked.size()); // of a chunk of a bag: 32 bits
    const int code = BZ2_bzBuffToBuffDecompress(unpacked.data(), &size, const_cast<char*>(packed.data()),
                                                static_cast<unsigned>(packed.size()), 0, 0);
    return code == BZ_OK && size == unpacked.size();
}

bool unpackZstd(std::string_view packed, std::string& unpacked) {
    return ZSTD_decompress(unpacked.data(), unpacked.size(), packed.data(), packed.size()) == unpacked.size();
}

constexpr struct {
    std::string_view name;
    bool (*unpack)(std::string_view packed, std::string& unpacked);
} kCompressions[] = {{"lz4", unpackLz4}, {"zstd", unpackZstd}, {"bz2", unpackBzip2}};

} // namespace

std::string unpackChunk(const InputFile& input, std::string_view compression, std::string_view packed,
                        std::uint64_t size) {
    const auto* const known = std::find_if(std::begin(kCompressions), std::end(kCompressions),
                                           [&](const auto& each) { return each.name == compression; });
    if (known == std::end(kCompressions))
        refuse(input,
               fmt::format("has chunks compressed with {}; this build reads lz4, zstd and bz2: recompress it, for "
                           "example with 'rosbag compress --lz4' or 'mcap compress'",
                           inQuotes(compression)));
    if (size > mostUnpacked(packed.size()))
        refuse(input, fmt::format("a chunk of {} bytes promises {} unpacked ones", packed.size(), size));
    std::string unpacked(size, '\0');
    if (!known->unpack(packed, unpacked)) refuse(input, fmt::format("the {} data of a chunk is invalid", compression));
    return unpacked;
}

std::uint64_t zstdSize(const InputFile& input) {
    const unsigned long long size = ZSTD_getFrameContentSize(input.bytes.data(), input.bytes.size());
    if (size == ZSTD_CONTENTSIZE_UNKNOWN || size == ZSTD_CONTENTSIZE_ERROR)
        refuse(input, "is not zstd data that states its size");
    return size;
}

} // namespace pointrt
