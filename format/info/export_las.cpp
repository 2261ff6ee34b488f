// SPDX-License-Identifier: Apache-2.0
#include "format/info/export_las.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "format/base/atomic_file.h"
#include "format/base/error.h"
#include "format/info/las_plan.h"

namespace pointrt {
namespace {

constexpr std::size_t kSplatsAtOnce = 16384; // of at most 1 KiB each

using Splats = std::span<const std::uint32_t>;

void storeNumber(double value, std::uint32_t type, char* to) {
    const auto put = [to](auto number) { std::memcpy(to, &number, sizeof number); };
    switch (type) {
    case PRO_TYPE_I8:
        return put(static_cast<std::int8_t>(value));
    case PRO_TYPE_U8:
        return put(static_cast<std::uint8_t>(value));
    case PRO_TYPE_I16:
        return put(static_cast<std::int16_t>(value));
    case PRO_TYPE_U16:
        return put(static_cast<std::uint16_t>(value));
    default: // planLas puts no other type into another one
        return put(value);
    }
}

/// The values of a column for these splats, as its field has them.
std::vector<char> valuesOf(const ProFile& file, const LasColumn& column, Splats splats) {
    const pro_attribute& attribute = file.attributes()[column.attribute];
    const std::size_t number = pro_type_bytes(column.field.type), bytes = number * attribute.components;
    std::vector<char> values(splats.size() * bytes);
    for (std::size_t i = 0; i < splats.size(); ++i) {
        const std::size_t first = std::size_t{splats[i]} * attribute.components;
        if (attribute.type == column.field.type) {
            std::memcpy(values.data() + i * bytes, static_cast<const char*>(attribute.values) + first * number, bytes);
            continue;
        }
        for (std::size_t c = 0; c < attribute.components; ++c)
            storeNumber(pro_attribute_value(&attribute, first + c), column.field.type,
                        values.data() + i * bytes + c * number);
    }
    return values;
}

std::int32_t rounded(double value) {
    constexpr double kMost = std::numeric_limits<std::int32_t>::max();
    return static_cast<std::int32_t>(std::clamp(std::nearbyint(value), -kMost, kMost));
}

/// Bytes of colours times 257, so that 255 is as bright as there is.
void putColors(const ProFile& file, const LasField& field, Splats splats, std::size_t record_bytes, char* records) {
    for (std::size_t i = 0; i < splats.size(); ++i) {
        const pro_splat splat = file.splat(splats[i]);
        std::uint16_t color[3];
        for (int c = 0; c < 3; ++c) color[c] = static_cast<std::uint16_t>(splat.color[c] * 257);
        std::memcpy(records + i * record_bytes + field.at, color, sizeof color);
    }
}

void putPositions(const ProFile& file, const LasHeader& header, Splats splats, char* records) {
    const pro_info& info = file.info();
    for (std::size_t i = 0; i < splats.size(); ++i) {
        const pro_splat splat = file.splat(splats[i]);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double position = info.origin[axis] + info.scale * splat.position[axis];
            const std::int32_t whole = rounded((position - header.offset[axis]) / header.scale[axis]);
            std::memcpy(records + i * header.record_bytes + 4 * axis, &whole, sizeof whole);
        }
    }
}

/// The only return of each.
void putReturns(const LasField& field, std::uint8_t point_format, std::size_t count, std::size_t record_bytes,
                char* records) {
    const int returns = point_format < 6 ? 1 << 3 : 1 << 4;
    for (std::size_t i = 0; i < count; ++i)
        records[i * record_bytes + field.at] = static_cast<char>(records[i * record_bytes + field.at] | returns | 1);
}

std::vector<char> recordsOf(const ProFile& file, const LasExport& plan, Splats splats) {
    const LasHeader& header = plan.description.header;
    std::vector<char> records(splats.size() * header.record_bytes);
    putPositions(file, header, splats, records.data());
    for (const LasColumn& column : plan.columns)
        packField(column.field, valuesOf(file, column, splats).data(), header.record_bytes, splats.size(),
                  records.data());
    if (plan.colors) putColors(file, *plan.colors, splats, header.record_bytes, records.data());
    if (plan.returns)
        putReturns(*plan.returns, header.point_format, splats.size(), header.record_bytes, records.data());
    return records;
}

bool writeSplats(const ProFile& file, const LasExport& plan, Splats splats, LasWriter& writer) {
    for (std::size_t first = 0; first < splats.size(); first += kSplatsAtOnce) {
        const std::size_t count = std::min(kSplatsAtOnce, splats.size() - first);
        const std::vector<char> records = recordsOf(file, plan, splats.subspan(first, count));
        if (!writer.add(records.data(), count)) return false;
    }
    return true;
}

bool writeAll(const ExportSource& source, const LasExport& plan, LasWriter& writer) {
    return source.forEachPart([&](const ProFile& file, Splats splats) {
        return writeSplats(file, plan, splats, writer);
    }) && writer.finish();
}

} // namespace

void exportLas(const ExportSource& source, const std::string& path, bool overwrite) {
    const LasExport plan = planLas(source, path.ends_with(".laz"));
    const auto existing = overwrite ? format::Existing::kReplaced : format::Existing::kKept;
    format::AtomicFile out;
    const LasTarget target{
        [&](const void* data, std::size_t bytes) { return out.write(data, bytes); },
        [&](std::uint64_t offset, const void* data, std::size_t bytes) { return out.overwrite(offset, data, bytes); }};
    LasWriter writer(plan.description, target);
    if (!out.open(path, existing) || !writeAll(source, plan, writer) || !out.commit())
        throw Error(ExitCode::kCannotWrite,
                    path + ": " + out.error() + (out.nameIsTaken() ? "; --force overwrites it" : ""));
}

} // namespace pointrt
