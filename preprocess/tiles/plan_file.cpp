// SPDX-License-Identifier: GPL-3.0-or-later
// plan.json, and beside it sides.bin, the oriented sample in rows of 3 doubles and 3 floats; traits.json, once points
// are split; and widest.json, once all blocks are baked.

#include <cmath>
#include <concepts>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

#include "format/base/error.h"
#include "format/base/json_integer.h"
#include "format/os/atomic_file.h"
#include "format/os/folder.h"
#include "preprocess/tiles/checksum.h"
#include "preprocess/tiles/plan.h"
#include "preprocess/tiles/plan_check.h"

namespace pointrt {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr int kVersion = 2;

std::string sidesFile(const std::string& work) { return work + "/sides.bin"; }
std::string statisticsFile(const std::string& work) { return work + "/traits.json"; }
std::string widestFile(const std::string& work) { return work + "/widest.json"; }

OrderedJson vectorJson(const Vec3d& vector) { return {vector.x(), vector.y(), vector.z()}; }
template <typename Value>
Value take(const OrderedJson& json, const char* name) {
    if constexpr (std::integral<Value> && !std::same_as<Value, bool>)
        return jsonInteger<Value>(json.at(name));
    else
        return json.at(name).get<Value>();
}

Vec3d vectorOf(const OrderedJson& json) {
    return Vec3d(json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>());
}

void writeWhole(const std::string& path, const std::string& text) {
    format::AtomicFile file;
    if (!file.open(path) || !file.write(text.data(), text.size()) || !file.commit())
        throw Error(ExitCode::kCannotWrite, path + ": " + file.error());
}

std::string readWhole(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    if (!stream) throw Error(ExitCode::kBadInput, path + ": cannot be read; run --step plan first");
    return {std::istreambuf_iterator<char>(stream), {}};
}

constexpr std::size_t kSideBytes = sizeof(Vec3d) + sizeof(Vec3f);

std::string sidesBytes(const PlanSides& sides) {
    std::string bytes(sides.positions.size() * kSideBytes, '\0');
    char* to = bytes.data();
    for (std::size_t i = 0; i < sides.positions.size(); ++i, to += kSideBytes) {
        std::memcpy(to, sides.positions[i].data(), sizeof(Vec3d));
        std::memcpy(to + sizeof(Vec3d), sides.normals[i].data(), sizeof(Vec3f));
    }
    return bytes;
}

PlanSides sidesOf(const std::string& bytes) {
    PlanSides sides;
    const std::size_t count = bytes.size() / kSideBytes;
    sides.positions.resize(count);
    sides.normals.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        std::memcpy(sides.positions[i].data(), bytes.data() + i * kSideBytes, sizeof(Vec3d));
        std::memcpy(sides.normals[i].data(), bytes.data() + i * kSideBytes + sizeof(Vec3d), sizeof(Vec3f));
    }
    return sides;
}

OrderedJson schemaJson(const PlanSchema& schema) {
    OrderedJson attributes = OrderedJson::array();
    for (const PlanAttribute& each : schema.attributes)
        attributes.push_back({{"name", each.name},
                              {"type", static_cast<int>(each.type)},
                              {"components", each.components},
                              {"read_type", static_cast<int>(each.read_type)}});
    return {{"normals", schema.normals},
            {"normal_sides", schema.normal_sides},
            {"colors", schema.colors},
            {"radii", schema.radii},
            {"noise", schema.noise},
            {"silhouettes", schema.silhouettes},
            {"scan_bytes", schema.scan_bytes},
            {"scan_attribute", schema.scan_attribute},
            {"attributes", std::move(attributes)}};
}

PlanSchema schemaOf(const OrderedJson& json) {
    PlanSchema schema;
    schema.normals = take<bool>(json, "normals");
    schema.normal_sides = take<bool>(json, "normal_sides");
    schema.colors = take<bool>(json, "colors");
    schema.radii = take<bool>(json, "radii");
    schema.noise = take<bool>(json, "noise");
    schema.silhouettes = take<bool>(json, "silhouettes");
    schema.scan_bytes = take<std::size_t>(json, "scan_bytes");
    schema.scan_attribute = take<bool>(json, "scan_attribute");
    for (const OrderedJson& each : json.at("attributes"))
        schema.attributes.push_back({take<std::string>(each, "name"), static_cast<Scalar>(take<int>(each, "type")),
                                     take<std::uint32_t>(each, "components"),
                                     static_cast<Scalar>(take<int>(each, "read_type"))});
    return schema;
}

