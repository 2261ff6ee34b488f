// SPDX-License-Identifier: Apache-2.0
#include "runtime/image/image_exr.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <new>
#include <stdexcept>
#include <vector>

#include "runtime/image/exr_structure.h"
#include "runtime/image/film_parts.h"
#include "runtime/util/output_file.h"

namespace pointrt {
namespace {

static_assert(std::endian::native == std::endian::little,
              "EXR is little-endian, and values are written from memory unchanged");

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint8_t kZipCompression = 3;
constexpr std::uint32_t kRowsPerBlock = 16; // of ZIP compression
constexpr std::size_t kLongestShortName = 31;
constexpr int kDeflateLevel = 4;       // OpenEXR's default: twice as fast as zlib's, files a few percent larger
constexpr std::size_t kValueBytes = 4; // of both pixel types

template <typename T>
void append(Bytes& bytes, const T& value) {
    const std::size_t end = bytes.size();
    bytes.resize(end + sizeof value);
    std::memcpy(bytes.data() + end, &value, sizeof value);
}

void appendText(Bytes& bytes, const std::string& text) {
    bytes.insert(bytes.end(), text.c_str(), text.c_str() + text.size() + 1);
}

void appendAttribute(Bytes& header, const std::string& name, const char* type, const Bytes& value) {
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

void appendTextAttribute(Bytes& header, const ExrText& text) {
    appendAttribute(header, text.name, "string", Bytes(text.value.begin(), text.value.end()));
}

Bytes channelList(std::span<const ExrChannel> channels) {
    Bytes list;
    for (const ExrChannel& channel : channels) {
        appendText(list, channel.name);
        append(list, channel.type);
        append(list, std::uint32_t{0}); // not perceptually linear; three reserved bytes
        append(list, std::int32_t{1});  // subsampling in x: none
        append(list, std::int32_t{1});  // subsampling in y: none
    }
    list.push_back(0);
    return list;
}

Bytes makeHeader(ExrSize size, std::span<const ExrChannel> channels, std::span<const ExrText> texts) {
    Bytes header = pack(kExrMagic, kExrVersion);
    const Bytes window = pack(std::int32_t{0}, std::int32_t{0}, static_cast<std::int32_t>(size.width) - 1,
                              static_cast<std::int32_t>(size.height) - 1);
    appendAttribute(header, "channels", "chlist", channelList(channels));
    appendAttribute(header, "compression", "compression", {kZipCompression});
    appendAttribute(header, "dataWindow", "box2i", window);
    appendAttribute(header, "displayWindow", "box2i", window);
    appendAttribute(header, "lineOrder", "lineOrder", {0});
    appendAttribute(header, "pixelAspectRatio", "float", pack(1.0f));
    appendAttribute(header, "screenWindowCenter", "v2f", pack(0.0f, 0.0f));
    appendAttribute(header, "screenWindowWidth", "float", pack(1.0f));
    appendTextAttribute(header, {"software", "pointrt-view " POINTRT_VERSION});
    for (const ExrText& text : texts) appendTextAttribute(header, text);
    header.push_back(0);
    return header;
}

/// Rows [first, first + count), channel by channel within each row.
Bytes gatherRows(ExrSize size, std::span<const ExrChannel> channels, std::uint32_t first, std::uint32_t count) {
    Bytes raw(std::size_t{count} * channels.size() * size.width * kValueBytes);
    std::uint8_t* value = raw.data();
    for (std::uint32_t y = first; y < first + count; ++y)
        for (const ExrChannel& channel : channels) {
            const auto* from = static_cast<const std::uint8_t*>(channel.data);
            const std::size_t step = channel.stride * kValueBytes;
            from += std::size_t{y} * size.width * step;
            for (std::size_t x = 0; x < size.width; ++x, from += step, value += kValueBytes)
                std::memcpy(value, from, kValueBytes);
        }
    return raw;
}

/// The filter that ZIP compression applies before deflate: even bytes, then odd ones, each stored as the difference
/// from the one before.
Bytes reorder(const Bytes& raw) {
    Bytes split(raw.size());
    const std::size_t half = (raw.size() + 1) / 2;
    for (std::size_t i = 0; i < raw.size(); ++i) split[(i % 2 ? half : 0) + i / 2] = raw[i];
    for (std::size_t i = split.size(); i-- > 1;) split[i] = static_cast<std::uint8_t>(split[i] - split[i - 1] + 128);
    return split;
}

/// Stores a block that does not shrink uncompressed, which readers recognise by its size.
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

/// Sorted by name, as the format requires.
std::vector<ExrChannel> sorted(std::span<const ExrChannel> channels) {
    std::vector<ExrChannel> result(channels.begin(), channels.end());
    std::sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    for (std::size_t i = 0; i < result.size(); ++i)
        if (result[i].name.size() > kLongestShortName || (i > 0 && result[i].name == result[i - 1].name))
            throw std::logic_error("writeExr: channel name " + result[i].name + " is too long or a duplicate");
    return result;
}

} // namespace

void writeExr(const std::string& path, ExrSize size, std::span<const ExrChannel> unsorted,
              std::span<const ExrText> texts) {
    const std::vector<ExrChannel> channels = sorted(unsorted);
    OutputFile file(path);
    const Bytes header = makeHeader(size, channels, texts);
    std::vector<std::uint64_t> offsets((size.height + kRowsPerBlock - 1) / kRowsPerBlock);
    const std::span table(reinterpret_cast<const std::uint8_t*>(offsets.data()), offsets.size() * sizeof offsets[0]);
    file.append(header);
    file.append(table); // placeholder: offsets are known when the blocks are written
    std::uint64_t end = header.size() + table.size();
    for (std::uint32_t block = 0; block < offsets.size(); ++block) {
        const std::uint32_t first = block * kRowsPerBlock, count = std::min(kRowsPerBlock, size.height - first);
        const Bytes packed = compressBlock(gatherRows(size, channels, first, count));
        const Bytes head = pack(first, static_cast<std::uint32_t>(packed.size()));
        offsets[block] = end;
        file.append(head);
        file.append(packed);
        end += head.size() + packed.size();
    }
    file.overwrite(header.size(), table);
    file.commit();
}

void writeExr(const std::string& path, const Film& film, std::span<const ExrText> texts) {
    const std::size_t pixels = std::size_t{film.width} * film.height;
    std::vector<ExrChannel> channels;
    forEachFilmPart(film, [&](const FilmPart& part, const auto& values) {
        if (values.empty() && !isRequired(part)) return;
        const std::size_t stride = part.channels.size();
        if (values.size() != stride * pixels)
            throw std::logic_error("writeExr: the pixel count does not match the size");
        for (std::size_t c = 0; c < stride; ++c)
            channels.push_back({part.channels[c], values.data() + c, stride, exrPixelOf(values)});
    });
    writeExr(path, {film.width, film.height}, channels, texts);
}

} // namespace pointrt
