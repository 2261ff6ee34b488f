// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/splat_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "format/base/error.h"
#include "format/os/atomic_file.h"
#include "pointrt/pro.h"
#include "preprocess/cloud/median.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace pointrt {

namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as in memory");
static_assert(sizeof(SplatFileHead) == 104 && sizeof(PositionCode) == 12 && sizeof(Rgb8) == 3, "no gaps in the file");

constexpr char kMagic[8] = {'p', 'r', 't', 's', 'p', 'l', '1', '\n'};
/// Offset from which the checksum covers the file.
constexpr std::size_t kCovered = offsetof(SplatFileHead, level);
/// Alignment of arrays, so that numbers of any type can be read in place.
constexpr std::size_t kAlign = 8;

struct AttributeRecord {
    char name[PRO_ATTRIBUTE_NAME_MAX + 1];
    std::uint32_t type, components; ///< PRO_TYPE_*, 1 to 4
    double low, high;               ///< of all finite values; 0 if no value is finite
};

std::size_t padded(std::size_t bytes) { return (bytes + kAlign - 1) / kAlign * kAlign; }

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
    throw Error(ExitCode::kBadInput, path + ": " + reason);
}

/// The bytes of a file in order.
class Pieces {
public:
    template <typename Item>
    void add(const Item* items, std::size_t count) {
        const std::size_t bytes = count * sizeof(Item);
        pieces_.push_back({reinterpret_cast<const char*>(items), bytes});
        static constexpr char kZeros[kAlign] = {};
        pieces_.push_back({kZeros, padded(bytes) - bytes});
    }
    std::uint64_t checksum() const {
        XXH3_state_t state;
        XXH3_64bits_reset(&state);
        std::size_t skip = kCovered; // in the first piece, the header
        for (const auto& piece : pieces_) {
            XXH3_64bits_update(&state, piece.data() + skip, piece.size() - skip);
            skip = 0;
        }
        return XXH3_64bits_digest(&state);
    }
    void write(const std::string& path) const {
        format::AtomicFile file;
        bool good = file.open(path);
        for (const auto& piece : pieces_) good = good && file.write(piece.data(), piece.size());
        if (!good || !file.commit()) throw Error(ExitCode::kCannotWrite, path + ": " + file.error());
    }

private:
    std::vector<std::string_view> pieces_;
};

SplatFileHead headOf(const TileKey& tile, const TileSplats& splats) {
    SplatFileHead head;
    std::copy(std::begin(kMagic), std::end(kMagic), head.magic);
    head.level = tile.level;
    head.cell = tile.cell;
    head.count = splats.positions.size();
    head.has_colors = !splats.colors.empty();
    head.has_noise = !splats.noise.empty();
    if (head.count > 0) {
        const auto [least, most] = std::minmax_element(splats.radii.begin(), splats.radii.end());
        head.radius_min = *least;
        head.radius_max = *most;
    }
    for (std::size_t axis = 0; axis < 3 && head.count > 0; ++axis) {
        const auto [low, high] = std::minmax_element(splats.positions.begin(), splats.positions.end(),
                                                     [&](auto& a, auto& b) { return a[axis] < b[axis]; });
        head.lowest[axis] = (*low)[axis];
        head.highest[axis] = (*high)[axis];
    }
    head.error = splats.error;
    head.spacing = splats.spacing;
    head.noise = medianOf(splats.noise);
    head.attribute_count = static_cast<std::uint32_t>(splats.attributes.size());
    return head;
}

void findRange(const Attribute& attribute, AttributeRecord& record) {
    const std::size_t numbers = attribute.values.size() / scalarSize(attribute.type);
    const pro_attribute view{{}, record.type, record.components, 0, 0, attribute.values.data()};
    bool found = false;
    for (std::size_t i = 0; i < numbers; ++i) {
        const double value = pro_attribute_value(&view, i);
        if (!std::isfinite(value)) continue;
        record.low = found ? std::min(record.low, value) : value;
        record.high = found ? std::max(record.high, value) : value;
        found = true;
    }
}