/// The properties that decide which points are left out.
OrderedJson noDataJson(const std::vector<NoData>& no_data) {
    OrderedJson json = OrderedJson::array();
    for (const NoData& each : no_data)
        json.push_back(
            {{"is_origin", each.is_origin}, {"axis", each.axis}, {"is_low", each.is_low}, {"limit", each.limit}});
    return json;
}

std::vector<NoData> noDataOf(const OrderedJson& json) {
    std::vector<NoData> all;
    for (const OrderedJson& each : json) {
        NoData& no_data = all.emplace_back();
        no_data.is_origin = each.contains("is_origin") && take<bool>(each, "is_origin"); // not in older sets
        no_data.axis = take<int>(each, "axis");
        no_data.is_low = take<bool>(each, "is_low");
        no_data.limit = take<double>(each, "limit");
    }
    return all;
}

OrderedJson scansJson(const std::vector<PlanScan>& scans) {
    OrderedJson json = OrderedJson::array();
    for (const PlanScan& each : scans) {
        json.push_back({{"name", each.name}, {"points", each.points}, {"largest_color", each.largest_color}});
        if (each.sensor) json.back()["sensor"] = vectorJson(*each.sensor);
        if (!each.no_data.empty()) json.back()["no_data"] = noDataJson(each.no_data);
    }
    return json;
}

std::vector<PlanScan> scansOf(const OrderedJson& json) {
    std::vector<PlanScan> scans;
    for (const OrderedJson& each : json) {
        PlanScan& scan = scans.emplace_back();
        scan.name = take<std::string>(each, "name");
        scan.points = take<std::uint64_t>(each, "points");
        scan.largest_color = take<float>(each, "largest_color");
        if (each.contains("sensor")) scan.sensor = vectorOf(each.at("sensor"));
        if (each.contains("no_data")) scan.no_data = noDataOf(each.at("no_data"));
    }
    return scans;
}

OrderedJson inputsJson(const std::vector<PlanInput>& inputs) {
    OrderedJson json = OrderedJson::array();
    for (const PlanInput& each : inputs)
        json.push_back({{"path", each.path},
                        {"format", each.format},
                        {"bytes", each.bytes},
                        {"modified_ns", each.modified_ns},
                        {"points", each.points},
                        {"kept", each.kept},
                        {"scans", each.scans}});
    return json;
}

std::vector<PlanInput> inputsOf(const OrderedJson& json) {
    std::vector<PlanInput> inputs;
    for (const OrderedJson& each : json)
        inputs.push_back({take<std::string>(each, "path"), take<std::string>(each, "format"),
                          take<std::uint64_t>(each, "bytes"), take<std::int64_t>(each, "modified_ns"),
                          take<std::uint64_t>(each, "points"), take<std::uint64_t>(each, "kept"),
                          take<std::uint64_t>(each, "scans"), 0});
    return inputs;
}

/// A row of numbers per tile, compact: a country has 10^5 of them.
OrderedJson tilesJson(const std::vector<PlanTile>& tiles) {
    OrderedJson json = OrderedJson::array();
    for (const PlanTile& each : tiles)
        json.push_back(
            OrderedJson::array({each.level, each.cell[0], each.cell[1], each.cell[2], each.points, each.spacing}));
    return json;
}

std::vector<PlanTile> tilesOf(const OrderedJson& json) {
    std::vector<PlanTile> tiles;
    for (const OrderedJson& each : json)
        tiles.push_back({jsonInteger<std::uint32_t>(each.at(0)),
                         {jsonInteger<std::int32_t>(each.at(1)), jsonInteger<std::int32_t>(each.at(2)),
                          jsonInteger<std::int32_t>(each.at(3))},
                         jsonInteger<std::uint64_t>(each.at(4)),
                         each.at(5).get<double>()});
    return tiles;
}

OrderedJson worldJson(const SetPlan& plan) {
    const WorldFrame& world = plan.world;
    return {{"up", vectorJson(world.up)},
            {"up_by_custom", world.up_by_custom},
            {"up_from", plan.up_from},
            {"up_reason", plan.up_reason},
            {"metres", world.metres_per_unit},
            {"from_above", world.from_above},
            {"crs", world.crs}};
}

