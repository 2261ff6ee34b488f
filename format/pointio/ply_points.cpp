// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/ply_points.h"

#include <bit>
#include <cstring>
#include <utility>

#include "format/base/number_type.h"
#include "format/pointio/column_names.h"

namespace pointrt {
namespace {

static_assert(std::endian::native == std::endian::little, "values are written without conversion");

constexpr std::size_t kPlyPointsAtOnce = 16384; // of some hundred bytes each at most
constexpr std::size_t kMostDigits = 20;         // of a count of 64 bits

bool isWide(std::uint32_t type) { return type == PRO_TYPE_I64 || type == PRO_TYPE_U64; }

/// Type names in PLY headers. 64-bit integers have none and become double.
const char* plyType(std::uint32_t type) {
    constexpr const char* kWords[] = {"char", "uchar",  "short",  "ushort", "int",
                                      "uint", "double", "double", "float",  "double"};
    return kWords[type - PRO_TYPE_I8];
}

/// If the count is not known yet, a comment reserves room for its digits.
std::string header(const PointOutline& outline, std::uint64_t count) {
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

void appendBytes(std::vector<char>& rows, const void* from, std::size_t bytes) {
    const auto* first = static_cast<const char*>(from);
    rows.insert(rows.end(), first, first + bytes);
}

/// Converts 64-bit integers to doubles.
void appendWide(std::vector<char>& rows, const PointColumn& column, const std::byte* from) {
    withType(column.type, [&](auto number) {
        for (std::uint32_t c = 0; c < column.components; ++c) {
            std::memcpy(&number, from + c * sizeof number, sizeof number);
            const auto real = static_cast<double>(number);
            appendBytes(rows, &real, sizeof real);
        }
    });
}

class PlyPoints final : public PointSink {
public:
    PlyPoints(PointFile file, const PointOutline& outline) : file_(std::move(file)), outline_(outline) {
        const std::string text = header(outline_, outline_.count.value_or(0));
        file_.append(text.data(), text.size());
    }

    void add(const PointBlock& block) override {
        for (std::size_t i = 0; i < block.count(); ++i) {
            addRow(block, i);
            if ((i + 1) % kPlyPointsAtOnce == 0) flush();
        }
        flush();
        count_ += block.count();
    }

    void finish() override {
        if (!outline_.count) {
            const std::string text = header(outline_, count_);
            file_.overwrite(0, text.data(), text.size());
        }
        file_.commit();
    }

private:
    void addRow(const PointBlock& block, std::size_t i) {
        appendBytes(rows_, block.positions.data() + 3 * i, 3 * sizeof(double));
        for (std::size_t k = 0; k < outline_.columns.size(); ++k) {
            const PointColumn& column = outline_.columns[k];
            const std::byte* from = block.columns[k].data() + i * column.rowBytes();
            if (isWide(column.type))
                appendWide(rows_, column, from);
            else
                appendBytes(rows_, from, column.rowBytes());
        }
    }

    void flush() {
        file_.append(rows_.data(), rows_.size());
        rows_.clear();
    }

    PointFile file_;
    PointOutline outline_;
    std::vector<char> rows_;
    std::uint64_t count_ = 0;
};

} // namespace

std::unique_ptr<PointSink> plyPoints(PointFile file, const PointOutline& outline) {
    return std::make_unique<PlyPoints>(std::move(file), outline);
}

} // namespace pointrt
