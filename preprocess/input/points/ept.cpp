// SPDX-License-Identifier: GPL-3.0-or-later
// Entwine Point Tiles: https://entwine.io/en/latest/entwine-point-tile.html
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "preprocess/ingest/formats.h"
#include "preprocess/ingest/json_value.h"
#include "preprocess/ingest/named_file.h"
#include "preprocess/ingest/text.h"
#include "preprocess/input/points/ept_binary.h"
#include "preprocess/input/points/las_scan.h"
#include "preprocess/input/points/octree_folder.h"
#include "preprocess/input/points/unpack_chunk.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

/// A file of points, named by its node: level and place on each axis.
struct EptNode {
    fs::path path;
    std::array<std::uint64_t, 4> key{}; ///< level, x, y, z

    bool operator<(const EptNode& other) const { return key < other.key; }
};

/// "3-1-4-0.laz", or with another suffix.
std::optional<EptNode> nodeOf(const fs::path& path, std::string_view suffix) {
    constexpr std::uint64_t kDeepest = 30; // places in 32 bits
    if (path.extension() != suffix) return std::nullopt;
    EptNode node{path, {}};
    const std::string name = path.stem().string();
    std::string_view rest = name;
    for (std::uint64_t& part : node.key) {
        const std::size_t length = std::min(rest.find('-'), rest.size());
        if (!wholeInteger(rest.substr(0, length), part)) return std::nullopt;
        rest.remove_prefix(std::min(length + 1, rest.size()));
    }
    if (!rest.empty() || node.key[0] > kDeepest) return std::nullopt;
    return node;
}

Eigen::AlignedBox3d cubeOf(const JsonValue& root) {
    const JsonValue bounds = root.member("bounds");
    Eigen::AlignedBox3d cube;
    for (int axis = 0; axis < 3; ++axis) {
        cube.min()[axis] = bounds.at(static_cast<std::size_t>(axis)).number();
        cube.max()[axis] = bounds.at(static_cast<std::size_t>(axis) + 3).number();
    }
    return cube;
}

Eigen::AlignedBox3d boxOf(const EptNode& node, const Eigen::AlignedBox3d& cube) {
    const Vec3d edge = cube.sizes() / static_cast<double>(std::uint64_t{1} << node.key[0]);
    const Vec3d place(double(node.key[1]), double(node.key[2]), double(node.key[3]));
    const Vec3d low = cube.min() + place.cwiseProduct(edge);
    return {low, low + edge};
}

/// The nodes that the sink selects, in the order of their keys.
std::vector<EptNode> nodesOf(const InputFile& input, const JsonValue& root, std::string_view suffix, const Sink& sink) {
    const fs::path folder = fs::path(input.name).parent_path() / "ept-data";
    const Eigen::AlignedBox3d cube = cubeOf(root);
    std::vector<EptNode> nodes;
    std::size_t all = 0;
    for (const std::string& path : filesOfFolder(folder)) {
        const auto node = nodeOf(path, suffix);
        if (!node) continue;
        ++all;
        if (selectsNode(sink, static_cast<int>(node->key[0]), boxOf(*node, cube))) nodes.push_back(*node);
    }
    if (all == 0) refuse(input, "has no files of points in the folder ept-data beside it");
    if (nodes.empty()) refuse(input, fmt::format("none of its {} nodes is within --bounds", all));
    std::sort(nodes.begin(), nodes.end());
    return nodes;
}

LasCrs crsOf(const JsonValue& root) {
    const auto srs = root.optionalMember("srs");
    if (srs && srs->has("wkt")) return crsOfWkt(srs->member("wkt").text());
    return {};
}

bool haveSameFields(const std::vector<LasField>& a, const std::vector<LasField>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const LasField& one, const LasField& other) {
        return one.name == other.name && one.type == other.type && one.components == other.components;
    });
}

/// Bare records, compressed with zstd or not.
void readRecordNodes(const InputFile& input, const JsonValue& root, bool is_zstd, Sink& sink) {
    EptRecords records(input, root.member("schema"));
    for (const EptNode& node : nodesOf(input, root, is_zstd ? ".zst" : ".bin", sink)) {
        const InputFile part = openInputFile(node.path.string(), NamedBy::kFile);
        std::string unpacked;
        if (is_zstd) unpacked = unpackChunk(part, "zstd", part.bytes, zstdSize(part));
        records.add(part, is_zstd ? unpacked : part.bytes, sink);
    }
    if (!records.hasBegun()) refuse(input, "holds no points");
    sink.finishScan(input);
    setLasFrame(crsOf(root), input, sink);
}

void readLazNodes(const InputFile& input, const JsonValue& root, Sink& sink) {
    std::vector<LasField> first_fields;
    LasCrs crs = crsOf(root);
    bool begun = false;
    for (const EptNode& node : nodesOf(input, root, ".laz", sink)) {
        const InputFile part = openInputFile(node.path.string(), NamedBy::kFile);
        LasFile file = openLasInput(part, sink);
        if (file.header.point_count == 0) continue;
        const std::vector<LasField> fields = lasFields(file);
        LazLayout layout = layoutOfLas(part, file, sink);
        if (!begun) {
            first_fields = fields;
            if (crs.kind == LasCrs::Kind::kUnknown) crs = lasCrs(file);
            sink.beginScan(input, lasTraits(file, fields, 0));
            begun = true;
        }
        if (!haveSameFields(fields, first_fields))
            refuse(part, "has attributes that differ from those of earlier nodes");
        const std::vector<LazChunk> chunks = allLasChunks(file, layout);
        addLasPoints(part, {file, fields, std::move(layout), chunks}, sink);
    }
    if (!begun) refuse(input, "holds no points");
    sink.finishScan(input);
    setLasFrame(crs, input, sink);
}

void readEpt(const InputFile& input, Sink& sink) {
    const nlohmann::json json = parseJson(input, input.bytes);
    const JsonValue root(input, json);
    const std::string& kind = root.member("dataType").text();
    if (kind == "laszip") return readLazNodes(input, root, sink);
    if (kind == "binary" || kind == "zstandard") return readRecordNodes(input, root, kind == "zstandard", sink);
    refuse(input, fmt::format("has points in the form {}; this build reads 'laszip', 'binary' and 'zstandard'",
                              inQuotes(kind)));
}

} // namespace

const FormatReader readers::kEpt{
    .isStart = isEptMeta, .read = readEpt, .readsInBatches = alwaysInBatches, .has_levels = true};

} // namespace pointrt