std::vector<AttributeRecord> recordsOf(const std::vector<Attribute>& attributes) {
    std::vector<AttributeRecord> records;
    for (const Attribute& attribute : attributes) {
        AttributeRecord& record = records.emplace_back(AttributeRecord{});
        attribute.name.copy(record.name, PRO_ATTRIBUTE_NAME_MAX);
        record.type = static_cast<std::uint32_t>(attribute.type) + 1;
        record.components = attribute.components;
        findRange(attribute, record);
    }
    return records;
}

/// Reads the arrays in a file's bytes one after another.
class Taker {
public:
    Taker(std::span<const std::byte> bytes, const std::string& path) : bytes_(bytes), path_(path) {}

    template <typename Item>
    std::span<const Item> take(std::uint64_t count) {
        const std::size_t left = bytes_.size() - at_;
        if (count > left / sizeof(Item) || padded(count * sizeof(Item)) > left) fail(path_, "is truncated");
        const auto* items = reinterpret_cast<const Item*>(bytes_.data() + at_);
        at_ += padded(count * sizeof(Item));
        return {items, count};
    }
    bool atEnd() const { return at_ == bytes_.size(); }

private:
    std::span<const std::byte> bytes_;
    const std::string& path_;
    std::size_t at_ = 0;
};

void requireOf(const SplatFileHead& head, const TileKey& tile, const std::string& path) {
    if (!std::equal(std::begin(kMagic), std::end(kMagic), head.magic)) fail(path, "is not a splat file");
    if (head.level != tile.level || head.cell != tile.cell) fail(path, "belongs to another tile");
}

std::vector<Attribute> schemaOf(std::span<const AttributeRecord> records, const std::string& path) {
    std::vector<Attribute> schema;
    for (const AttributeRecord& record : records) {
        if (pro_type_bytes(record.type) == 0 || record.components > 4 || record.name[PRO_ATTRIBUTE_NAME_MAX] != 0)
            fail(path, "has an attribute of unknown type");
        schema.push_back({record.name, static_cast<Scalar>(record.type - 1), record.components, {}});
    }
    return schema;
}

template <typename Item>
std::vector<Item> copyOf(std::span<const Item> items) {
    return {items.begin(), items.end()};
}

} // namespace

std::string splatFileOf(const std::string& folder, const TileKey& tile) {
    return folder + "/" + nameOf(tile) + ".splats";
}

void writeSplats(const std::string& folder, const TileKey& tile, const TileSplats& splats) {
    SplatFileHead head = headOf(tile, splats);
    const std::vector<AttributeRecord> records = recordsOf(splats.attributes);
    Pieces pieces;
    pieces.add(&head, 1);
    pieces.add(records.data(), records.size());
    pieces.add(splats.positions.data(), splats.positions.size());
    pieces.add(splats.normals.data(), splats.normals.size());
    pieces.add(splats.radii.data(), splats.radii.size());
    pieces.add(splats.colors.data(), splats.colors.size());
    pieces.add(splats.noise.data(), splats.noise.size());
    for (const Attribute& attribute : splats.attributes) pieces.add(attribute.values.data(), attribute.values.size());
    head.checksum = pieces.checksum();
    pieces.write(splatFileOf(folder, tile));
}

SplatFile::SplatFile(const std::string& folder, const TileKey& tile, float widest) : path_(splatFileOf(folder, tile)) {
    if (!file_.map(path_.c_str())) fail(path_, file_.error());
    parse(tile);
    if (head_.error == 0) view_.widest = widest;
}

