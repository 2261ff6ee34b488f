// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/las_points.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "format/base/error.h"
#include "format/base/number_type.h"
#include "format/pointio/las_plan.h"
#include "format/pointio/number_text.h"

namespace pointrt {
namespace {

constexpr std::size_t kLasPointsAtOnce = 16384; // each has at most 1 KiB

/// Some points of a block.
struct Rows {
    const PointBlock& block;
    std::size_t first, count;
};

double numberAt(std::uint32_t type, const std::byte* from) {
    return withType(type, [&](auto number) {
        std::memcpy(&number, from, sizeof number);
        return static_cast<double>(number);
    });
}

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
    default: // planLas converts no other types
        return put(value);
    }
}

/// The values of a column in the type of its field.
std::vector<char> valuesOf(const PointColumn& column, const LasField& field, std::size_t number, Rows rows) {
    const std::size_t bytes = fieldBytes(field), each = pro_type_bytes(field.type);
    const std::byte* from = rows.block.columns[number].data() + rows.first * column.rowBytes();
    std::vector<char> values(rows.count * bytes);
    if (column.type == field.type) {
        std::memcpy(values.data(), from, values.size());
        return values;
    }
    for (std::size_t i = 0; i < rows.count * column.components; ++i)
        storeNumber(numberAt(column.type, from + i * pro_type_bytes(column.type)), field.type,
                    values.data() + i * each);
    return values;
}

/// Colour bytes times 257, so that 255 becomes 65535.
void putColors(const LasField& field, std::size_t column, Rows rows, std::size_t record_bytes, char* records) {
    const std::byte* from = rows.block.columns[column].data() + 3 * rows.first;
    for (std::size_t i = 0; i < rows.count; ++i) {
        std::uint16_t color[3];
        for (std::size_t c = 0; c < 3; ++c)
            color[c] = static_cast<std::uint16_t>(std::to_integer<unsigned>(from[3 * i + c]) * 257);
        std::memcpy(records + i * record_bytes + field.at, color, sizeof color);
    }
}

/// Numbers of a column scaled from its range to 16 bits; 0 for those that are missing.
void putScaled(const ScaledLasColumn& scaled, const PointColumn& column, Rows rows, std::size_t record_bytes,
               char* records) {
    constexpr double kMost = std::numeric_limits<std::uint16_t>::max();
    const auto [low, high] = scaled.range;
    const std::byte* from = rows.block.columns[scaled.column.column].data() + rows.first * column.rowBytes();
    for (std::size_t i = 0; i < rows.count; ++i) {
        const double value = numberAt(column.type, from + i * column.rowBytes());
        const double share = high > low ? std::clamp((value - low) / (high - low), 0.0, 1.0) : 0;
        const auto level = static_cast<std::uint16_t>(std::isnan(share) ? 0 : std::lround(kMost * share));
        std::memcpy(records + i * record_bytes + scaled.column.field.at, &level, sizeof level);
    }
}

/// Return 1 of 1 for every point.
void putReturns(const LasField& field, const LasHeader& header, std::size_t count, char* records) {
    const int returns = header.point_format < 6 ? 1 << 3 : 1 << 4;
    for (std::size_t i = 0; i < count; ++i) {
        char& byte = records[i * header.record_bytes + field.at];
        byte = static_cast<char>(byte | returns | 1);
    }
}

class LasPoints final : public PointSink {
public:
    LasPoints(PointFile file, const PointOutline& outline, bool packed)
        : file_(std::move(file)), columns_(outline.columns), plan_(planLas(outline, packed)),
          writer_(plan_.description, target()) {}

    void add(const PointBlock& block) override {
        for (std::size_t first = 0; first < block.count(); first += kLasPointsAtOnce) {
            const Rows rows{block, first, std::min(kLasPointsAtOnce, block.count() - first)};
            const std::vector<char> records = recordsOf(rows);
            writer_.add(records.data(), rows.count);
        }
    }

    void finish() override {
        writer_.finish();
        file_.commit();
    }

private:
    /// The file throws if writing fails.
    LasTarget target() {
        return {[this](const void* data, std::size_t bytes) {
                    file_.append(data, bytes);
                    return true;
                },
                [this](std::uint64_t offset, const void* data, std::size_t bytes) {
                    file_.overwrite(offset, data, bytes);
                    return true;
                }};
    }

    std::vector<char> recordsOf(Rows rows) const {
        const LasHeader& header = plan_.description.header;
        std::vector<char> records(rows.count * header.record_bytes);
        putPositions(rows, records.data());
        for (const LasColumn& each : plan_.columns)
            packField(each.field, valuesOf(columns_[each.column], each.field, each.column, rows).data(),
                      header.record_bytes, rows.count, records.data());
        if (const auto& scaled = plan_.intensity)
            putScaled(*scaled, columns_[scaled->column.column], rows, header.record_bytes, records.data());
        if (plan_.colors) putColors(*plan_.colors, plan_.color_column, rows, header.record_bytes, records.data());
        if (plan_.returns) putReturns(*plan_.returns, header, rows.count, records.data());
        return records;
    }

    void putPositions(Rows rows, char* records) const {
        constexpr double kMost = std::numeric_limits<std::int32_t>::max();
        const LasHeader& header = plan_.description.header;
        for (std::size_t i = 0; i < rows.count; ++i) {
            const double* position = rows.block.positions.data() + 3 * (rows.first + i);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double steps = std::nearbyint((position[axis] - header.offset[axis]) / header.scale[axis]);
                if (!(std::abs(steps) <= kMost)) refuse(position);
                const auto integer = static_cast<std::int32_t>(steps);
                std::memcpy(records + i * header.record_bytes + 4 * axis, &integer, sizeof integer);
            }
        }
    }

    [[noreturn]] void refuse(const double* position) const {
        std::string place;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            place += axis > 0 ? ", " : "";
            appendNumber(PRO_TYPE_F64, reinterpret_cast<const std::byte*>(position + axis), place);
        }
        throw Error(ExitCode::kBadInput,
                    file_.name() + ": the point " + place + " is too far away for the 32-bit integers of LAS");
    }

    PointFile file_;
    std::vector<PointColumn> columns_;
    LasExport plan_;
    LasWriter writer_;
};

} // namespace

std::unique_ptr<PointSink> lasPoints(PointFile file, const PointOutline& outline, bool packed) {
    return std::make_unique<LasPoints>(std::move(file), outline, packed);
}

} // namespace pointrt
