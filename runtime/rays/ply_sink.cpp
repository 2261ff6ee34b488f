// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/ply_sink.h"

#include <vector>

#include "format/base/error.h"
#include "format/pointio/point_sink.h"

namespace pointrt {
namespace {

bool isPosition(const HitColumn& column) { return column.name == "positions"; }

PointColumn pointColumn(const HitColumn& column) {
    if (column.name == "normals") return {column.name, column.type, column.components, PointRole::kNormal};
    if (column.name == "splat_ids") return {"splat_id", column.type};
    if (column.name == "instance_ids") return {"instance_id", column.type};
    if (column.name == "tile_ids") return {"tile_id", column.type};
    return {column.name, column.type, column.components};
}

PointOutline outlineOf(std::span<const HitColumn> columns) {
    PointOutline outline;
    for (const HitColumn& column : columns)
        if (!isPosition(column)) outline.columns.push_back(pointColumn(column));
    outline.columns.push_back({"ray", PRO_TYPE_U32});
    return outline;
}

template <typename Number>
void addRow(std::vector<Number>& rows, const HitColumn& column, std::size_t i) {
    const auto* from = reinterpret_cast<const Number*>(column.values.data() + i * column.rowBytes());
    rows.insert(rows.end(), from, from + column.rowBytes() / sizeof(Number));
}

class PlySink final : public HitSink {
public:
    PlySink(const std::string& path, std::span<const HitColumn> columns)
        : path_(path), points_(openPointSink(path, outlineOf(columns))) {
        block_.columns.resize(columns.size()); // positions are not among the columns, but the ray index is
    }

    void add(std::span<const HitColumn> columns, std::uint64_t first) override {
        const std::span<const std::uint32_t> instances = columnNamed(columns, "instance_ids").as<std::uint32_t>();
        if (first + instances.size() > std::uint64_t{UINT32_MAX} + 1)
            throw Error(ExitCode::kCannotWrite, path_ + ": PLY can index at most 2^32 rays; use .npz");
        block_.positions.clear();
        for (std::vector<std::byte>& values : block_.columns) values.clear();
        for (std::size_t i = 0; i < instances.size(); ++i)
            if (instances[i] != kNoHit) addHit(columns, i, static_cast<std::uint32_t>(first + i));
        points_->add(block_);
    }

    void finish() override { points_->finish(); }

private:
    void addHit(std::span<const HitColumn> columns, std::size_t i, std::uint32_t ray) {
        std::size_t place = 0;
        for (const HitColumn& column : columns)
            if (isPosition(column))
                addRow(block_.positions, column, i);
            else
                addRow(block_.columns[place++], column, i);
        const auto* bytes = reinterpret_cast<const std::byte*>(&ray);
        block_.columns[place].insert(block_.columns[place].end(), bytes, bytes + sizeof ray);
    }

    std::string path_;
    std::unique_ptr<PointSink> points_;
    PointBlock block_;
};

} // namespace

std::unique_ptr<HitSink> plySink(const std::string& path, std::span<const HitColumn> columns) {
    return std::make_unique<PlySink>(path, columns);
}

} // namespace pointrt