void SplatFile::parse(const TileKey& tile) {
    const auto bytes = file_.bytes();
    Taker taker(bytes, path_);
    head_ = taker.take<SplatFileHead>(1).front();
    requireOf(head_, tile, path_);
    if (XXH3_64bits(bytes.data() + kCovered, bytes.size() - kCovered) != head_.checksum)
        fail(path_, "is damaged: its checksum does not match");
    schema_ = schemaOf(taker.take<AttributeRecord>(head_.attribute_count), path_);
    view_.positions = taker.take<PositionCode>(head_.count);
    view_.normals = taker.take<std::uint32_t>(head_.count);
    view_.radii = taker.take<float>(head_.count);
    view_.colors = taker.take<Rgb8>(head_.has_colors ? head_.count : 0);
    view_.noise = taker.take<float>(head_.has_noise ? head_.count : 0);
    for (const Attribute& attribute : schema_) {
        const std::size_t bytes_each = attribute.bytesEach();
        view_.attributes.push_back({taker.take<char>(head_.count * bytes_each).data(), bytes_each});
    }
    if (!taker.atEnd()) fail(path_, "is longer than its arrays");
}

TileSplats readSplats(const std::string& folder, const TileKey& tile) {
    const SplatFile file(folder, tile);
    const SplatsView& view = file.splats();
    TileSplats splats;
    splats.positions = copyOf(view.positions);
    splats.normals = copyOf(view.normals);
    splats.radii = copyOf(view.radii);
    splats.colors = copyOf(view.colors);
    splats.noise = copyOf(view.noise);
    splats.attributes = file.schema();
    for (std::size_t a = 0; a < splats.attributes.size(); ++a) {
        const SplatsView::Values& values = view.attributes[a];
        splats.attributes[a].values.assign(values.data, values.data + view.positions.size() * values.bytes_each);
    }
    splats.error = file.head().error;
    splats.spacing = file.head().spacing;
    return splats;
}

std::vector<float> readRadii(const std::string& folder, const TileKey& tile) {
    const std::string path = splatFileOf(folder, tile);
    format::MappedFile file;
    if (!file.map(path.c_str())) fail(path, file.error());
    Taker taker(file.bytes(), path);
    const SplatFileHead head = taker.take<SplatFileHead>(1).front();
    requireOf(head, tile, path);
    taker.take<AttributeRecord>(head.attribute_count);
    taker.take<PositionCode>(head.count);
    taker.take<std::uint32_t>(head.count); // normals
    return copyOf(taker.take<float>(head.count));
}

bool hasSplatFile(const std::string& folder, const TileKey& tile) {
    try {
        const SplatFile file(folder, tile);
        return true;
    } catch (const Error&) {
        return false;
    }
}

SplatFileSummary readSplatSummary(const std::string& folder, const TileKey& tile) {
    const std::string path = splatFileOf(folder, tile);
    std::ifstream file(path, std::ios::binary);
    SplatFileSummary summary;
    SplatFileHead& head = summary.head;
    if (!file.read(reinterpret_cast<char*>(&head), sizeof head)) fail(path, "cannot be read");
    requireOf(head, tile, path);
    if (head.attribute_count > PRO_ATTRIBUTE_MAX) fail(path, "has too many attributes");
    std::vector<AttributeRecord> records(head.attribute_count);
    const auto bytes = static_cast<std::streamsize>(records.size() * sizeof(AttributeRecord));
    if (!file.read(reinterpret_cast<char*>(records.data()), bytes)) fail(path, "is truncated");
    for (const AttributeRecord& each : records)
        summary.attributes.push_back({each.name, each.type, each.components, each.low, each.high});
    return summary;
}

void dropArrays(const std::string& folder, const TileKey& tile) {
    const std::string path = splatFileOf(folder, tile);
    const std::size_t records = readSplatSummary(folder, tile).attributes.size() * sizeof(AttributeRecord);
    std::error_code failure;
    std::filesystem::resize_file(path, padded(sizeof(SplatFileHead)) + padded(records), failure);
    if (failure) throw Error(ExitCode::kCannotWrite, path + ": " + failure.message());
}

} // namespace pointrt
