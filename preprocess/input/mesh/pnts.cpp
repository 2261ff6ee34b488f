// SPDX-License-Identifier: GPL-3.0-or-later
// Point clouds of 3D Tiles 1.0: https://docs.ogc.org/cs/22-025r4/22-025r4.html#toc38
#include <array>
#include <cmath>
#include <deque>
#include <nlohmann/json.hpp>

#include "preprocess/ingest/field_arrays.h"
#include "preprocess/ingest/formats.h"
#include "preprocess/ingest/json_value.h"
#include "preprocess/ingest/scalar.h"
#include "preprocess/input/mesh/drc.h"

namespace pointrt {
namespace {

constexpr std::string_view kPntsMark = "pnts";
constexpr const char* kDracoExtension = "3DTILES_draco_point_compression";

/// Lengths of the feature table and the batch table: JSON and binary of each.
struct PntsParts {
    std::string_view feature_json, features, batch_json, batches;
};

PntsParts partsOf(const InputFile& input) {
    constexpr std::size_t kHeader = 28;
    if (input.bytes.size() < kHeader) refuse(input, "truncated: a header of pnts has 28 bytes");
    std::array<std::uint64_t, 7> words{}; // mark, version, bytes of the file, of the four parts
    for (std::size_t i = 0; i < words.size(); ++i)
        words[i] = static_cast<std::uint64_t>(loadScalar(input.begin() + 4 * i, Scalar::kU32, false));
    if (words[1] != 1) refuse(input, fmt::format("is pnts of version {}; this build reads version 1", words[1]));
    PntsParts parts;
    std::string_view rest = input.bytes.substr(kHeader);
    std::size_t i = 3;
    for (std::string_view* const part : {&parts.feature_json, &parts.features, &parts.batch_json, &parts.batches}) {
        const std::uint64_t size = words[i++];
        if (size > rest.size()) refuse(input, "truncated: its tables are longer than the file");
        *part = rest.substr(0, size);
        rest.remove_prefix(size);
    }
    return parts;
}

/// Arrays of one table, whose values lie in its binary part.
struct PntsTable {
    const InputFile& input;
    std::string_view bytes;
    std::uint64_t points = 0;
    std::deque<std::vector<float>> decoded; ///< arrays that the file holds in another form

