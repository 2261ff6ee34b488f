// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/ingest/zip.h"
#include "preprocess/ingest/unpack_limit.h"

#include <algorithm>
#include <limits>
#include <zlib.h>

namespace pointrt {
namespace {

constexpr std::string_view kLocalMark("PK\x03\x04", 4), kDirectoryMark("PK\x01\x02", 4), kEndMark("PK\x05\x06", 4);
constexpr std::size_t kLocalSize = 30, kDirectorySize = 46, kEndSize = 22; ///< without names and comments
constexpr std::uint32_t kStored = 0, kDeflated = 8;
constexpr std::uint32_t kZip64 = 0xffffffff; ///< in place of sizes and offsets that need 64 bits

/// The same limits as in unpackGzip.

/// A little-endian number of this many bytes.
std::uint32_t loadNumber(std::string_view bytes, std::size_t at, std::size_t size) {
    std::uint32_t number = 0;
    for (std::size_t i = size; i-- > 0;) number = number << 8 | static_cast<unsigned char>(bytes[at + i]);
    return number;
}

std::uint32_t loadWord(std::string_view bytes, std::size_t at) { return loadNumber(bytes, at, 4); }
std::uint32_t loadShort(std::string_view bytes, std::size_t at) { return loadNumber(bytes, at, 2); }

/// The record at the end of the archive, after which a comment may follow.
std::string_view endRecord(std::string_view bytes) {
    constexpr std::size_t kLongestComment = 0xffff;
    const std::size_t first = bytes.size() - std::min(bytes.size(), kEndSize + kLongestComment);
    const std::size_t at = bytes.rfind(kEndMark);
    if (at == std::string_view::npos || at < first || bytes.size() - at < kEndSize) return {};
    return bytes.substr(at);
}

/// Reads one entry of the directory and advances to the next. nullopt if it is invalid.
std::optional<ZipMember> nextMember(std::string_view bytes, std::string_view& directory) {
    if (!directory.starts_with(kDirectoryMark) || directory.size() < kDirectorySize) return std::nullopt;
    ZipMember member;
    member.encrypted = (loadShort(directory, 8) & 1) != 0;
    member.method = loadShort(directory, 10);
    member.packed_size = loadWord(directory, 20);
    member.size = loadWord(directory, 24);
    const std::size_t name_size = loadShort(directory, 28),
                      more = std::size_t{loadShort(directory, 30)} + loadShort(directory, 32);
    const std::size_t offset = loadWord(directory, 42);
    if (offset == kZip64 || offset >= bytes.size() || name_size + more > directory.size() - kDirectorySize)
        return std::nullopt;
    member.name = directory.substr(kDirectorySize, name_size);
    member.header = bytes.substr(offset);
    directory.remove_prefix(kDirectorySize + name_size + more);
    return member;
}

struct RawInflater {
    z_stream stream{};
    bool ready = inflateInit2(&stream, -15) == Z_OK; // negative: the largest window, without a wrapper
    RawInflater() = default;
    RawInflater(const RawInflater&) = delete;
    RawInflater& operator=(const RawInflater&) = delete;
    ~RawInflater() { inflateEnd(&stream); }
};

/// Whether the packed bytes fill `unpacked` exactly. Both are below 4 GiB.
bool inflateInto(std::string_view packed, std::string& unpacked) {
    RawInflater inflater;
    if (!inflater.ready) throw std::bad_alloc();
    z_stream& stream = inflater.stream;
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream.avail_in = static_cast<uInt>(packed.size());
    stream.next_out = reinterpret_cast<Bytef*>(unpacked.data());
    stream.avail_out = static_cast<uInt>(unpacked.size());
    return inflate(&stream, Z_FINISH) == Z_STREAM_END && stream.avail_out == 0;
}

/// The packed bytes, which follow the local header.
std::string_view packedBytes(const InputFile& input, const ZipMember& member) {
    const std::string_view local = member.header;
    if (!local.starts_with(kLocalMark) || local.size() < kLocalSize)
        refuse(input, "is invalid: the zip directory points elsewhere");
    const std::size_t start = kLocalSize + loadShort(local, 26) + loadShort(local, 28);
    if (start > local.size() || member.packed_size > local.size() - start) refuse(input, "the zip data is truncated");
    return local.substr(start, member.packed_size);
}

} // namespace

bool isZip(std::string_view bytes) { return bytes.starts_with(kLocalMark); }

std::string_view firstZipMember(std::string_view bytes) {
    if (!isZip(bytes) || bytes.size() < kLocalSize) return {};
    return bytes.substr(kLocalSize, loadShort(bytes, 26));
}

std::optional<std::vector<ZipMember>> zipMembers(std::string_view bytes) {
    const std::string_view end = endRecord(bytes);
    if (end.empty()) return std::nullopt;
    const std::size_t count = loadShort(end, 10), offset = loadWord(end, 16);
    if (offset > bytes.size()) return std::nullopt;
    std::string_view directory = bytes.substr(offset);
    std::vector<ZipMember> members;
    for (std::size_t i = 0; i < count; ++i) {
        const std::optional<ZipMember> member = nextMember(bytes, directory);
        if (!member) return std::nullopt;
        members.push_back(*member);
    }
    return members;
}

InputFile openZipMember(const InputFile& archive, const ZipMember& member) {
    InputFile input;
    input.name = fmt::format("{}: {}", archive.name, inQuotes(member.name));
    if (member.encrypted) refuse(input, "is encrypted; unpack the archive first");
    if (member.method != kStored && member.method != kDeflated)
        refuse(input, fmt::format("is packed with zip method {}; this build reads 0 and 8", member.method));
    const std::string_view packed = packedBytes(input, member);
    if (member.method == kStored) {
        input.bytes = packed;
        input.owner = archive.owner;
        return input;
    }
    if (member.size > mostUnpacked(packed.size()))
        refuse(input, "unpacks to more than 100 times its size, which scans do not; if it is a scan, unpack it first");
    auto unpacked = std::make_shared<std::string>(member.size, '\0');
    if (!inflateInto(packed, *unpacked)) refuse(input, "the zip data is invalid");
    input.bytes = *unpacked;
    input.owner = std::move(unpacked);
    return input;
}

} // namespace pointrt
