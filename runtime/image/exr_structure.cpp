// SPDX-License-Identifier: Apache-2.0
#include "runtime/image/exr_structure.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "format/base/error.h"
#include "format/base/printable.h"
#include "runtime/util/pixel_size.h"

namespace pointrt {
namespace {

using ByteSpan = std::span<const std::uint8_t>;

constexpr std::uint32_t kLongNames = 0x400;  // the only flag that single-part scan-line files may have
constexpr std::size_t kMaxAttributes = 1000; // tinyexr stops at 1024
constexpr std::size_t kLongestName = 255;
constexpr std::size_t kMaxChannels = 64;
constexpr std::uint64_t kMaxDecodedBytes = std::uint64_t{4} << 30;
constexpr std::int32_t kMaxCoordinate = 1 << 20; // tinyexr rejects line numbers above twice that
// Deflate, the densest coding, expands at most 1032-fold; a little more for the head of a block.
constexpr std::uint64_t kMaxExpansion = 1040;
constexpr std::uint64_t kBlockHeadBytes = 8; // number of the first line, and the number of bytes that follow

enum Compression : std::uint8_t { kNone = 0, kZip = 3, kPiz = 4 };

/// Reads forwards and never beyond the end.
struct Cursor {
    const std::string& path;
    ByteSpan bytes;
    std::size_t at = 0;

    [[noreturn]] void fail(const std::string& reason) const {
        throw Error{ExitCode::kBadInput, path + ": bad OpenEXR file: " + reason};
    }
    ByteSpan take(std::size_t count) {
        if (count > bytes.size() - at) fail("unexpected end of file");
        at += count;
        return bytes.subspan(at - count, count);
    }
    template <typename T>
    T number() {
        T value;
        std::memcpy(&value, take(sizeof value).data(), sizeof value);
        return value;
    }
    std::string text() {
        const std::size_t limit = std::min(bytes.size() - at, kLongestName + 1);
        const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at);
        const auto end = std::find(begin, begin + static_cast<std::ptrdiff_t>(limit), 0);
        if (end == begin + static_cast<std::ptrdiff_t>(limit)) fail("unterminated name");
        at += static_cast<std::size_t>(end - begin) + 1;
        return {begin, end};
    }
};

std::map<std::string, ByteSpan> readAttributes(Cursor& cursor, std::map<std::string, std::string>& texts) {
    std::map<std::string, ByteSpan> attributes;
    for (std::string name = cursor.text(); !name.empty(); name = cursor.text()) {
        const std::string type = cursor.text();
        const ByteSpan value = cursor.take(cursor.number<std::uint32_t>());
        if (attributes.size() == kMaxAttributes) cursor.fail("too many attributes");
        if (!attributes.emplace(name, value).second) cursor.fail("duplicate attribute " + printable(name));
        if (type == "string") texts[name] = std::string(value.begin(), value.end());
    }
    return attributes;
}

/// The value of a required attribute that has at least `bytes` bytes.
Cursor attribute(const Cursor& cursor, const std::map<std::string, ByteSpan>& attributes, const char* name,
                 std::size_t bytes) {
    const auto found = attributes.find(name);
    if (found == attributes.end() || found->second.size() < bytes)
        cursor.fail(std::string("missing or invalid attribute ") + name);
    return {cursor.path, found->second};
}

std::map<std::string, ExrPixel> readChannels(Cursor list) {
    std::map<std::string, ExrPixel> channels;
    for (std::string name = list.text(); !name.empty(); name = list.text()) {
        const auto type = list.number<std::uint32_t>();
        list.take(4); // a flag (perceptually linear) and reserved bytes
        if (type > static_cast<std::uint32_t>(ExrPixel::kFloat))
            list.fail("unknown pixel type of channel " + printable(name));
        if (list.number<std::int32_t>() != 1 || list.number<std::int32_t>() != 1)
            list.fail("channel " + printable(name) + " is subsampled, which is not supported");
        if (!channels.emplace(name, static_cast<ExrPixel>(type)).second)
            list.fail("duplicate channel " + printable(name));
    }
    if (channels.empty() || channels.size() > kMaxChannels) list.fail("no channels, or more than 64");
    return channels;
}

std::uint32_t rowsPerBlock(std::uint8_t compression) { return compression == kZip ? 16 : compression == kPiz ? 32 : 1; }

struct Window {
    std::int32_t min_x, min_y, max_x, max_y;
};

void readWindow(Cursor window_at, ExrStructure& structure, std::int32_t& min_y) {
    const auto window = window_at.number<Window>();
    const auto inside = [](std::int32_t v) { return v >= -kMaxCoordinate && v <= kMaxCoordinate; };
    if (!inside(window.min_x) || !inside(window.min_y) || !inside(window.max_x) || !inside(window.max_y) ||
        window.max_x < window.min_x || window.max_y < window.min_y)
        window_at.fail("the data window is empty or out of range");
    structure.width = static_cast<std::uint32_t>(window.max_x - window.min_x) + 1;
    structure.height = static_cast<std::uint32_t>(window.max_y - window.min_y) + 1;
    if (structure.width > kMaxPixelSide || structure.height > kMaxPixelSide)
        window_at.fail("more than " + std::to_string(kMaxPixelSide) + " pixels a side");
    min_y = window.min_y;
}

std::uint64_t pixelBytes(const ExrStructure& structure) {
    std::uint64_t bytes = 0;
    for (const auto& [name, type] : structure.channels) bytes += type == ExrPixel::kHalf ? 2 : 4;
    return bytes;
}

void checkBlocks(Cursor cursor, const ExrStructure& structure, std::uint8_t compression, std::int32_t min_y) {
    const std::uint32_t rows = rowsPerBlock(compression), blocks = (structure.height + rows - 1) / rows;
    Cursor table{cursor.path, cursor.take(blocks * sizeof(std::uint64_t))};
    for (std::uint32_t block = 0; block < blocks; ++block) {
        const auto offset = table.number<std::uint64_t>();
        if (offset < cursor.at || offset > cursor.bytes.size()) cursor.fail("a block is outside the file");
        Cursor head{cursor.path, cursor.bytes, offset};
        const auto line = head.number<std::int32_t>();
        const auto bytes = head.number<std::uint32_t>();
        head.take(bytes);
        if (line != min_y + static_cast<std::int32_t>(block * rows)) cursor.fail("a block has unexpected lines");
        const std::uint64_t lines = std::min(rows, structure.height - block * rows),
                            decoded = lines * structure.width * pixelBytes(structure);
        if (bytes == 0 || bytes > decoded || (compression == kNone && bytes != decoded) ||
            decoded > kMaxExpansion * (bytes + kBlockHeadBytes))
            cursor.fail("a block has an impossible size");
    }
}

} // namespace

