// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/pcd_points.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "format/pointio/column_names.h"

namespace pointrt {
namespace {

constexpr std::size_t kPcdPointsAtOnce = 16384; // of some hundred bytes each at most
constexpr std::size_t kCountDigits = 20;        // of 64 bits

/// Whether floats, which PCL's point types have, are as fine as the positions.
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

class PcdPoints final : public PointSink {
public:
    PcdPoints(PointFile file, const PointOutline& outline)
        : file_(std::move(file)), outline_(outline), floats_(fitsFloats(outline)) {
        const std::string text = pcdHeader(outline_, floats_, outline_.count.value_or(0));
        file_.append(text.data(), text.size());
    }

    void add(const PointBlock& block) override {
        for (std::size_t i = 0; i < block.count(); ++i) {
            addPcdRow(block, i);
            if ((i + 1) % kPcdPointsAtOnce == 0) flush();
        }
        flush();
        count_ += block.count();
    }

    void finish() override {
        if (!outline_.count) {
            const std::string text = pcdHeader(outline_, floats_, count_);
            file_.overwrite(0, text.data(), text.size());
        }
        file_.commit();
    }

private:
    void put(const void* from, std::size_t bytes) {
        const auto* first = static_cast<const char*>(from);
        rows_.insert(rows_.end(), first, first + bytes);
    }

    void addPcdRow(const PointBlock& block, std::size_t i) {
        const double* const position = block.positions.data() + 3 * i;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto single = static_cast<float>(position[axis]);
            floats_ ? put(&single, sizeof single) : put(position + axis, sizeof(double));
        }
        for (std::size_t k = 0; k < outline_.columns.size(); ++k) {
            const PointColumn& column = outline_.columns[k];
            const std::byte* const from = block.columns[k].data() + i * column.rowBytes();
            if (column.role != PointRole::kColor) {
                put(from, column.rowBytes());
                continue;
            }
            const std::byte packed[4] = {from[2], from[1], from[0], std::byte{0}}; // blue is lowest
            put(packed, sizeof packed);
        }
    }

    void flush() {
        file_.append(rows_.data(), rows_.size());
        rows_.clear();
    }

    PointFile file_;
    PointOutline outline_;
    bool floats_;
    std::vector<char> rows_;
    std::uint64_t count_ = 0;
};

} // namespace

std::unique_ptr<PointSink> pcdPoints(PointFile file, const PointOutline& outline) {
    return std::make_unique<PcdPoints>(std::move(file), outline);
}

} // namespace pointrt
