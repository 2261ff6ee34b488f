// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/ingest/gzip.h"
#include "preprocess/ingest/unpack_limit.h"

#include <algorithm>
#include <limits>
#include <zlib.h>

namespace pointrt {
namespace {

/// Deflate expands a byte to at most 1032. Scans compress 3 to 20 times, binary depth frames that are mostly holes
/// about 50 times: the limits allow twice that and any small file, but nothing that must be unpacked on disk first.
constexpr std::size_t kLargestUnpacked = std::size_t{8} << 30;
constexpr std::size_t kUnpackedBlock = std::size_t{1} << 20;

struct Inflater {
    z_stream stream{};
    /// 15 is the largest window, 16 more selects the gzip wrapper.
    bool ready = inflateInit2(&stream, 15 + 16) == Z_OK;
    ~Inflater() { inflateEnd(&stream); }
};

void feed(z_stream& stream, std::string_view& rest) {
    if (stream.avail_in > 0) return;
    const std::size_t share = std::min<std::size_t>(rest.size(), std::numeric_limits<uInt>::max());
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(rest.data()));
    stream.avail_in = static_cast<uInt>(share);
    rest.remove_prefix(share);
}

int inflateBlock(z_stream& stream, std::string& unpacked) {
    const std::size_t used = unpacked.size();
    unpacked.resize(used + kUnpackedBlock);
    stream.next_out = reinterpret_cast<Bytef*>(unpacked.data() + used);
    stream.avail_out = static_cast<uInt>(kUnpackedBlock);
    const int result = inflate(&stream, Z_NO_FLUSH);
    unpacked.erase(unpacked.size() - stream.avail_out);
    return result;
}

/// Whether another gzip member follows; anything else after the end is padding.
bool anotherMember(const z_stream& stream) {
    return stream.avail_in >= 2 && stream.next_in[0] == 0x1f && stream.next_in[1] == 0x8b;
}

void checkSize(const InputFile& input, std::size_t unpacked) {
    if (unpacked > kLargestUnpacked) refuse(input, "unpacks to more than 8 GiB; unpack it first");
    if (unpacked > mostUnpacked(input.bytes.size()))
        refuse(input, "unpacks to more than 100 times its size, which scans do not; if it is a scan, unpack it first");
}

} // namespace

bool isGzip(std::string_view bytes) { return bytes.size() >= 2 && bytes[0] == '\x1f' && bytes[1] == '\x8b'; }

void unpackGzip(InputFile& input) {
    Inflater inflater;
    if (!inflater.ready) throw std::bad_alloc();
    auto unpacked = std::make_shared<std::string>();
    std::string_view rest = input.bytes;
    for (;;) {
        feed(inflater.stream, rest);
        const int result = inflateBlock(inflater.stream, *unpacked);
        checkSize(input, unpacked->size());
        if (result == Z_STREAM_END) {
            if (!anotherMember(inflater.stream)) break;
            inflateReset(&inflater.stream);
        } else if (result == Z_BUF_ERROR) {
            refuse(input, "the gzip data is truncated");
        } else if (result != Z_OK) {
            refuse(input, "the gzip data is invalid");
        }
    }
    input.bytes = *unpacked;
    input.owner = std::move(unpacked);
    input.mapped = false;
}

} // namespace pointrt