void takeWorld(const OrderedJson& json, SetPlan& plan) {
    plan.world.up = vectorOf(json.at("up"));
    plan.world.up_by_custom = take<bool>(json, "up_by_custom");
    plan.up_from = take<std::string>(json, "up_from");
    plan.up_reason = take<std::string>(json, "up_reason");
    plan.world.metres_per_unit = take<double>(json, "metres");
    plan.world.from_above = take<bool>(json, "from_above");
    plan.world.crs = take<std::string>(json, "crs");
}

OrderedJson notesJson(const std::vector<Note>& notes) {
    OrderedJson json = OrderedJson::array();
    for (const Note& each : notes)
        json.push_back({{"file", each.file}, {"text", each.text}, {"more_files", each.more_files}});
    return json;
}

OrderedJson planJson(const SetPlan& plan, std::uint64_t sides_xxh3) {
    OrderedJson json;
    json["version"] = kVersion;
    json["output"] = plan.output;
    json["settings"] = plan.settings;
    json["inputs"] = inputsJson(plan.inputs);
    json["points"] = {{"kept", plan.points},
                      {"read", plan.points_read},
                      {"non_finite", plan.points_non_finite},
                      {"filtered", plan.points_filtered},
                      {"stray", plan.points_stray}};
    json["bounds"] = {vectorJson(plan.bounds.min()), vectorJson(plan.bounds.max())};
    json["lattice_origin"] = vectorJson(plan.lattice_origin);
    json["edge"] = plan.edge;
    json["levels"] = plan.levels;
    json["world"] = worldJson(plan);
    json["orient"] = static_cast<int>(plan.orient);
    json["sides"] = {{"count", plan.sides.positions.size()}, {"xxh3", sides_xxh3}};
    json["schema"] = schemaJson(plan.schema);
    json["scans"] = scansJson(plan.scans);
    json["source_header"] = plan.source_header;
    json["notes"] = notesJson(plan.notes);
    json["first_tile_of_block"] = plan.first_tile_of_block;
    json["tiles"] = tilesJson(plan.tiles);
    return json;
}

SetPlan planOf(const OrderedJson& json) {
    SetPlan plan;
    plan.output = take<std::string>(json, "output");
    plan.settings = take<std::string>(json, "settings");
    plan.inputs = inputsOf(json.at("inputs"));
    const OrderedJson& points = json.at("points");
    plan.points = take<std::uint64_t>(points, "kept");
    plan.points_read = take<std::uint64_t>(points, "read");
    plan.points_non_finite = take<std::uint64_t>(points, "non_finite");
    plan.points_filtered = take<std::uint64_t>(points, "filtered");
    plan.points_stray = take<std::uint64_t>(points, "stray");
    plan.bounds = PlanBox(vectorOf(json.at("bounds").at(0)), vectorOf(json.at("bounds").at(1)));
    plan.lattice_origin = vectorOf(json.at("lattice_origin"));
    plan.edge = take<double>(json, "edge");
    plan.levels = take<std::uint32_t>(json, "levels");
    takeWorld(json.at("world"), plan);
    plan.orient = static_cast<OrientMode>(take<int>(json, "orient"));
    plan.schema = schemaOf(json.at("schema"));
    plan.scans = scansOf(json.at("scans"));
    plan.source_header = take<std::string>(json, "source_header");
    for (const OrderedJson& each : json.at("notes"))
        plan.notes.push_back(
            {take<std::string>(each, "file"), take<std::string>(each, "text"), take<std::size_t>(each, "more_files")});
    for (const OrderedJson& each : json.at("first_tile_of_block"))
        plan.first_tile_of_block.push_back(jsonInteger<std::uint32_t>(each));
    plan.tiles = tilesOf(json.at("tiles"));
    return plan;
}

template <typename Value>
OrderedJson jsonOf(const std::optional<Value>& value) {
    return value ? OrderedJson(*value) : OrderedJson();
}

template <typename Value>
std::optional<Value> takeMaybe(const OrderedJson& json, const char* name) {
    return json.at(name).is_null() ? std::nullopt : std::optional<Value>(take<Value>(json, name));
}

std::optional<float> finestCells(const CloudStatistics& statistics) {
    return statistics.thinning ? std::optional(statistics.thinning->finest_cells) : std::nullopt;
}

std::optional<surface::Thinning> thinningIn(const OrderedJson& json) {
    const auto finest_cells = takeMaybe<float>(json, "finest_cells");
    if (!finest_cells) return std::nullopt;
    return surface::Thinning{*finest_cells, take<bool>(json, "replaces_lists"), json.value("is_noisy", false),
                             json.value("has_gaps", false)};
}