    const char* bytesAt(const JsonValue& value, std::uint64_t size) const {
        const std::uint64_t at = value.member("byteOffset").integer();
        if (at > bytes.size() || size > (bytes.size() - at) / std::max<std::uint64_t>(points, 1))
            value.refuse("lies outside the binary table");
        return bytes.data() + at;
    }
    FieldArray field(const JsonValue& value, const char* name, Scalar type, std::uint32_t components,
                     Dimension dimension) const {
        FieldArray array = denseField(name, type, components, bytesAt(value, scalarSize(type) * components));
        array.dimension = dimension;
        return array;
    }
    FieldArray decodedField(const char* name, std::vector<float> values, Dimension dimension) {
        decoded.push_back(std::move(values));
        FieldArray array = denseField(name, Scalar::kF32, 3, reinterpret_cast<const char*>(decoded.back().data()));
        array.dimension = dimension;
        return array;
    }
};

Vec3d threeNumbers(const JsonValue& value) {
    Vec3d vector;
    if (value.size() != 3) value.refuse("needs 3 numbers");
    for (std::size_t i = 0; i < 3; ++i) vector[static_cast<Eigen::Index>(i)] = value.at(i).number();
    return vector;
}

/// Decodes 16 bits per coordinate, as fractions of the edges of a box.
std::vector<float> decodePositions(const char* at, std::uint64_t points, const Vec3d& size) {
    constexpr double kSteps = 65535;
    std::vector<float> values(3 * points);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = static_cast<float>(loadScalar(at + 2 * i, Scalar::kU16, false) / kSteps *
                                       size[static_cast<Eigen::Index>(i % 3)]);
    return values;
}

/// The positions; and the pose with the corner of their box and the centre of the tile.
FieldArray positionsOf(const JsonValue& root, PntsTable& table, Pose& pose) {
    if (const auto center = root.optionalMember("RTC_CENTER")) pose.translation = threeNumbers(*center);
    if (const auto value = root.optionalMember("POSITION")) return table.field(*value, "points", Scalar::kF32, 3, kX);
    const auto value = root.optionalMember("POSITION_QUANTIZED");
    if (!value) root.refuse("has neither POSITION nor POSITION_QUANTIZED");
    pose.translation += threeNumbers(root.member("QUANTIZED_VOLUME_OFFSET"));
    const Vec3d size = threeNumbers(root.member("QUANTIZED_VOLUME_SCALE"));
    return table.decodedField("points", decodePositions(table.bytesAt(*value, 6), table.points, size), kX);
}

/// Decodes red and blue of 5 bits, green of 6.
std::vector<float> decodeRgb565(const char* at, std::uint64_t points) {
    std::vector<float> values;
    values.reserve(3 * points);
    for (std::uint64_t i = 0; i < points; ++i) {
        const auto bits = static_cast<std::uint32_t>(loadScalar(at + 2 * i, Scalar::kU16, false));
        values.push_back(static_cast<float>(bits >> 11) / 31);
        values.push_back(static_cast<float>(bits >> 5 & 63) / 63);
        values.push_back(static_cast<float>(bits & 31) / 31);
    }
    return values;
}

/// Unit vectors folded into a square (Meyer et al., "On floating-point normal vectors", 2010).
std::vector<float> decodeOctahedral(const char* at, std::uint64_t points) {
    std::vector<float> values;
    values.reserve(3 * points);
    for (std::uint64_t i = 0; i < points; ++i) {
        double x = loadScalar(at + 2 * i, Scalar::kU8, false) / 255 * 2 - 1,
               y = loadScalar(at + 2 * i + 1, Scalar::kU8, false) / 255 * 2 - 1;
        const double z = 1 - std::abs(x) - std::abs(y);
        if (z < 0) {
            const double old = x;
            x = std::copysign(1 - std::abs(y), x);
            y = std::copysign(1 - std::abs(old), y);
        }
        const Vec3d unit = Vec3d(x, y, z).normalized();
        for (Eigen::Index axis = 0; axis < 3; ++axis) values.push_back(static_cast<float>(unit[axis]));
    }
    return values;
}

void addColors(const JsonValue& root, PntsTable& table, std::vector<FieldArray>& fields) {
    if (const auto rgba = root.optionalMember("RGBA"))
        fields.push_back(table.field(*rgba, "colors", Scalar::kU8, 4, kRed));
    else if (const auto rgb = root.optionalMember("RGB"))
        fields.push_back(table.field(*rgb, "colors", Scalar::kU8, 3, kRed));
    else if (const auto packed = root.optionalMember("RGB565"))
        fields.push_back(table.decodedField("colors", decodeRgb565(table.bytesAt(*packed, 2), table.points), kRed));
}

void addNormals(const JsonValue& root, PntsTable& table, std::vector<FieldArray>& fields) {
    if (const auto normal = root.optionalMember("NORMAL"))
        fields.push_back(table.field(*normal, "normals", Scalar::kF32, 3, kNormalX));
    else if (const auto folded = root.optionalMember("NORMAL_OCT16P"))
        fields.push_back(
            table.decodedField("normals", decodeOctahedral(table.bytesAt(*folded, 2), table.points), kNormalX));
}

struct PntsType {
    std::string_view name;
    Scalar scalar;
};
constexpr PntsType kPntsTypes[] = {
    {"BYTE", Scalar::kI8}, {"UNSIGNED_BYTE", Scalar::kU8}, {"SHORT", Scalar::kI16}, {"UNSIGNED_SHORT", Scalar::kU16},
    {"INT", Scalar::kI32}, {"UNSIGNED_INT", Scalar::kU32}, {"FLOAT", Scalar::kF32}, {"DOUBLE", Scalar::kF64}};

/// A property of the batch table with binary values; none for those in JSON.
std::optional<FieldArray> propertyOf(const JsonValue& value, const std::string& name, const PntsTable& table) {
    if (!value.json().is_object() || !value.has("byteOffset")) return std::nullopt;
    const std::string& type = value.member("componentType").text();
    const std::string& shape = value.member("type").text();
    const std::uint32_t components = shape == "SCALAR" ? 1 : shape == "VEC2" ? 2 : shape == "VEC3" ? 3 : 4;
    for (const PntsType& each : kPntsTypes)
        if (each.name == type) return table.field(value, name.c_str(), each.scalar, components, kIgnored);
    value.refuse(fmt::format("{} is not a type of numbers", inQuotes(type)));
}

/// Properties of points; those of groups of points, which BATCH_ID names, are left out and noted.
void addProperties(const InputFile& input, const JsonValue& root, const PntsParts& parts, const PntsTable& table,
                   std::vector<FieldArray>& fields, Sink& sink) {
    if (parts.batch_json.find('{') == std::string_view::npos) return;
    const nlohmann::json json = parseJson(input, parts.batch_json);
    if (!json.is_object() || json.empty()) return;
    if (root.has("BATCH_ID")) return sink.note(input, "properties of groups of points (BATCH_ID) are not read");
    const JsonValue properties(input, json);
    const PntsTable batches{input, parts.batches, table.points, {}};
    for (const auto& item : json.items())
        if (const auto field = propertyOf(properties.member(item.key().c_str()), item.key(), batches))
            fields.push_back(*field);
}

/// The Draco data of the extension; none without it.
std::optional<InputFile> dracoPart(const InputFile& input, const JsonValue& root, std::string_view features,
                                   DracoIds& ids) {
    const auto extensions = root.optionalMember("extensions");
    const auto draco = extensions ? extensions->optionalMember(kDracoExtension) : std::nullopt;
    if (!draco) return std::nullopt;
    const std::uint64_t at = draco->member("byteOffset").integer(), size = draco->member("byteLength").integer();
    if (at > features.size() || size > features.size() - at) draco->refuse("lies outside the binary table");
    const JsonValue properties = draco->member("properties");
    const auto idOf = [&](const char* name) -> std::optional<std::uint32_t> {
        const auto id = properties.optionalMember(name);
        if (!id) return std::nullopt;
        return static_cast<std::uint32_t>(id->integer(UINT32_MAX));
    };
    ids.normals = idOf("NORMAL");
    ids.colors = properties.has("RGBA") ? idOf("RGBA") : idOf("RGB");
    return InputFile{input.name, features.substr(at, size), input.owner, false};
}

/// Up is the direction away from the Earth's centre if the points lie near its surface, as in most tile sets.
void setFrame(const InputFile& input, const Vec3d& center, Sink& sink) {
    constexpr double kLeastRadius = 6.3e6, kMostRadius = 6.4e6; // metres, of places on the ground
    if (center.norm() < kLeastRadius || center.norm() > kMostRadius) return;
    WorldFrame frame;
    frame.up = center.normalized();
    frame.metres_per_unit = 1;
    sink.setWorldFrame(input, frame);
}

void addTables(const InputFile& input, const JsonValue& root, const PntsParts& parts, Sink& sink) {
    PntsTable table{input, parts.features, root.member("POINTS_LENGTH").integer(UINT32_MAX), {}};
    Pose pose;
    std::vector<FieldArray> fields{positionsOf(root, table, pose)};
    addColors(root, table, fields);
    addNormals(root, table, fields);
    addProperties(input, root, parts, table, fields, sink);
    sink.transform.input_from_scan = pose;
    addFieldPoints(input, fields, table.points, sink);
}

bool isPnts(std::string_view bytes) { return bytes.starts_with(kPntsMark); }

void readPnts(const InputFile& input, Sink& sink) {
    if (!isPnts(input.bytes)) refuse(input, "does not start with 'pnts'");
    const PntsParts parts = partsOf(input);
    const nlohmann::json json = parseJson(input, parts.feature_json);
    const JsonValue root(input, json);
    const auto center = root.optionalMember("RTC_CENTER");
    DracoIds ids;
    if (const auto part = dracoPart(input, root, parts.features, ids)) {
        if (center) sink.transform.input_from_scan = Pose{Eigen::Matrix3d::Identity(), threeNumbers(*center)};
        addDraco(*part, ids, sink);
    } else {
        addTables(input, root, parts, sink);
    }
    sink.finishScan(input);
    sink.transform.input_from_scan.reset();
    setFrame(input, sink.lastScanBox().center, sink);
}

} // namespace

const FormatReader readers::kPnts{.isStart = isPnts, .read = readPnts};

} // namespace pointrt
