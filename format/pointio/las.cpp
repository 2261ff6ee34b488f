// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/las.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "format/pointio/bytes.h"

namespace pointrt {
namespace {

// Offsets in the header.
constexpr std::size_t kGlobalEncoding = 6, kMajor = 24, kMinor = 25, kHeaderBytes = 94, kPointOffset = 96,
                      kVlrCount = 100, kPointFormat = 104, kRecordBytes = 105, kLegacyCount = 107, kScale = 131,
                      kOffset = 155, kEvlrOffset = 235, kEvlrCount = 243, kCount = 247;
/// Header sizes of versions up to 1.2, and of 1.4.
constexpr std::size_t kShortHeader = 227, kLongHeader = 375;
constexpr std::uint8_t kPackedBit = 0x80;

constexpr std::uint16_t kRecordBytesOf[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

/// The 64-bit count of LAS 1.4; otherwise, or if that is 0, the 32-bit one.
std::uint64_t countOf(std::string_view bytes, bool is_long) {
    const std::uint64_t count = is_long ? loadAt<std::uint64_t>(bytes, kCount) : 0;
    return count > 0 ? count : loadAt<std::uint32_t>(bytes, kLegacyCount);
}

void checkNumbers(const LasHeader& header, std::uint8_t format_bits) {
    if (header.version_major != 1 || header.version_minor > 5)
        refuseFile(
            fmt::format("is LAS {}.{}; versions 1.0 to 1.5 are supported", header.version_major, header.version_minor));
    if ((format_bits & ~kPackedBit) >= std::size(kRecordBytesOf))
        refuseFile(fmt::format("has point format {}; 0 to {} are supported", format_bits & ~kPackedBit,
                               std::size(kRecordBytesOf) - 1));
    if (header.header_bytes < kShortHeader)
        refuseFile(fmt::format("has a header of {} bytes; LAS has {}", header.header_bytes, kShortHeader));
    if (header.record_bytes < lasRecordBytes(header.point_format))
        refuseFile(fmt::format("has {} bytes a point; format {} has {}", header.record_bytes, header.point_format,
                               lasRecordBytes(header.point_format)));
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (!std::isfinite(header.scale[axis]) || header.scale[axis] == 0 || !std::isfinite(header.offset[axis]))
            refuseFile("the coordinate scale in the header is 0 or not finite");
}

/// Reads up to count records, starting at byte at. False if the file ends before.
bool readVlrs(LasFile& file, std::uint64_t at, std::uint64_t count, bool extended) {
    const std::uint64_t head = extended ? 60 : 54;
    for (std::uint64_t i = 0; i < count; ++i) {
        if (!liesIn(at, head, file.bytes.size())) return false;
        const std::string_view record = file.bytes.substr(at, head);
        const std::uint64_t size = extended ? loadAt<std::uint64_t>(record, 20) : loadAt<std::uint16_t>(record, 20);
        if (!liesIn(at + head, size, file.bytes.size())) return false;
        file.vlrs.push_back({fieldText(record.substr(2, 16)), fieldText(record.substr(head - 32)),
                             loadAt<std::uint16_t>(record, 18), extended, file.bytes.substr(at + head, size)});
        at += head + size;
    }
    return true;
}

/// Some writers never fill in the count. Then the points end where extended records begin.
void takeUncounted(LasFile& file) {
    LasHeader& header = file.header;
    if (header.point_count > 0 || header.packed || header.point_offset >= file.bytes.size()) return;
    const bool extended = header.evlr_count > 0 && header.evlr_offset > header.point_offset;
    const std::uint64_t end =
        extended ? std::min<std::uint64_t>(header.evlr_offset, file.bytes.size()) : file.bytes.size();
    header.point_count = (end - header.point_offset) / header.record_bytes;
    if (header.point_count > 0)
        file.notes.push_back(
            fmt::format("says 0 points in its header; the {} points that follow are read", header.point_count));
}

void checkPoints(LasFile& file, bool salvages) {
    LasHeader& header = file.header;
    if (header.point_offset < kShortHeader || header.point_offset > file.bytes.size())
        refuseFile(
            fmt::format("points start at byte {}, but the file has {} bytes", header.point_offset, file.bytes.size()));
    takeUncounted(file);
    const std::uint64_t room = (file.bytes.size() - header.point_offset) / header.record_bytes;
    if (!header.packed && header.point_count > room && salvages) {
        file.promised = header.point_count;
        header.point_count = room;
    }
    if (!header.packed && header.point_count > room)
        refuseFile(fmt::format("promises {} points, but has room for only {}{}", header.point_count, room,
                               room > 0 ? "; --salvage reads these" : ""));
}

} // namespace

LasHeader readLasHeader(std::string_view bytes) {
    if (!bytes.starts_with("LASF")) refuseFile("is not a LAS file");
    if (bytes.size() < kShortHeader) refuseFile("ends within the header");
    LasHeader header;
    header.global_encoding = loadAt<std::uint16_t>(bytes, kGlobalEncoding);
    header.version_major = loadAt<std::uint8_t>(bytes, kMajor);
    header.version_minor = loadAt<std::uint8_t>(bytes, kMinor);
    header.header_bytes = loadAt<std::uint16_t>(bytes, kHeaderBytes);
    header.point_offset = loadAt<std::uint32_t>(bytes, kPointOffset);
    header.vlr_count = loadAt<std::uint32_t>(bytes, kVlrCount);
    const auto format_bits = loadAt<std::uint8_t>(bytes, kPointFormat);
    header.packed = (format_bits & kPackedBit) != 0;
    header.point_format = format_bits & ~kPackedBit;
    header.record_bytes = loadAt<std::uint16_t>(bytes, kRecordBytes);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        header.scale[axis] = loadAt<double>(bytes, kScale + 8 * axis);
        header.offset[axis] = loadAt<double>(bytes, kOffset + 8 * axis);
    }
    checkNumbers(header, format_bits);
    const bool is_long = header.version_minor >= 4 && header.header_bytes >= kLongHeader;
    if (is_long && bytes.size() < kLongHeader) refuseFile("ends within the header");
    header.point_count = countOf(bytes, is_long);
    if (is_long) {
        header.evlr_offset = loadAt<std::uint64_t>(bytes, kEvlrOffset);
        header.evlr_count = loadAt<std::uint32_t>(bytes, kEvlrCount);
    }
    return header;
}

std::uint16_t lasRecordBytes(std::uint8_t point_format) { return kRecordBytesOf[point_format]; }

LasFile openLas(std::string_view bytes, bool salvages) {
    LasFile file{bytes, readLasHeader(bytes), {}, {}, 0};
    if (!readVlrs(file, file.header.header_bytes, file.header.vlr_count, false) ||
        !readVlrs(file, file.header.evlr_offset, file.header.evlr_count, true))
        file.notes.push_back("announces more variable-length records than it holds; the missing ones are ignored");
    checkPoints(file, salvages);
    return file;
}

const LasVlr* findVlr(const LasFile& file, std::string_view user_id, std::uint16_t record_id) {
    for (const LasVlr& vlr : file.vlrs)
        if (vlr.user_id == user_id && vlr.record_id == record_id) return &vlr;
    return nullptr;
}

} // namespace pointrt
