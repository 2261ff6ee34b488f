// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/pcd_points.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "format/pointio/column_names.h"
#include "format/pointio/row_points.h"

namespace pointrt {
namespace {

constexpr std::size_t kCountDigits = 20; // of 64 bits

/// Whether floats, as in PCL's point types, are as precise as the positions.
bool fitsFloats(const PointOutline& outline) {
    constexpr double kFloatStep = 0x1p-24; // half the step of a float, relative to it
    double farthest = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        farthest = std::max({farthest, std::abs(outline.bounds_min[axis]), std::abs(outline.bounds_max[axis])});
    return outline.position_step > 0 && farthest * kFloatStep <= outline.position_step;
}

char typeLetter(std::uint32_t type) {
    if (type >= PRO_TYPE_F32) return 'F';
    const bool has_sign = type == PRO_TYPE_I8 || type == PRO_TYPE_I16 || type == PRO_TYPE_I32 || type == PRO_TYPE_I64;
    return has_sign ? 'I' : 'U';
}

/// The lines FIELDS, SIZE, TYPE and COUNT.
struct FieldLines {
    std::string fields = "FIELDS", sizes = "\nSIZE", types = "\nTYPE", counts = "\nCOUNT";

    void add(const std::string& name, std::size_t size, char type) {
        fields += " " + name;
        sizes += " " + std::to_string(size);
        types += std::string(" ") + type;
        counts += " 1";
    }
    std::string text() const { return fields + sizes + types + counts + "\n"; }
};

/// The count has leading zeros, so that the header keeps its length when the count becomes known.
std::string pcdHeader(const PointOutline& outline, bool floats, std::uint64_t count) {
    FieldLines lines;
    for (const char* const name : {"x", "y", "z"}) lines.add(name, floats ? sizeof(float) : sizeof(double), 'F');
    for (const PointColumn& column : outline.columns) {
        if (column.role == PointRole::kColor)
            lines.add("rgb", sizeof(std::uint32_t), 'U');
        else if (column.role == PointRole::kNormal)
            for (const char* const name : {"normal_x", "normal_y", "normal_z"}) lines.add(name, sizeof(float), 'F');
        else
            for (const std::string& name : componentNames(column, "#"))
                lines.add(name, pro_type_bytes(column.type), typeLetter(column.type));
    }
    std::string digits = std::to_string(count);
    if (!outline.count) digits.insert(0, kCountDigits - digits.size(), '0');
    return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n" + lines.text() + "WIDTH " + digits +
           "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + digits + "\nDATA binary\n";
}

class PcdRows {
public:
    explicit PcdRows(const PointOutline& outline) : outline_(outline), floats_(fitsFloats(outline)) {}

    const PointOutline& outline() const { return outline_; }
    std::string header(std::uint64_t count) const { return pcdHeader(outline_, floats_, count); }

    void addRow(const PointBlock& block, std::size_t i, RowBytes& rows) const {
        const double* const position = block.positions.data() + 3 * i;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto single = static_cast<float>(position[axis]);
            floats_ ? rows.add(&single, sizeof single) : rows.add(position + axis, sizeof(double));
        }
        for (std::size_t k = 0; k < outline_.columns.size(); ++k) {
            const PointColumn& column = outline_.columns[k];
            const std::byte* const from = block.columns[k].data() + i * column.rowBytes();
            if (column.role != PointRole::kColor) {
                rows.add(from, column.rowBytes());
                continue;
            }
            const std::byte packed[4] = {from[2], from[1], from[0], std::byte{0}}; // blue is lowest
            rows.add(packed, sizeof packed);
        }
    }

private:
    PointOutline outline_;
    bool floats_;
};

} // namespace

std::unique_ptr<PointSink> pcdPoints(PointFile file, const PointOutline& outline) {
    return std::make_unique<RowPoints<PcdRows>>(std::move(file), PcdRows(outline));
}

} // namespace pointrt
