// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/gzip.h"

#include <algorithm>
#include <limits>
#include <zlib.h>

namespace pointrt {
namespace {

/// Deflate makes up to 1032 bytes of one. Scans are packed 3 to 20 times as dense, binary depth frames that are mostly
/// holes some 50 times: room for twice that, any small file, and nothing that has to be unpacked on disk first.
constexpr std::size_t kUnpackedAtLeast = std::size_t{64} << 20, kUnpackedPerByte = 100;
constexpr std::size_t kLargestUnpacked = std::size_t{8} << 30;
constexpr std::size_t kBlock = std::size_t{1} << 20;

struct Inflater {
    z_stream stream{};
    /// 15 is the largest window, 16 more asks for the gzip wrapper.
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
    unpacked.resize(used + kBlock);
    stream.next_out = reinterpret_cast<Bytef*>(unpacked.data() + used);
    stream.avail_out = static_cast<uInt>(kBlock);
    const int result = inflate(&stream, Z_NO_FLUSH);
    unpacked.erase(unpacked.size() - stream.avail_out);
    return result;
}

/// True where another gzip member follows; anything else after the end is padding.
bool anotherMember(const z_stream& stream) {
    return stream.avail_in >= 2 && stream.next_in[0] == 0x1f && stream.next_in[1] == 0x8b;
}

void checkSize(const Source& source, std::size_t unpacked) {
    if (unpacked > kLargestUnpacked) refuse(source, "unpacks to more than 8 GiB: unpack it first");
    if (unpacked > kUnpackedAtLeast + kUnpackedPerByte * source.bytes.size())
        refuse(source, "unpacks to more than 100 times its size, as scans do not: unpack it first where it is one");
}

} // namespace

bool isGzip(std::string_view bytes) { return bytes.size() >= 2 && bytes[0] == '\x1f' && bytes[1] == '\x8b'; }

void unpackGzip(Source& source) {
    Inflater inflater;
    if (!inflater.ready) throw std::bad_alloc();
    auto unpacked = std::make_shared<std::string>();
    std::string_view rest = source.bytes;
    for (;;) {
        feed(inflater.stream, rest);
        const int result = inflateBlock(inflater.stream, *unpacked);
        checkSize(source, unpacked->size());
        if (result == Z_STREAM_END) {
            if (!anotherMember(inflater.stream)) break;
            inflateReset(&inflater.stream);
        } else if (result == Z_BUF_ERROR) {
            refuse(source, "the gzip data is cut short");
        } else if (result != Z_OK) {
            refuse(source, "the gzip data is broken");
        }
    }
    source.bytes = *unpacked;
    source.owner = std::move(unpacked);
    source.mapped = false;
}

} // namespace pointrt
