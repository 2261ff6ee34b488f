// SPDX-License-Identifier: Apache-2.0
#include "runtime/image_exr.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <new>
#include <stdexcept>
#include <vector>

#include "runtime/output_file.h"

namespace pointrt {
namespace {

static_assert(std::endian::native == std::endian::little, "EXR is little-endian and written as it lies in memory");

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint32_t kMagic = 20000630;
constexpr std::uint32_t kVersion = 2; // no flags: single part, scan lines, short names
constexpr std::uint8_t kZipCompression = 3;
constexpr std::uint32_t kRowsPerBlock = 16; // of ZIP compression
constexpr std::uint32_t kFloatPixels = 2;
constexpr int kDeflateLevel = 4; // OpenEXR's own default: twice as fast as zlib's, a few percent larger

/// Where a channel's value of pixel i lies: data[i * stride].
struct Channel {
    const char* name;
    const float* data;
    std::size_t stride;
};

/// In the order of their names, as the format demands.
std::vector<Channel> channelsOf(const Film& film) {
    const float *color = film.rgba.data(), *n = film.normal.data(), *p = film.position.data();
    return {{"A", color + 3, 4},        {"B", color + 2, 4}, {"G", color + 1, 4}, {"N.X", n, 3},     {"N.Y", n + 1, 3},
            {"N.Z", n + 2, 3},          {"P.X", p, 3},       {"P.Y", p + 1, 3},   {"P.Z", p + 2, 3}, {"R", color, 4},
            {"Z", film.depth.data(), 1}};
}

template <typename T>
void append(Bytes& bytes, const T& value) {
    const std::size_t end = bytes.size();
    bytes.resize(end + sizeof value);
    std::memcpy(bytes.data() + end, &value, sizeof value);
}

void appendText(Bytes& bytes, const char* text) { bytes.insert(bytes.end(), text, text + std::strlen(text) + 1); }

void appendAttribute(Bytes& header, const char* name, const char* type, const Bytes& value) {
    appendText(header, name);
    appendText(header, type);
    append(header, static_cast<std::uint32_t>(value.size()));
    header.insert(header.end(), value.begin(), value.end());
}

template <typename... Values>
Bytes pack(const Values&... values) {
    Bytes bytes;
    (append(bytes, values), ...);
    return bytes;
}

Bytes channelList(const std::vector<Channel>& channels) {
    Bytes list;
    for (const Channel& channel : channels) {
        appendText(list, channel.name);
        append(list, kFloatPixels);
        append(list, std::uint32_t{0}); // not perceptually linear; three reserved bytes
        append(list, std::int32_t{1});  // every pixel in x
        append(list, std::int32_t{1});  // and y
    }
    list.push_back(0);
    return list;
}

Bytes makeHeader(const Film& film, const std::vector<Channel>& channels) {
    Bytes header = pack(kMagic, kVersion);
    const char software[] = "pointrt-view " POINTRT_VERSION;
    const Bytes window = pack(std::int32_t{0}, std::int32_t{0}, static_cast<std::int32_t>(film.width) - 1,
                              static_cast<std::int32_t>(film.height) - 1);
    appendAttribute(header, "channels", "chlist", channelList(channels));
    appendAttribute(header, "compression", "compression", {kZipCompression});
    appendAttribute(header, "dataWindow", "box2i", window);
    appendAttribute(header, "displayWindow", "box2i", window);
    appendAttribute(header, "lineOrder", "lineOrder", {0});
    appendAttribute(header, "pixelAspectRatio", "float", pack(1.0f));
    appendAttribute(header, "screenWindowCenter", "v2f", pack(0.0f, 0.0f));
    appendAttribute(header, "screenWindowWidth", "float", pack(1.0f));
    appendAttribute(header, "software", "string", Bytes(software, software + sizeof software - 1));
    header.push_back(0);
    return header;
}

/// Rows [first, first + count), each as its channels one after the other.
Bytes gatherRows(const Film& film, const std::vector<Channel>& channels, std::uint32_t first, std::uint32_t count) {
    std::vector<float> row(film.width);
    Bytes raw;
    raw.reserve(std::size_t{count} * channels.size() * film.width * sizeof(float));
    for (std::uint32_t y = first; y < first + count; ++y)
        for (const Channel& channel : channels) {
            const std::size_t start = std::size_t{y} * film.width;
            for (std::size_t x = 0; x < film.width; ++x) row[x] = channel.data[(start + x) * channel.stride];
            const auto* bytes = reinterpret_cast<const std::uint8_t*>(row.data());
            raw.insert(raw.end(), bytes, bytes + row.size() * sizeof(float));
        }
    return raw;
}

/// What ZIP compression does before deflate: even bytes first, then odd ones, each as difference to the one before.
Bytes reorder(const Bytes& raw) {
    Bytes split(raw.size());
    const std::size_t half = (raw.size() + 1) / 2;
    for (std::size_t i = 0; i < raw.size(); ++i) split[(i % 2 ? half : 0) + i / 2] = raw[i];
    for (std::size_t i = split.size(); i-- > 1;) split[i] = static_cast<std::uint8_t>(split[i] - split[i - 1] + 128);
    return split;
}

/// A block that does not shrink is stored as it is: readers tell by its size.
Bytes compressBlock(Bytes raw) {
    const Bytes prepared = reorder(raw);
    uLongf size = compressBound(prepared.size());
    Bytes packed(size);
    if (compress2(packed.data(), &size, prepared.data(), prepared.size(), kDeflateLevel) != Z_OK)
        throw std::bad_alloc();
    if (size >= raw.size()) return raw;
    packed.resize(size);
    return packed;
}

void requireComplete(const Film& film) {
    const std::size_t pixels = std::size_t{film.width} * film.height;
    if (film.rgba.size() != 4 * pixels || film.depth.size() != pixels || film.normal.size() != 3 * pixels ||
        film.position.size() != 3 * pixels)
        throw std::logic_error("writeExr: pixel count does not fit the size");
}

} // namespace

void writeExr(const std::string& path, const Film& film) {
    requireComplete(film);
    const std::vector<Channel> channels = channelsOf(film);
    Bytes file = makeHeader(film, channels);
    std::vector<std::uint64_t> offsets((film.height + kRowsPerBlock - 1) / kRowsPerBlock);
    const std::size_t table_at = file.size(), table_bytes = offsets.size() * sizeof offsets[0];
    file.resize(table_at + table_bytes);
    for (std::uint32_t block = 0; block < offsets.size(); ++block) {
        const std::uint32_t first = block * kRowsPerBlock, count = std::min(kRowsPerBlock, film.height - first);
        const Bytes packed = compressBlock(gatherRows(film, channels, first, count));
        offsets[block] = file.size();
        append(file, first);
        append(file, static_cast<std::uint32_t>(packed.size()));
        file.insert(file.end(), packed.begin(), packed.end());
    }
    std::memcpy(file.data() + table_at, offsets.data(), table_bytes);
    writeFile(path, file);
}

} // namespace pointrt
