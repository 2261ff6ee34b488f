// SPDX-License-Identifier: GPL-3.0-or-later
// The format of PotreeConverter 2: https://github.com/potree/PotreeConverter
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "format/pointio/las_crs.h"
#include "preprocess/ingest/attribute_names.h"
#include "preprocess/ingest/formats.h"
#include "preprocess/ingest/json_value.h"
#include "preprocess/ingest/scalar.h"
#include "preprocess/ingest/unpack_limit.h"
#include "preprocess/input/points/octree_folder.h"
#include "preprocess/input/points/potree_brotli.h"

namespace pointrt {
namespace {

/// A value of each point, at a byte of its record.
struct PotreeField {
    std::size_t at = 0, size = 0;
    std::optional<std::size_t> place; ///< in the packed values, of attributes
};

struct PotreeMeta {
    Vec3d scale, offset;
    Eigen::AlignedBox3d box;
    std::uint64_t points = 0, first_chunk = 0;
    std::size_t record_bytes = 0;
    std::optional<std::size_t> position, color; ///< bytes of the record
    std::vector<PotreeField> fields;
    std::vector<PotreeColumn> columns; ///< of whole records
    bool is_brotli = false;
    ScanTraits traits;
    std::string projection;
};

Scalar scalarNamedBy(const JsonValue& type) {
    constexpr std::pair<std::string_view, Scalar> kTypes[] = {
        {"int8", Scalar::kI8},   {"uint8", Scalar::kU8},   {"int16", Scalar::kI16}, {"uint16", Scalar::kU16},
        {"int32", Scalar::kI32}, {"uint32", Scalar::kU32}, {"int64", Scalar::kI64}, {"uint64", Scalar::kU64},
        {"float", Scalar::kF32}, {"double", Scalar::kF64}};
    for (const auto& [name, scalar] : kTypes)
        if (type.text() == name) return scalar;
    type.refuse("is not a type of numbers");
}

Vec3d threeOf(const JsonValue& value) { return {value.at(0).number(), value.at(1).number(), value.at(2).number()}; }

void takeField(const JsonValue& attribute, AttributeNames& names, std::size_t& packed, PotreeMeta& meta) {
    constexpr std::uint64_t kMostElements = 255;
    const std::string& name = attribute.member("name").text();
    const Scalar type = scalarNamedBy(attribute.member("type"));
    const std::uint64_t elements = attribute.member("numElements").integer(kMostElements);
    PotreeField field{meta.record_bytes, elements * scalarSize(type), {}};
    meta.record_bytes += field.size;
    meta.columns.push_back({field.at, field.size, PotreeKind::kOther});
    if (name == "position") {
        if (type != Scalar::kI32 || elements != 3) attribute.refuse("must be three int32");
        meta.position = field.at;
        meta.columns.back().kind = PotreeKind::kPosition;
    } else if (name == "rgb" && type == Scalar::kU16 && elements == 3) {
        meta.color = field.at;
        meta.columns.back().kind = PotreeKind::kColor;
    } else if (elements >= 1 && elements <= 4) {
        const auto taken = names.take(name);
        if (!taken) return;
        field.place = packed;
        packed += field.size;
        meta.traits.columns.push_back({*taken, type, static_cast<std::uint32_t>(elements)});
        meta.fields.push_back(field);
    }
}

PotreeMeta metaOf(const InputFile& input) {
    const nlohmann::json json = parseJson(input, input.bytes);
    const JsonValue root(input, json);
    PotreeMeta meta;
    const std::string encoding = root.has("encoding") ? root.member("encoding").text() : "DEFAULT";
    meta.is_brotli = encoding == "BROTLI";
    if (!meta.is_brotli && encoding != "DEFAULT")
        refuse(input, fmt::format("has points in the encoding {}; this build reads 'DEFAULT' and 'BROTLI'",
                                  inQuotes(encoding)));
    meta.scale = threeOf(root.member("scale"));
    meta.offset = threeOf(root.member("offset"));
    meta.points = root.member("points").integer();
    meta.first_chunk = root.member("hierarchy").member("firstChunkSize").integer();
    meta.box = {threeOf(root.member("boundingBox").member("min")), threeOf(root.member("boundingBox").member("max"))};
    if (root.has("projection")) meta.projection = root.member("projection").text();
    const JsonValue attributes = root.member("attributes");
    AttributeNames names;
    std::size_t packed = 0;
    for (std::size_t i = 0; i < attributes.size(); ++i) takeField(attributes.at(i), names, packed, meta);
    if (!meta.position) refuse(input, "has no attribute 'position'");
    meta.traits.faces = false;
    meta.traits.colors = meta.color.has_value();
    meta.traits.color_scale = ColorScale::kInteger;
    return meta;
}

/// A run of points in octree.bin.
struct PotreeRun {
    std::uint64_t at = 0, points = 0;
    std::uint64_t bytes = 0; ///< in the encoding BROTLI
};

/// Reads the records of the hierarchy, which consists of chunks: the last nodes of a chunk are the roots of others.
class PotreeHierarchy {
public:
    PotreeHierarchy(const InputFile& file, const Sink& sink) : file_(file), sink_(sink) {}

