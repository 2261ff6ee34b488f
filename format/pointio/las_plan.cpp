// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/las_plan.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "format/base/number_type.h"
#include "format/pointio/bytes.h"
#include "format/pointio/metadata.h"

namespace pointrt {
namespace {

using Json = nlohmann::ordered_json;

/// Bits of the header's global encoding: waveforms, and coordinate system in WKT.
constexpr std::uint16_t kWaveformBits = 0b110, kWktBit = 0b10000;

bool isReal(std::uint32_t type) { return type >= PRO_TYPE_F32; }

bool hasSign(std::uint32_t type) { return type == PRO_TYPE_I8 || type == PRO_TYPE_I16 || type == PRO_TYPE_I32; }

/// The range of an integer field.
std::array<double, 2> limitsOf(const LasField& field) {
    const double bits = static_cast<double>(8 * pro_type_bytes(field.type));
    const double most = field.mask != 0 ? field.mask : std::exp2(hasSign(field.type) ? bits - 1 : bits) - 1;
    return {hasSign(field.type) ? -most - 1 : 0, most};
}

/// Whether all values are in memory and integers.
bool areWhole(const PointColumn& column) {
    if (!column.values) return false; // as for tile sets; the values are not worth reading just for this
    return withType(column.type, [&](auto number) {
        const auto* values = static_cast<const decltype(number)*>(column.values);
        return std::all_of(values, values + column.value_rows * column.components, [](auto each) {
            const auto value = static_cast<double>(each);
            return value == std::trunc(value) && !(value == 0 && std::signbit(value));
        });
    });
}

/// Whether an unscaled field holds every value of a column exactly.
bool holds(const LasField& field, const PointColumn& column) {
    if (field.components != column.components) return false;
    if (field.type == column.type && field.mask == 0) return true;
    if (isReal(field.type)) return !isReal(column.type) && pro_type_bytes(column.type) <= 4; // exact in a double
    if (!column.range) return false;
    const auto [least, most] = limitsOf(field);
    if ((*column.range)[0] < least || (*column.range)[1] > most) return false;
    return !isReal(column.type) || areWhole(column);
}

bool isAttribute(const PointColumn& column) { return column.role == PointRole::kAttribute; }

/// The attribute column of this name; null if points has none.
const PointColumn* attributeOf(const PointOutline& points, std::string_view name) {
    const auto found = std::find_if(points.columns.begin(), points.columns.end(),
                                    [&](const PointColumn& each) { return isAttribute(each) && name == each.name; });
    return found == points.columns.end() ? nullptr : &*found;
}

/// The index of the colour column; points.columns.size() if points has none.
std::size_t colorColumn(const PointOutline& points) {
    const auto found = std::find_if(points.columns.begin(), points.columns.end(),
                                    [](const PointColumn& each) { return each.role == PointRole::kColor; });
    return static_cast<std::size_t>(found - points.columns.begin());
}

bool hasColors(const PointOutline& points) { return colorColumn(points) < points.columns.size(); }

/// Whether the attribute exists and may exceed the fields of formats 0 to 5.
bool exceedsOld(const PointOutline& points, const char* name, double most) {
    const PointColumn* const attribute = attributeOf(points, name);
    if (!attribute) return false;
    if (!attribute->range) return attribute->type == PRO_TYPE_U8;
    const double high = (*attribute->range)[1];
    return high > most && high <= 255;
}

/// The smallest point format with all of these attributes; 6 or later if the source had one of these.
std::uint8_t chooseFormat(const PointOutline& points, const std::optional<LasSource>& source) {
    const auto has = [&](const char* name) { return attributeOf(points, name) != nullptr; };
    const std::uint8_t before = source ? source->header.point_format : 0;
    const bool fresh = before >= 6 || has("overlap") || has("scanner_channel") || has("scan_angle") || has("nir") ||
                       exceedsOld(points, "classification", 31) || exceedsOld(points, "return_number", 7) ||
                       exceedsOld(points, "number_of_returns", 7);
    const bool colors = has("rgb16") || hasColors(points);
    if (fresh) return has("nir") || before == 8 || before == 10 ? 8 : colors || before == 7 ? 7 : 6;
    const bool time = has("gps_time") || before == 1 || before >= 3;
    return static_cast<std::uint8_t>((colors || before == 2 || before == 3 || before == 5 ? 2 : 0) + (time ? 1 : 0));
}

LasSource::Record recordOf(std::string_view user, std::uint16_t id, const std::string& data) {
    LasSource::Record record;
    record.vlr.user_id = user;
    record.vlr.record_id = id;
    record.data = data;
    return record;
}

// ---- extra bytes ----

/// The descriptor of an extra bytes attribute.
/// @param type of the specification
std::string descriptorOf(std::uint8_t type, std::uint8_t options, const std::string& name) {
    std::string bytes(kDescriptorBytes, '\0');
    bytes[2] = static_cast<char>(type);
    bytes[3] = static_cast<char>(options);
    bytes.replace(4, std::min<std::size_t>(name.size(), 32), name.substr(0, 32));
    return bytes;
}

/// The type in the specification: 1 to 10, plus 10 for each further component.
std::uint8_t extraType(const PointColumn& attribute) {
    constexpr std::uint8_t kTypes[] = {2, 1, 4, 3, 6, 5, 8, 7, 9, 10}; // from PRO_TYPE_I8
    return static_cast<std::uint8_t>(kTypes[attribute.type - PRO_TYPE_I8] + 10 * (attribute.components - 1));
}

/// A field for an attribute that the source lacks. LAS has no type with four components, so these become undescribed
/// bytes.
std::string newExtraField(const PointColumn& attribute, bool name_taken, LasField& field) {
    field.name = attribute.name;
    if (name_taken) field.name += "_2"; // the LAS field of this name cannot hold these numbers
    field.type = field.raw_type = attribute.type;
    field.components = attribute.components;
    field.extra = true;
    if (attribute.components > 3) {
        const std::size_t bytes = fieldBytes(field);
        return descriptorOf(0, static_cast<std::uint8_t>(bytes), field.name);
    }
    return descriptorOf(extraType(attribute), 0, field.name);
}

/// The fields of the source's extra bytes.
std::vector<LasField> sourceExtraFields(const std::optional<LasSource>& source) {
    if (!source) return {};
    LasFile file;
    file.header = source->header;
    for (const LasSource::Record& record : source->records) {
        file.vlrs.push_back(record.vlr);
        file.vlrs.back().data = record.data;
    }
    std::vector<LasField> fields = lasFields(file);
    std::erase_if(fields, [](const LasField& field) { return !field.extra; });
    return fields;
}

/// Repeats the source's descriptor. Joins consecutive attributes of four undescribed bytes.
/// @param before name of the previous field in the source
void describeAgain(const LasField& field, const std::string& before, const LasExport& plan, std::string& descriptors) {
    constexpr std::size_t kType = 2, kOptions = 3;
    const bool bare = field.descriptor[kType] == 0;
    const auto bytes = static_cast<char>(field.components);
    if (bare && field.continues && !plan.columns.empty() && plan.columns.back().field.name == before) {
        char& options = descriptors[descriptors.size() - kDescriptorBytes + kOptions];
        options = static_cast<char>(options + bytes);
        return;
    }
    descriptors += field.descriptor;
    if (bare) descriptors[descriptors.size() - kDescriptorBytes + kOptions] = bytes;
}

/// Appends an attribute to the extra bytes of the record.
void addExtra(const PointOutline& points, std::size_t number, const std::vector<LasField>& known, LasExport& plan,
              std::string& descriptors) {
    const PointColumn& attribute = points.columns[number];
    const auto same = std::find_if(known.begin(), known.end(), [&](const LasField& field) {
        return field.name == attribute.name && field.type == attribute.type && field.components == attribute.components;
    });
    LasField field;
    if (same != known.end() && !same->descriptor.empty()) {
        field = *same;
        describeAgain(field, same == known.begin() ? "" : (same - 1)->name, plan, descriptors);
    } else {
        const bool taken = std::any_of(plan.fields.begin(), plan.fields.end(),
                                       [&](const LasField& each) { return each.name == attribute.name; });
        descriptors += newExtraField(attribute, taken, field);
    }
    LasHeader& header = plan.description.header;
    field.at = header.record_bytes;
    header.record_bytes =
        static_cast<std::uint16_t>(header.record_bytes + field.components * pro_type_bytes(field.raw_type));
    plan.columns.push_back({field, number});
}

/// Null if the field is in use or the point format lacks it.
const LasField* unusedField(const LasExport& plan, const char* name) {
    const bool used = std::any_of(plan.columns.begin(), plan.columns.end(), [&](const LasColumn& column) {
        return column.field.name == name && !column.field.extra;
    });
    for (const LasField& field : plan.fields)
        if (field.name == name && !used) return &field;
    return nullptr;
}

void planIntensity(const PointOutline& points, LasExport& plan) {
    const PointColumn* const intensity = attributeOf(points, "intensity");
    const LasField* const field = unusedField(plan, "intensity");
    if (!intensity || !field || !intensity->range || intensity->components != 1) return;
    const auto number = static_cast<std::size_t>(intensity - points.columns.data());
    plan.intensity = ScaledLasColumn{{*field, number}, *intensity->range};
}

void planColumns(const PointOutline& points, const std::optional<LasSource>& source, LasExport& plan) {
    plan.fields = lasFields(plan.description.header.point_format);
    const std::vector<LasField> known = sourceExtraFields(source);
    std::string descriptors;
    for (std::size_t i = 0; i < points.columns.size(); ++i) {
        const PointColumn& column = points.columns[i];
        if (!isAttribute(column)) continue;
        const auto field = std::find_if(plan.fields.begin(), plan.fields.end(),
                                        [&](const LasField& each) { return each.name == column.name; });
        if (field != plan.fields.end() && holds(*field, column))
            plan.columns.push_back({*field, i});
        else
            addExtra(points, i, known, plan, descriptors);
    }
    if (!descriptors.empty())
        plan.description.records.push_back(recordOf(kLasSpecUser, kExtraBytesRecord, descriptors));
    plan.color_column = colorColumn(points);
    if (hasColors(points)) plan.colors = unusedField(plan, "rgb16");
    if (!attributeOf(points, "return_number")) plan.returns = unusedField(plan, "return_number");
    planIntensity(points, plan);
}

// ---- header ----

bool fits(const PointOutline& points, const LasHeader& header) {
    constexpr double kMost = std::numeric_limits<std::int32_t>::max();
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const double end : {points.bounds_min[axis], points.bounds_max[axis]})
            if (!(std::abs((end - header.offset[axis]) / header.scale[axis]) < kMost)) return false;
    return true;
}

/// Uses decimal digits: pow() of different systems' libraries differs in the last bit.
double powerOfTen(double exponent) {
    const std::string text = "1e" + std::to_string(static_cast<int>(exponent));
    double power = 0;
    std::from_chars(text.data(), text.data() + text.size(), power);
    return power;
}

/// The power of ten in (0.1, 1] times position_step: rounding adds at most half of it.
void chooseScale(const PointOutline& points, LasHeader& header) {
    const double step = std::max(points.position_step, std::numeric_limits<double>::min());
    for (std::size_t axis = 0; axis < 3; ++axis) {
        header.scale[axis] = powerOfTen(std::floor(std::log10(step)));
        header.offset[axis] = std::floor(points.bounds_min[axis]);
        // large coordinates need a coarser step to fit in 32 bits
        if ((points.bounds_min[axis] - header.offset[axis]) / header.scale[axis] > 1e9)
            header.offset[axis] = points.bounds_min[axis];
    }
}

/// GeoTIFF keys that name an EPSG system.
std::string geoKeys(std::uint16_t code, bool projected) {
    const std::uint16_t kind = projected ? 1 : 2, key = projected ? 3072 : 2048;
    const std::uint16_t words[] = {1, 1, 0, 2, 1024, 0, 1, kind, key, 0, 1, code};
    return {reinterpret_cast<const char*>(words), sizeof words};
}

/// The coordinate system of a scan that did not come from a LAS file.
void describeCrs(const PointOutline& points, const Json& metadata, LasDescription& description) {
    const Json world = metadata.is_object() ? metadata.value("world", Json::object()) : Json::object();
    const std::string crs = world.is_object() && world.contains("crs") && world["crs"].is_string()
                                ? world["crs"].get<std::string>()
                                : std::string();
    if (crs.empty()) return;
    if (crs.starts_with("EPSG:")) {
        const auto code = static_cast<std::uint16_t>(std::strtoul(crs.c_str() + 5, nullptr, 10));
        description.records.push_back(recordOf(kLasCrsUser, kGeoKeysRecord, geoKeys(code, points.metres_per_unit > 0)));
        return;
    }
    description.header.global_encoding |= kWktBit;
    description.records.push_back(recordOf(kLasCrsUser, kWktRecord, crs + '\0'));
}

std::optional<LasSource> sourceOf(const Json& metadata) {
    if (!metadata.is_object() || !metadata.contains("source_header")) return std::nullopt;
    return parseLasSource(dumpJson(metadata["source_header"], false));
}

void describe(const PointOutline& points, const Json& metadata, const std::optional<LasSource>& source,
              LasDescription& description) {
    LasHeader& header = description.header;
    description.header_bytes = source ? source->header_bytes : std::string(227, '\0');
    constexpr std::size_t kSoftware = 58, kSoftwareBytes = 32;
    std::string software = points.program;
    software.resize(kSoftwareBytes, '\0');
    description.header_bytes.replace(kSoftware, kSoftwareBytes, software);
    header.version_minor =
        source ? std::clamp<std::uint8_t>(source->header.version_minor, 2, 4) : 2; // 1.5 is read, not written
    header.global_encoding = source ? source->header.global_encoding & static_cast<std::uint16_t>(~kWaveformBits) : 0;
    if (source) {
        header.scale = source->header.scale;
        header.offset = source->header.offset;
        for (const LasSource::Record& record : source->records)
            if (record.vlr.user_id != kLasSpecUser || record.vlr.record_id != kExtraBytesRecord)
                description.records.push_back(record);
    } else {
        describeCrs(points, metadata, description);
    }
    if (!source || !points.keeps_source_scale || !fits(points, header)) chooseScale(points, header);
}

} // namespace

LasExport planLas(const PointOutline& points, bool packed) {
    const Json metadata = parseMetadata(points.metadata);
    const std::optional<LasSource> source = sourceOf(metadata);
    LasExport plan;
    LasHeader& header = plan.description.header;
    describe(points, metadata, source, plan.description);
    header.packed = packed;
    header.point_format = chooseFormat(points, source);
    header.record_bytes = lasRecordBytes(header.point_format);
    planColumns(points, source, plan);
    const bool has_extra = header.record_bytes > lasRecordBytes(header.point_format);
    header.point_count = points.count.value_or(0);
    const bool may_be_many = points.count.value_or(UINT64_MAX) > std::numeric_limits<std::uint32_t>::max();
    if (header.point_format >= 6 || (has_extra && !source) || may_be_many) header.version_minor = 4;
    return plan;
}

} // namespace pointrt
