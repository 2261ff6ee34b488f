// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/hit_columns.h"

#include <algorithm>
#include <cctype>
#include <cstring>

#include "format/base/error.h"
#include "pointrt/pro.h"

namespace pointrt {
namespace {

constexpr const char *kHit = "hit", *kTileIds = "tile_ids";

HitColumn attributeColumn(const std::vector<SceneAttribute>& all, const std::string& name) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const SceneAttribute& each) { return each.name == name; });
    if (found != all.end()) return {name, found->type, found->components, false, true};
    throw Error(ExitCode::kBadUsage, "--attributes: " + unknownAttribute(name, all));
}

/// Empty if there is no such column.
template <typename Number>
std::span<Number> numbersOf(std::span<HitColumn> columns, const std::string& name) {
    const auto found =
        std::find_if(columns.begin(), columns.end(), [&](const HitColumn& each) { return each.name == name; });
    return found == columns.end() ? std::span<Number>() : found->template as<Number>();
}

std::size_t fillOcclusion(const TraceScene& scene, const RayRows& rays, const RayLimits& limits, HitColumn& hit) {
    const std::span<std::uint8_t> flags = hit.as<std::uint8_t>();
    scene.testOcclusions(rays, limits, flags);
    return static_cast<std::size_t>(std::count(flags.begin(), flags.end(), 1));
}

} // namespace

std::string unknownAttribute(const std::string& name, const std::vector<SceneAttribute>& all) {
    std::string names;
    for (const SceneAttribute& each : all) names += (names.empty() ? "" : ", ") + each.name;
    return "unknown attribute " + name + "; the scene has " + (names.empty() ? "none" : names);
}

std::size_t HitColumn::rowBytes() const { return std::size_t{pro_type_bytes(type)} * components; }

std::vector<HitColumn> hitColumns(const TraceScene& scene, const std::vector<std::string>& attributes) {
    std::vector<HitColumn> columns{
        {"t_hit", PRO_TYPE_F64}, {"splat_ids", PRO_TYPE_U32}, {"instance_ids", PRO_TYPE_U32}};
    if (scene.hasTiles()) columns.push_back({kTileIds, PRO_TYPE_U32});
    columns.push_back({"normals", PRO_TYPE_F32, 3});
    columns.push_back({"positions", PRO_TYPE_F64, 3});
    const std::vector<SceneAttribute> all = scene.attributes();
    for (const std::string& name : attributes) {
        const bool twice =
            std::any_of(columns.begin(), columns.end(), [&](const HitColumn& c) { return c.name == name; });
        if (twice) throw Error(ExitCode::kBadUsage, "--attributes: " + name + " is already a column");
        columns.push_back(attributeColumn(all, name));
    }
    return columns;
}

std::vector<HitColumn> occlusionColumns() { return {{kHit, PRO_TYPE_U8, 1, true}}; }

const HitColumn& columnNamed(std::span<const HitColumn> columns, const std::string& name) {
    return *std::find_if(columns.begin(), columns.end(), [&](const HitColumn& each) { return each.name == name; });
}

std::string headerName(const HitColumn& column) {
    std::string name = column.name;
    for (char& c : name)
        if (std::iscntrl(static_cast<unsigned char>(c)) || std::strchr("'\"\\,;/", c)) c = '_';
    return name;
}

std::size_t fillColumns(const TraceScene& scene, const RayRows& rays, const RayLimits& limits,
                        std::span<HitColumn> columns) {
    for (HitColumn& column : columns) column.resize(rays.count);
    if (columns[0].name == kHit) return fillOcclusion(scene, rays, limits, columns[0]);
    const HitArrays arrays{numbersOf<double>(columns, "t_hit"),
                           numbersOf<std::uint32_t>(columns, "splat_ids"),
                           numbersOf<std::uint32_t>(columns, "instance_ids"),
                           numbersOf<float>(columns, "normals"),
                           numbersOf<double>(columns, "positions"),
                           numbersOf<std::uint32_t>(columns, kTileIds)};
    scene.castRays(rays, limits, arrays);
    for (HitColumn& column : columns)
        if (column.is_attribute)
            scene.readAttribute(column.name, arrays.splat_ids, arrays.instance_ids, arrays.tile_ids, column.values);
    const auto misses = std::count(arrays.instance_ids.begin(), arrays.instance_ids.end(), kNoHit);
    return rays.count - static_cast<std::size_t>(misses);
}

} // namespace pointrt