    std::vector<PotreeRun> runs(std::uint64_t first_chunk, const Eigen::AlignedBox3d& box) {
        chunks_.push_back({0, first_chunk, {0, box}});
        while (!chunks_.empty()) {
            const Chunk chunk = chunks_.back();
            chunks_.pop_back();
            readChunk(chunk);
        }
        std::sort(runs_.begin(), runs_.end(), [](const PotreeRun& a, const PotreeRun& b) { return a.at < b.at; });
        return std::move(runs_);
    }

private:
    struct Node {
        int level;
        Eigen::AlignedBox3d box;
    };
    struct Chunk {
        std::uint64_t at, bytes;
        Node root;
    };

    void readChunk(const Chunk& chunk) {
        constexpr std::uint64_t kRecord = 22; // type, children, points, byte, bytes
        constexpr int kProxy = 2;
        if (chunk.at > file_.bytes.size() || chunk.bytes > file_.bytes.size() - chunk.at)
            refuse(file_, "a chunk of the hierarchy lies outside the file");
        bytes_read_ += std::max(chunk.bytes, kRecord);
        if (bytes_read_ > 2 * file_.bytes.size() + kRecord) refuse(file_, "the hierarchy is cyclic");
        std::vector<Node> nodes{chunk.root};
        for (std::uint64_t i = 0; i < chunk.bytes / kRecord && i < nodes.size(); ++i) {
            const char* const at = file_.begin() + chunk.at + i * kRecord;
            const Node node = nodes[i];
            const std::uint64_t points = wholeAt(at + 2, Scalar::kU32), byte = wholeAt(at + 6, Scalar::kU64);
            if (at[0] == kProxy) {
                chunks_.push_back({byte, wholeAt(at + 14, Scalar::kU64), node});
                continue;
            }
            if (points > 0 && selectsNode(sink_, node.level, node.box))
                runs_.push_back({byte, points, wholeAt(at + 14, Scalar::kU64)});
            for (unsigned child = 0; child < 8; ++child)
                if ((static_cast<unsigned char>(at[1]) >> child & 1) != 0)
                    nodes.push_back({node.level + 1, childBox(node.box, child)});
        }
    }

    static std::uint64_t wholeAt(const char* at, Scalar type) {
        std::uint64_t value = 0;
        std::memcpy(&value, at, scalarSize(type));
        return value;
    }

