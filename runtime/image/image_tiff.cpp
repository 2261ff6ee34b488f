// SPDX-License-Identifier: Apache-2.0
#include "runtime/image/image_tiff.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "format/base/error.h"

namespace pointrt {
namespace {

/// Bytes of a strip before compression: large enough for deflate to work well, small enough that readers of a part of
/// the picture skip most of the file.
constexpr std::uint32_t kStripBytes = 1 << 18;

// Types and tags of TIFF 6.0, and of GeoTIFF 1.1 (OGC 19-008r4).
enum Type : std::uint16_t { kAscii = 2, kShort = 3, kLong = 4, kDouble = 12 };
enum Tag : std::uint16_t {
    kWidth = 256,
    kLength = 257,
    kBitsPerSample = 258,
    kCompression = 259,
    kPhotometric = 262,
    kStripOffsets = 273,
    kSamplesPerPixel = 277,
    kRowsPerStrip = 278,
    kStripByteCounts = 279,
    kPlanarConfiguration = 284,
    kSoftware = 305,
    kExtraSamples = 338,
    kModelPixelScale = 33550,
    kModelTiepoint = 33922,
    kGeoKeyDirectory = 34735
};
constexpr std::uint32_t kDeflate = 8, kRgb = 2, kChunky = 1, kStraightAlpha = 2;
constexpr std::uint16_t kModelTypeKey = 1024, kRasterTypeKey = 1025, kProjectedCrsKey = 3072;
constexpr std::uint16_t kModelProjected = 1, kPixelIsArea = 1;

template <typename Number>
void put(Number number, std::vector<std::uint8_t>& to) {
    std::uint64_t bits = 0;
    if constexpr (std::is_floating_point_v<Number>)
        bits = std::bit_cast<std::uint64_t>(number);
    else
        bits = number;
    for (std::size_t i = 0; i < sizeof(Number); ++i) to.push_back(static_cast<std::uint8_t>(bits >> 8 * i));
}

/// The image file directory. Entries must be added with ascending tags.
class Directory {
public:
    template <typename Number>
    void add(Tag tag, Type type, const std::vector<Number>& values) {
        Entry entry{tag, type, static_cast<std::uint32_t>(values.size()), {}};
        for (const Number value : values) put(value, entry.bytes);
        entries_.push_back(std::move(entry));
    }

