// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/pro_points.h"

#include <algorithm>
#include <cstring>

namespace pointrt {
namespace {

PointColumn columnOf(const pro_attribute& attribute, std::uint64_t splats) {
    return {attribute.name,
            attribute.type,
            attribute.components,
            PointRole::kAttribute,
            {{attribute.low, attribute.high}},
            attribute.values,
            splats};
}

/// The splat; if it is a ball, with a normal of 0, which means unknown.
pro_splat splatAt(const ProFile& file, std::uint32_t number) {
    pro_splat splat = file.splat(number);
    if (file.isBall(number)) std::ranges::fill(splat.normal, 0.0f);
    return splat;
}

/// The columns that every splat has.
void putSplat(const ProFile& file, const pro_splat& splat, PointRole role, std::byte* to) {
    const auto radius = static_cast<float>(file.radius(splat));
    if (role == PointRole::kNormal) std::memcpy(to, splat.normal, sizeof splat.normal);
    if (role == PointRole::kRadius) std::memcpy(to, &radius, sizeof radius);
    if (role == PointRole::kColor) std::memcpy(to, splat.color, sizeof splat.color);
}

void gatherAttribute(const ProFile& file, std::span<const std::uint32_t> splats, const PointColumn& column,
                     std::vector<std::byte>& values) {
    const pro_attribute* attribute = file.attribute(column.name);
    if (!attribute || attribute->type != column.type || attribute->components != column.components) return;
    const std::size_t bytes = column.rowBytes();
    for (std::size_t i = 0; i < splats.size(); ++i)
        std::memcpy(values.data() + i * bytes, static_cast<const std::byte*>(attribute->values) + splats[i] * bytes,
                    bytes);
}

} // namespace

PointOutline outlineOf(const ProFile& file) {
    const pro_info& info = file.info();
    PointOutline outline;
    outline.columns = {{"normals", PRO_TYPE_F32, 3, PointRole::kNormal},
                       {"radius", PRO_TYPE_F32, 1, PointRole::kRadius}};
    if ((info.flags & PRO_FLAG_COLOR) != 0) outline.columns.push_back({"colors", PRO_TYPE_U8, 3, PointRole::kColor});
    for (const pro_attribute& attribute : file.attributes())
        outline.columns.push_back(columnOf(attribute, info.splat_count));
    outline.count = info.splat_count;
    std::copy(info.bounds_min, info.bounds_min + 3, outline.bounds_min.begin());
    std::copy(info.bounds_max, info.bounds_max + 3, outline.bounds_max.begin());
    outline.position_step = info.scale / PRO_POSITION_STEPS;
    outline.metres_per_unit = file.world().metres_per_unit;
    outline.metadata = file.metadata();
    return outline;
}

void gatherPoints(const ProFile& file, std::span<const std::uint32_t> splats, std::span<const PointColumn> columns,
                  PointBlock& block) {
    block.positions.resize(3 * splats.size());
    block.columns.resize(columns.size());
    for (std::size_t k = 0; k < columns.size(); ++k) {
        block.columns[k].assign(splats.size() * columns[k].rowBytes(), std::byte{0});
        if (columns[k].role == PointRole::kAttribute) gatherAttribute(file, splats, columns[k], block.columns[k]);
    }
    for (std::size_t i = 0; i < splats.size(); ++i) {
        const pro_splat splat = splatAt(file, splats[i]);
        std::ranges::copy(file.position(splat), block.positions.begin() + static_cast<std::ptrdiff_t>(3 * i));
        for (std::size_t k = 0; k < columns.size(); ++k)
            putSplat(file, splat, columns[k].role, block.columns[k].data() + i * columns[k].rowBytes());
    }
}

} // namespace pointrt
