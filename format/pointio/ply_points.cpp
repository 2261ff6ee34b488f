// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/ply_points.h"

#include <bit>
#include <cstring>
#include <utility>

#include "format/base/number_type.h"
#include "format/pointio/column_names.h"
#include "format/pointio/row_points.h"

namespace pointrt {
namespace {

static_assert(std::endian::native == std::endian::little, "values are written without conversion");

constexpr std::size_t kMostDigits = 20; // of a count of 64 bits

/// Type names in PLY headers. 64-bit integers have none and become double.
const char* plyType(std::uint32_t type) {
    constexpr const char* kWords[] = {"char", "uchar",  "short",  "ushort", "int",
                                      "uint", "double", "double", "float",  "double"};
    return kWords[type - PRO_TYPE_I8];
}

/// If the count is not known yet, a comment reserves room for its digits.
std::string plyHeader(const PointOutline& outline, std::uint64_t count) {
    const std::string digits = std::to_string(count);
    std::string text = "ply\nformat binary_little_endian 1.0\n";
    if (!outline.comment.empty()) text += "comment " + outline.comment + "\n";
    if (!outline.count) text += "comment " + std::string(kMostDigits - digits.size() + 1, '.') + "\n";
    text += "element vertex " + digits + "\n";
    for (const char* name : {"x", "y", "z"}) text += std::string("property double ") + name + "\n";
    for (const PointColumn& column : outline.columns)
        for (const std::string& name : componentNames(column, ""))
            text += std::string("property ") + plyType(column.type) + " " + name + "\n";
    return text + "end_header\n";
}

/// Converts 64-bit integers to doubles.
void addWide(RowBytes& rows, const PointColumn& column, const std::byte* from) {
    withType(column.type, [&](auto number) {
        for (std::uint32_t c = 0; c < column.components; ++c) {
            std::memcpy(&number, from + c * sizeof number, sizeof number);
            const auto real = static_cast<double>(number);
            rows.add(&real, sizeof real);
        }
    });
}

class PlyRows {
public:
    explicit PlyRows(const PointOutline& outline) : outline_(outline) {}

    const PointOutline& outline() const { return outline_; }
    std::string header(std::uint64_t count) const { return plyHeader(outline_, count); }

    void addRow(const PointBlock& block, std::size_t i, RowBytes& rows) const {
        rows.add(block.positions.data() + 3 * i, 3 * sizeof(double));
        for (std::size_t k = 0; k < outline_.columns.size(); ++k) {
            const PointColumn& column = outline_.columns[k];
            const std::byte* from = block.columns[k].data() + i * column.rowBytes();
            if (isWideInteger(column.type))
                addWide(rows, column, from);
            else
                rows.add(from, column.rowBytes());
        }
    }

private:
    PointOutline outline_;
};

} // namespace

std::unique_ptr<PointSink> plyPoints(PointFile file, const PointOutline& outline) {
    return std::make_unique<RowPoints<PlyRows>>(std::move(file), PlyRows(outline));
}

} // namespace pointrt