    /// @param offset of the directory in the file; even
    std::vector<std::uint8_t> bytes(std::uint32_t offset) const {
        constexpr std::uint32_t kEntryBytes = 12, kInline = 4;
        const auto count = static_cast<std::uint16_t>(entries_.size());
        std::uint32_t at = offset + 2 + kEntryBytes * count + 4; // offset of the values that do not fit into entries
        std::vector<std::uint8_t> directory, values;
        put(count, directory);
        for (const Entry& entry : entries_) {
            put(static_cast<std::uint16_t>(entry.tag), directory);
            put(static_cast<std::uint16_t>(entry.type), directory);
            put(entry.count, directory);
            std::vector<std::uint8_t> bytes = entry.bytes;
            if (bytes.size() <= kInline) {
                bytes.resize(kInline);
                directory.insert(directory.end(), bytes.begin(), bytes.end());
                continue;
            }
            put(at, directory);
            bytes.resize(bytes.size() + bytes.size() % 2); // values begin at even offsets
            values.insert(values.end(), bytes.begin(), bytes.end());
            at += static_cast<std::uint32_t>(bytes.size());
        }
        put(std::uint32_t{0}, directory); // no next directory
        directory.insert(directory.end(), values.begin(), values.end());
        return directory;
    }

private:
    struct Entry {
        Tag tag;
        Type type;
        std::uint32_t count;
        std::vector<std::uint8_t> bytes;
    };
    std::vector<Entry> entries_;
};

std::vector<std::uint16_t> geoKeysOf(const GeoReference& place) {
    std::vector<std::uint16_t> keys{1, 1, 1, 1, kRasterTypeKey, 0, 1, kPixelIsArea}; // version 1.1.1, one key
    if (place.epsg == 0) return keys;
    return {1,
            1,
            1,
            3,
            kModelTypeKey,
            0,
            1,
            kModelProjected,
            kRasterTypeKey,
            0,
            1,
            kPixelIsArea,
            kProjectedCrsKey,
            0,
            1,
            static_cast<std::uint16_t>(place.epsg)};
}

void addPlace(const GeoReference& place, Directory& directory) {
    directory.add<double>(kModelPixelScale, kDouble, {place.pixel, place.pixel, 0});
    // places the first pixel on the map
    directory.add<double>(kModelTiepoint, kDouble, {0, 0, 0, place.west, place.north, 0});
    directory.add(kGeoKeyDirectory, kShort, geoKeysOf(place));
}

} // namespace

TiffWriter::TiffWriter(const std::string& path, TiffSize size, std::optional<GeoReference> place)
    : file_(path), path_(path), size_(size), place_(place),
      strip_rows_(std::clamp(kStripBytes / (size.width * size.channels), 1u, size.height)) {
    append(std::vector<std::uint8_t>{'I', 'I', 42, 0, 0, 0, 0, 0}); // little-endian; finish adds the directory's offset
}

void TiffWriter::append(std::span<const std::uint8_t> bytes) {
    file_.append(bytes);
    written_ += bytes.size();
    if (written_ > std::numeric_limits<std::uint32_t>::max())
        throw Error(ExitCode::kCannotWrite, path_ + ": TIFF files are limited to 4 GiB");
}

void TiffWriter::addRows(std::span<const std::uint8_t> rows) {
    const std::size_t full = std::size_t{strip_rows_} * size_.width * size_.channels;
    while (!rows.empty()) {
        const std::size_t part = std::min(full - strip_.size(), rows.size());
        strip_.insert(strip_.end(), rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(part));
        rows = rows.subspan(part);
        if (strip_.size() == full) writeStrip();
    }
}

void TiffWriter::writeStrip() {
    uLongf size = compressBound(static_cast<uLong>(strip_.size()));
    std::vector<std::uint8_t> packed(size);
    if (compress2(packed.data(), &size, strip_.data(), static_cast<uLong>(strip_.size()), Z_DEFAULT_COMPRESSION) !=
        Z_OK)
        throw std::bad_alloc(); // the only error that zlib documents for these arguments
    packed.resize(size);
    offsets_.push_back(static_cast<std::uint32_t>(written_));
    bytes_.push_back(static_cast<std::uint32_t>(size));
    append(packed);
    strip_.clear();
}

void TiffWriter::finish() {
    if (!strip_.empty()) writeStrip();
    if (written_ % 2 == 1) append(std::vector<std::uint8_t>{0}); // directories begin at even offsets
    using Shorts = std::vector<std::uint16_t>;
    using Longs = std::vector<std::uint32_t>;
    const std::string program = "pointrt-view " POINTRT_VERSION;
    std::vector<std::uint8_t> software(program.begin(), program.end());
    software.push_back(0);
    Directory directory;
    directory.add(kWidth, kLong, Longs{size_.width});
    directory.add(kLength, kLong, Longs{size_.height});
    directory.add(kBitsPerSample, kShort, Shorts(size_.channels, 8));
    directory.add(kCompression, kShort, Shorts{kDeflate});
    directory.add(kPhotometric, kShort, Shorts{kRgb});
    directory.add(kStripOffsets, kLong, offsets_);
    directory.add(kSamplesPerPixel, kShort, Shorts{static_cast<std::uint16_t>(size_.channels)});
    directory.add(kRowsPerStrip, kLong, Longs{strip_rows_});
    directory.add(kStripByteCounts, kLong, bytes_);
    directory.add(kPlanarConfiguration, kShort, Shorts{kChunky});
    directory.add(kSoftware, kAscii, software);
    if (size_.channels == 4) directory.add(kExtraSamples, kShort, Shorts{kStraightAlpha});
    if (place_) addPlace(*place_, directory);
    std::vector<std::uint8_t> offset;
    put(static_cast<std::uint32_t>(written_), offset);
    append(directory.bytes(static_cast<std::uint32_t>(written_)));
    file_.overwrite(4, offset);
    file_.commit();
}

} // namespace pointrt