ExrStructure checkExr(const std::string& path, std::span<const std::uint8_t> file) {
    Cursor cursor{path, file};
    if (cursor.number<std::uint32_t>() != kExrMagic) cursor.fail("wrong magic number");
    if ((cursor.number<std::uint32_t>() & ~kLongNames) != kExrVersion)
        cursor.fail("tiled, multi-part and deep files are not supported");
    ExrStructure structure;
    const auto attributes = readAttributes(cursor, structure.texts);
    structure.channels = readChannels(attribute(cursor, attributes, "channels", 1));
    std::int32_t min_y = 0;
    readWindow(attribute(cursor, attributes, "dataWindow", sizeof(Window)), structure, min_y);
    const auto compression = attribute(cursor, attributes, "compression", 1).number<std::uint8_t>();
    if (compression > kPiz) cursor.fail("only RLE, ZIP and PIZ compression are supported");
    // otherwise tinyexr would take the length of the offset table from it
    if (attributes.count("chunkCount")) cursor.fail("chunkCount is an attribute of multi-part files only");
    if (std::uint64_t{structure.width} * structure.height * structure.channels.size() * sizeof(float) >
        kMaxDecodedBytes)
        cursor.fail("more than 4 GiB of pixels");
    checkBlocks(cursor, structure, compression, min_y);
    return structure;
}

} // namespace pointrt
