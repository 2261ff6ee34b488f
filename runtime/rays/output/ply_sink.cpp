// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/output/ply_sink.h"

#include <cctype>
#include <cstring>
#include <vector>

#include "format/base/error.h"
#include "pointrt/pro_layout.h"
#include "runtime/rays/output/spool_file.h"

namespace pointrt {
namespace {

/// PLY has no integers of 64 bits: those become doubles.
const char* plyType(const HitColumn& column) {
    constexpr const char* kTypes[] = {"",     "char",   "uchar",  "short", "ushort", "int",
                                      "uint", "double", "double", "float", "double"};
    static_assert(PRO_TYPE_I8 == 1 && PRO_TYPE_U16 == 4 && PRO_TYPE_F64 == 10);
    return kTypes[column.type];
}

/// Words of PLY have no blanks; other programs read no more than ASCII.
std::string plyWord(std::string name) {
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return name;
}

std::vector<std::string> propertyNames(const HitColumn& column) {
    if (column.name == "positions") return {"x", "y", "z"};
    if (column.name == "normals") return {"nx", "ny", "nz"};
    if (column.name == "splat_ids") return {"splat_id"};
    if (column.name == "instance_ids") return {"instance_id"};
    if (column.components == 1) return {plyWord(column.name)};
    std::vector<std::string> names;
    for (std::uint32_t c = 0; c < column.components; ++c)
        names.push_back(plyWord(column.name) + "_" + std::to_string(c));
    return names;
}

template <typename Number>
void addNumber(std::vector<std::byte>& rows, Number number) {
    const auto* bytes = reinterpret_cast<const std::byte*>(&number);
    rows.insert(rows.end(), bytes, bytes + sizeof number);
}

template <typename Number>
void addWide(std::vector<std::byte>& rows, const std::byte* from, std::uint32_t components) {
    for (std::uint32_t c = 0; c < components; ++c) {
        Number number;
        std::memcpy(&number, from + c * sizeof number, sizeof number);
        addNumber(rows, static_cast<double>(number));
    }
}

class PlySink final : public HitSink {
public:
    PlySink(const std::string& path, std::span<const HitColumn> columns) : file_(path), path_(path), spool_(path) {
        for (const HitColumn& column : columns)
            for (const std::string& name : propertyNames(column))
                properties_ += std::string("property ") + plyType(column) + " " + name + "\n";
        properties_ += "property uint ray\n";
    }

    void add(std::span<const HitColumn> columns, std::uint64_t first) override {
        const std::span<const std::uint32_t> splats = columnNamed(columns, "splat_ids").as<std::uint32_t>();
        if (first + splats.size() > std::uint64_t{UINT32_MAX} + 1)
            throw Error(ExitCode::kCannotWrite, path_ + ": PLY numbers no more than 2^32 rays; take .npz");
        rows_.clear();
        for (std::size_t i = 0; i < splats.size(); ++i) {
            if (splats[i] == kNoHit) continue;
            for (const HitColumn& column : columns) addRow(column, i);
            addNumber(rows_, static_cast<std::uint32_t>(first + i));
            ++points_;
        }
        spool_.append(rows_);
    }

    void finish() override {
        const std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(points_) +
                                   "\n" + properties_ + "end_header\n";
        file_.append({reinterpret_cast<const std::uint8_t*>(header.data()), header.size()});
        spool_.copyTo(file_);
        file_.commit();
    }

private:
    void addRow(const HitColumn& column, std::size_t i) {
        const std::byte* from = column.values.data() + i * column.rowBytes();
        if (column.type == PRO_TYPE_I64)
            addWide<std::int64_t>(rows_, from, column.components);
        else if (column.type == PRO_TYPE_U64)
            addWide<std::uint64_t>(rows_, from, column.components);
        else
            rows_.insert(rows_.end(), from, from + column.rowBytes());
    }

    OutputFile file_;
    std::string path_;
    SpoolFile spool_;
    std::string properties_;
    std::vector<std::byte> rows_;
    std::uint64_t points_ = 0;
};

} // namespace

std::unique_ptr<HitSink> plySink(const std::string& path, std::span<const HitColumn> columns) {
    return std::make_unique<PlySink>(path, columns);
}

} // namespace pointrt