    const InputFile& file_;
    const Sink& sink_;
    std::vector<Chunk> chunks_;
    std::vector<PotreeRun> runs_;
    std::uint64_t bytes_read_ = 0;
};

void addPotreePoint(const PotreeMeta& meta, const char* record, Row& row, std::vector<char>& packed, Sink& sink) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::int32_t whole = 0;
        std::memcpy(&whole, record + *meta.position + axis * sizeof whole, sizeof whole);
        const auto a = static_cast<Eigen::Index>(axis);
        row[kX + axis] = meta.offset[a] + meta.scale[a] * whole;
        if (meta.color) row[kRed + axis] = loadScalar(record + *meta.color + axis * 2, Scalar::kU16, false);
    }
    for (const PotreeField& field : meta.fields)
        std::copy_n(record + field.at, field.size, packed.begin() + static_cast<std::ptrdiff_t>(*field.place));
    sink.addVertex(row, packed.data());
}

InputFile openSibling(const InputFile& input, const char* name) {
    return openInputFile((std::filesystem::path(input.name).parent_path() / name).string(), NamedBy::kFile);
}

/// The points of all runs. Throws Error if one lies outside the file, or together they are more than it can hold: with
/// Brotli, more than a gzipped scan may unpack to.
std::uint64_t pointsOf(const PotreeMeta& meta, const InputFile& hierarchy, const InputFile& octree,
                       const std::vector<PotreeRun>& runs) {
    const std::uint64_t size = octree.bytes.size();
    const std::uint64_t unpacked = meta.is_brotli ? mostUnpacked(size) : size;
    const std::uint64_t room = unpacked / meta.record_bytes;
    std::uint64_t points = 0;
    for (const PotreeRun& run : runs) {
        const std::uint64_t left = size - std::min(run.at, size);
        const bool fits = meta.is_brotli ? run.bytes <= left : run.points <= left / meta.record_bytes;
        if (run.at > size || !fits)
            refuse(octree,
                   fmt::format("truncated: a node of {} points at byte {} lies outside the file", run.points, run.at));
        points += run.points;
        if (points > room) refuse(hierarchy, fmt::format("names {} points or more, but {} are there", points, room));
    }
    return points;
}

void readPotree(const InputFile& input, Sink& sink) {
    PotreeMeta meta = metaOf(input);
    const InputFile hierarchy = openSibling(input, "hierarchy.bin"), octree = openSibling(input, "octree.bin");
    const std::vector<PotreeRun> runs = PotreeHierarchy(hierarchy, sink).runs(meta.first_chunk, meta.box);
    const std::uint64_t points = pointsOf(meta, hierarchy, octree, runs);
    if (runs.empty()) refuse(input, "none of its nodes is within --bounds");
    meta.traits.vertices = points;
    sink.beginScan(input, meta.traits);
    Row row{};
    std::size_t packed_bytes = 0;
    for (const PotreeField& field : meta.fields) packed_bytes += field.size;
    std::vector<char> packed(packed_bytes);
    for (const PotreeRun& run : runs) {
        std::string unpacked;
        if (meta.is_brotli)
            unpacked = unpackPotreeNode(octree, octree.bytes.substr(run.at, run.bytes), meta.columns, meta.record_bytes,
                                        run.points);
        const char* const records = meta.is_brotli ? unpacked.data() : octree.begin() + run.at;
        for (std::uint64_t i = 0; i < run.points; ++i)
            addPotreePoint(meta, records + i * meta.record_bytes, row, packed, sink);
    }
    sink.finishScan(input);
    const LasCrs crs = crsOfWkt(meta.projection);
    WorldFrame frame;
    frame.up = Vec3d::UnitZ();
    frame.metres_per_unit = crs.metres_per_unit;
    frame.crs = crs.name;
    sink.setWorldFrame(input, frame);
    if (crs.kind == LasCrs::Kind::kGeographic) sink.addDegrees(input);
}

} // namespace

const FormatReader readers::kPotree{
    .isStart = isPotreeMeta, .read = readPotree, .readsInBatches = alwaysInBatches, .has_levels = true};

} // namespace pointrt
