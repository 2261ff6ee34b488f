// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/las_fields.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "format/base/number_type.h"
#include "format/base/unique_name.h"
#include "format/pointio/bytes.h"
#include "pointrt/pro_layout.h"

namespace pointrt {
namespace {

constexpr bool kMinorField = true;

LasField byteField(const char* name, std::uint32_t type, std::size_t at, bool minor = false) {
    LasField field;
    field.name = name;
    field.type = field.raw_type = type;
    field.at = at;
    field.minor = minor;
    return field;
}

/// A bit field of the byte at `at`.
LasField bitField(const char* name, std::size_t at, std::uint8_t shift, std::uint8_t count, bool minor = false) {
    LasField field = byteField(name, PRO_TYPE_U8, at, minor);
    field.shift = shift;
    field.mask = static_cast<std::uint8_t>((1 << count) - 1);
    return field;
}

/// Formats 0 to 5.
void addOldFields(std::vector<LasField>& fields) {
    const LasField all[] = {
        byteField("intensity", PRO_TYPE_U16, 12),
        bitField("return_number", 14, 0, 3),
        bitField("number_of_returns", 14, 3, 3),
        bitField("scan_direction_flag", 14, 6, 1, kMinorField),
        bitField("edge_of_flight_line", 14, 7, 1, kMinorField),
        bitField("classification", 15, 0, 5),
        bitField("synthetic", 15, 5, 1, kMinorField),
        bitField("key_point", 15, 6, 1, kMinorField),
        bitField("withheld", 15, 7, 1, kMinorField),
        byteField("scan_angle_rank", PRO_TYPE_I8, 16),
        byteField("user_data", PRO_TYPE_U8, 17, kMinorField),
        byteField("point_source_id", PRO_TYPE_U16, 18, kMinorField),
    };
    fields.insert(fields.end(), std::begin(all), std::end(all));
}

/// Formats 6 to 10.
void addNewFields(std::vector<LasField>& fields) {
    const LasField all[] = {
        byteField("intensity", PRO_TYPE_U16, 12),
        bitField("return_number", 14, 0, 4),
        bitField("number_of_returns", 14, 4, 4),
        bitField("synthetic", 15, 0, 1, kMinorField),
        bitField("key_point", 15, 1, 1, kMinorField),
        bitField("withheld", 15, 2, 1, kMinorField),
        bitField("overlap", 15, 3, 1, kMinorField),
        bitField("scanner_channel", 15, 4, 2, kMinorField),
        bitField("scan_direction_flag", 15, 6, 1, kMinorField),
        bitField("edge_of_flight_line", 15, 7, 1, kMinorField),
        byteField("classification", PRO_TYPE_U8, 16),
        byteField("user_data", PRO_TYPE_U8, 17, kMinorField),
        byteField("scan_angle", PRO_TYPE_I16, 18),
        byteField("point_source_id", PRO_TYPE_U16, 20, kMinorField),
        byteField("gps_time", PRO_TYPE_F64, 22),
    };
    fields.insert(fields.end(), std::begin(all), std::end(all));
}

LasField rgb(std::size_t at) {
    LasField field = byteField("rgb16", PRO_TYPE_U16, at);
    field.components = 3;
    return field;
}

/// A descriptor in the extra bytes record: 192 bytes.
struct Descriptor {
    std::uint8_t type, options; ///< for type 0, options is the number of bytes
    std::string name;
    double scale[3], offset[3];