/// Empty before the statistics are measured.
CloudStatistics readStatistics(const std::string& work) {
    std::ifstream stream(statisticsFile(work));
    if (!stream) return {};
    const OrderedJson json = OrderedJson::parse(stream);
    return {json.at("noise").get<std::vector<float>>(),
            takeMaybe<bool>(json, "scattered"),
            takeMaybe<std::uint32_t>(json, "fill_rows"),
            takeMaybe<float>(json, "radius_limit"),
            takeMaybe<float>(json, "common_reach"),
            json.value("volume", false),
            thinningIn(json)};
}

void requireSame(bool same, const std::string& path) {
    if (!same) throw Error(ExitCode::kBadInput, path + ": does not belong to the plan");
}

} // namespace

void writePlan(const SetPlan& plan) {
    const std::string sides = sidesBytes(plan.sides);
    writeWhole(sidesFile(plan.work), sides);
    // names may be invalid UTF-8
    const std::string text = planJson(plan, XXH3_64bits(sides.data(), sides.size()))
                                 .dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
    writeWhole(planFile(plan.work), text + "\n");
}

void writeMark(const std::string& path) { writeWhole(path, "{}\n"); }

void makeFolder(const std::string& path) {
    std::error_code failure;
    std::filesystem::create_directories(path, failure);
    if (failure) throw Error(ExitCode::kCannotWrite, path + ": " + failure.message());
}

void removeTree(const std::string& path) {
    std::error_code failure;
    removeAll(path, failure);
    if (failure) throw Error(ExitCode::kCannotWrite, path + ": " + failure.message());
}

void writeStatistics(const SetPlan& plan, const CloudStatistics& statistics) {
    const OrderedJson json = {{"noise", statistics.noise},
                              {"scattered", jsonOf(statistics.scattered)},
                              {"fill_rows", jsonOf(statistics.fill_rows)},
                              {"radius_limit", jsonOf(statistics.radius_limit)},
                              {"common_reach", jsonOf(statistics.common_reach)},
                              {"volume", statistics.volume},
                              {"finest_cells", jsonOf(finestCells(statistics))},
                              {"replaces_lists", statistics.thinning && statistics.thinning->replaces_lists},
                              {"is_noisy", statistics.thinning && statistics.thinning->is_noisy},
                              {"has_gaps", statistics.thinning && statistics.thinning->has_gaps}};
    writeWhole(statisticsFile(plan.work), json.dump() + "\n");
}

void writeWidestRadius(const SetPlan& plan, float radius) {
    const std::optional<float> limit = std::isfinite(radius) ? std::optional(radius) : std::nullopt;
    writeWhole(widestFile(plan.work), OrderedJson({{"radius", jsonOf(limit)}}).dump() + "\n");
}

std::optional<float> readWidestRadius(const SetPlan& plan) {
    const std::string path = widestFile(plan.work);
    std::ifstream stream(path);
    if (!stream) return std::nullopt;
    try {
        const float radius =
            takeMaybe<float>(OrderedJson::parse(stream), "radius").value_or(std::numeric_limits<float>::infinity());
        if (radius > 0) return radius;
    } catch (const OrderedJson::exception&) {
    }
    throw Error(ExitCode::kBadInput, path + ": is not a file of this program");
}

SetPlan readPlan(const std::string& work) {
    const std::string path = planFile(work), text = readWhole(path);
    const OrderedJson json = OrderedJson::parse(text, nullptr, false);
    try {
        if (json.at("version") != kVersion) throw Error(ExitCode::kBadInput, path + ": has another version");
        SetPlan plan = planOf(json);
        plan.work = work;
        const std::string sides = readWhole(sidesFile(work));
        requireSame(XXH3_64bits(sides.data(), sides.size()) == take<std::uint64_t>(json.at("sides"), "xxh3"),
                    sidesFile(work));
        plan.sides = sidesOf(sides);
        plan.statistics = readStatistics(work);
        const std::string fault = findPlanFault(plan);
        if (!fault.empty()) throw Error(ExitCode::kBadInput, path + ": is not a valid plan: " + fault);
        return plan;
    } catch (const OrderedJson::exception&) {
        throw Error(ExitCode::kBadInput, path + ": is not a plan of this program");
    }
}

} // namespace pointrt