    explicit Descriptor(std::string_view bytes)
        : type(loadAt<std::uint8_t>(bytes, 2)), options(loadAt<std::uint8_t>(bytes, 3)),
          name(fieldText(bytes.substr(4, 32))) {
        for (std::size_t i = 0; i < 3; ++i) {
            scale[i] = loadAt<double>(bytes, 112 + 8 * i);
            offset[i] = loadAt<double>(bytes, 136 + 8 * i);
        }
    }
    bool hasScale() const { return type != 0 && (options & 8) != 0; }
    bool hasOffset() const { return type != 0 && (options & 16) != 0; }
};

/// Types 1 to 10 in the order of the specification; 11 to 20 have two components, 21 to 30 three.
constexpr std::uint32_t kExtraTypes[] = {PRO_TYPE_U8,  PRO_TYPE_I8,  PRO_TYPE_U16, PRO_TYPE_I16, PRO_TYPE_U32,
                                         PRO_TYPE_I32, PRO_TYPE_U64, PRO_TYPE_I64, PRO_TYPE_F32, PRO_TYPE_F64};
constexpr std::uint8_t kLastExtraType = 30;

LasField describedField(const Descriptor& descriptor, std::size_t at) {
    LasField field;
    field.name = descriptor.name;
    field.extra = true;
    field.at = at;
    field.type = field.raw_type = kExtraTypes[(descriptor.type - 1) % 10];
    field.components = 1 + (descriptor.type - 1) / 10;
    for (std::size_t i = 0; i < field.components; ++i) {
        const double scale = descriptor.hasScale() ? descriptor.scale[i] : 1;
        const double offset = descriptor.hasOffset() ? descriptor.offset[i] : 0;
        if (!std::isfinite(scale) || scale == 0 || !std::isfinite(offset)) return field; // keeps raw numbers
        field.multiply[i] = scale;
        field.add[i] = offset;
    }
    field.scaled = descriptor.hasScale() || descriptor.hasOffset();
    if (field.scaled) field.type = PRO_TYPE_F64;
    return field;
}

/// Makes the name valid and unique.
void settleName(std::string& name, const std::vector<LasField>& fields) {
    name = uniqueName(name.empty() ? "ExtraBytes" : name, PRO_ATTRIBUTE_NAME_MAX, [&](const std::string& each) {
        return std::any_of(fields.begin(), fields.end(), [&](const LasField& field) { return field.name == each; });
    });
}

/// Largest number of undescribed bytes per point to keep.
constexpr std::size_t kMostBareBytes = 16;

/// @param descriptor of the bytes; "" if the file has none
void addBareBytes(LasFile& file, std::vector<LasField>& fields, const std::string& name, std::string_view descriptor,
                  std::size_t at, std::size_t bytes) {
    if (bytes > kMostBareBytes)
        file.notes.push_back(
            fmt::format("has {} undescribed bytes per point; only the first {} are kept", bytes, kMostBareBytes));
    bytes = std::min(bytes, kMostBareBytes);
    for (std::size_t done = 0; done < bytes; done += PRO_ATTRIBUTE_COMPONENTS_MAX) {
        LasField field = byteField(name.c_str(), PRO_TYPE_U8, at + done);
        field.extra = true;
        field.components =
            static_cast<std::uint32_t>(std::min<std::size_t>(PRO_ATTRIBUTE_COMPONENTS_MAX, bytes - done));
        settleName(field.name, fields);
        field.descriptor = descriptor;
        field.continues = done > 0;
        fields.push_back(field);
    }
}

void addExtraFields(LasFile& file, std::vector<LasField>& fields) {
    std::size_t at = lasRecordBytes(file.header.point_format);
    const std::size_t end = file.header.record_bytes;
    const LasVlr* const vlr = findVlr(file, kLasSpecUser, kExtraBytesRecord);
    std::string_view rest = vlr ? vlr->data : std::string_view{};
    for (; rest.size() >= kDescriptorBytes && at < end; rest.remove_prefix(kDescriptorBytes)) {
        const Descriptor descriptor(rest);
        if (descriptor.type > kLastExtraType) break; // of unknown size, so the next field cannot be located
        if (descriptor.type == 0) {
            const std::size_t bytes = std::min<std::size_t>(descriptor.options, end - at);
            addBareBytes(file, fields, descriptor.name, rest.substr(0, kDescriptorBytes), at, bytes);
            at += bytes;
            continue;
        }
        LasField field = describedField(descriptor, at);
        const std::size_t bytes = field.components * pro_type_bytes(field.raw_type);
        if (bytes > end - at) break;
        settleName(field.name, fields);
        field.descriptor = rest.substr(0, kDescriptorBytes);
        fields.push_back(field);
        at += bytes;
    }
    if (at < end) addBareBytes(file, fields, "ExtraBytes", "", at, end - at);
}

template <std::size_t kSize>
void copyOut(const char* from, std::size_t stride, std::size_t count, char* to) {
    for (std::size_t i = 0; i < count; ++i) std::memcpy(to + i * kSize, from + i * stride, kSize);
}

/// Loops with a fixed size for common sizes, which the compiler unrolls.
void copyOut(const char* from, std::size_t stride, std::size_t count, std::size_t size, char* to) {
    switch (size) {
    case 1:
        return copyOut<1>(from, stride, count, to);
    case 2:
        return copyOut<2>(from, stride, count, to);
    case 4:
        return copyOut<4>(from, stride, count, to);
    case 6:
        return copyOut<6>(from, stride, count, to);
    case 8:
        return copyOut<8>(from, stride, count, to);
    default:
        for (std::size_t i = 0; i < count; ++i) std::memcpy(to + i * size, from + i * stride, size);
    }
}

template <typename Number>
void unpackScaled(const LasField& field, const char* records, std::size_t stride, std::size_t count, char* values) {
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t c = 0; c < field.components; ++c) {
            Number raw;
            std::memcpy(&raw, records + i * stride + field.at + c * sizeof raw, sizeof raw);
            const double value = field.add[c] + field.multiply[c] * static_cast<double>(raw);
            std::memcpy(values + (i * field.components + c) * sizeof value, &value, sizeof value);
        }
}

/// The raw number whose value is nearest, clamped to the range of its type.
template <typename Number>
Number rawOf(double value) {
    if constexpr (std::is_floating_point_v<Number>) return static_cast<Number>(value);
    const double rounded = std::nearbyint(value);
    if (!(rounded > static_cast<double>(std::numeric_limits<Number>::lowest())))
        return std::isnan(rounded) ? Number{0} : std::numeric_limits<Number>::lowest();
    if (rounded >= static_cast<double>(std::numeric_limits<Number>::max())) return std::numeric_limits<Number>::max();
    return static_cast<Number>(rounded);
}

template <typename Number>
void packScaled(const LasField& field, const char* values, std::size_t stride, std::size_t count, char* records) {
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t c = 0; c < field.components; ++c) {
            double value;
            std::memcpy(&value, values + (i * field.components + c) * sizeof value, sizeof value);
            const Number raw = rawOf<Number>((value - field.add[c]) / field.multiply[c]);
            std::memcpy(records + i * stride + field.at + c * sizeof raw, &raw, sizeof raw);
        }
}

} // namespace

std::size_t wavePacketAt(std::uint8_t point_format) {
    constexpr std::size_t kPacketBytes = 29;
    const bool has_packet = point_format == 4 || point_format == 5 || point_format == 9 || point_format == 10;
    return has_packet ? lasRecordBytes(point_format) - kPacketBytes : 0;
}

std::vector<LasField> lasFields(std::uint8_t point_format) {
    std::vector<LasField> fields;
    if (point_format < 6) {
        addOldFields(fields);
        const bool has_time = point_format == 1 || point_format >= 3;
        if (has_time) fields.push_back(byteField("gps_time", PRO_TYPE_F64, 20));
        if (point_format == 2 || point_format == 3 || point_format == 5) fields.push_back(rgb(has_time ? 28 : 20));
        return fields;
    }
    addNewFields(fields);
    if (point_format == 7 || point_format == 8 || point_format == 10) fields.push_back(rgb(30));
    if (point_format == 8 || point_format == 10) fields.push_back(byteField("nir", PRO_TYPE_U16, 36));
    return fields;
}

std::vector<LasField> lasFields(LasFile& file) {
    std::vector<LasField> fields = lasFields(file.header.point_format);
    addExtraFields(file, fields);
    if (wavePacketAt(file.header.point_format) > 0) file.notes.push_back("waveforms are ignored");
    return fields;
}

std::size_t fieldBytes(const LasField& field) { return field.components * pro_type_bytes(field.type); }

void unpackField(const LasField& field, const char* records, std::size_t record_bytes, std::size_t count,
                 char* values) {
    if (field.scaled)
        return withType(field.raw_type, [&](auto number) {
            unpackScaled<decltype(number)>(field, records, record_bytes, count, values);
        });
    copyOut(records + field.at, record_bytes, count, fieldBytes(field), values);
    if (field.mask == 0) return;
    for (std::size_t i = 0; i < count; ++i)
        values[i] = static_cast<char>(static_cast<std::uint8_t>(values[i]) >> field.shift & field.mask);
}

void packField(const LasField& field, const char* values, std::size_t record_bytes, std::size_t count, char* records) {
    if (field.scaled)
        return withType(field.raw_type, [&](auto number) {
            packScaled<decltype(number)>(field, values, record_bytes, count, records);
        });
    const std::size_t bytes = fieldBytes(field);
    for (std::size_t i = 0; i < count; ++i) {
        char* const to = records + i * record_bytes + field.at;
        if (field.mask == 0)
            std::memcpy(to, values + i * bytes, bytes);
        else
            *to = static_cast<char>(static_cast<std::uint8_t>(*to) | (static_cast<std::uint8_t>(values[i]) & field.mask)
                                                                         << field.shift);
    }
}

} // namespace pointrt
