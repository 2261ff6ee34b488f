// SPDX-License-Identifier: Apache-2.0
#include "runtime/cast/scene_attributes.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <utility>

#include "format/base/error.h"
#include "pointrt/pro.h"

namespace pointrt {
namespace {

SceneAttribute described(const pro_attribute& attribute) {
    return {attribute.name,       attribute.type,
            attribute.components, std::size_t{pro_type_bytes(attribute.type)} * attribute.components,
            attribute.low,        attribute.high};
}

std::vector<SceneAttribute> attributesOf(const DeviceScan& scan) {
    std::vector<SceneAttribute> all;
    for (std::uint32_t i = 0; i < pro_attribute_count(scan.file); ++i) {
        pro_attribute attribute;
        pro_get_attribute(scan.file, i, &attribute);
        all.push_back(described(attribute));
    }
    return all;
}

std::vector<SceneAttribute> attributesOf(const TileSet& set) {
    std::vector<SceneAttribute> all;
    for (const SetAttribute& each : set.attributes)
        all.push_back({each.name, each.type, each.components, std::size_t{pro_type_bytes(each.type)} * each.components,
                       each.low, each.high});
    return all;
}

std::vector<SceneAttribute> attributesOf(const ResidentTargets& resident, const TargetRun& instance) {
    const TargetList& list = resident.list();
    return instance.set ? attributesOf(list.sets[*instance.set].set)
                        : attributesOf(*resident.find(instance.first)->scan);
}

bool isAlike(const SceneAttribute& a, const SceneAttribute& b) {
    return a.name == b.name && a.type == b.type && a.components == b.components;
}

/// Keeps of shared what an instance has as well, with its reach. What has no numbers says 0 and 0.
void keepShared(std::vector<SceneAttribute>& shared, const std::vector<SceneAttribute>& its) {
    std::erase_if(shared, [&](SceneAttribute& wanted) {
        const auto found =
            std::find_if(its.begin(), its.end(), [&](const SceneAttribute& a) { return isAlike(a, wanted); });
        if (found == its.end()) return true;
        if (found->low == 0 && found->high == 0) return false;
        const bool none_yet = wanted.low == 0 && wanted.high == 0;
        wanted.low = none_yet ? found->low : std::min(wanted.low, found->low);
        wanted.high = none_yet ? found->high : std::max(wanted.high, found->high);
        return false;
    });
}

/// What stands for a splat where nothing is hit.
std::vector<std::byte> missing(const SceneAttribute& attribute) {
    std::vector<std::byte> bytes(attribute.bytes);
    const auto fill = [&](auto number) {
        for (std::size_t c = 0; c < attribute.components; ++c)
            std::memcpy(bytes.data() + c * sizeof number, &number, sizeof number);
    };
    if (attribute.type == PRO_TYPE_F32) fill(std::numeric_limits<float>::quiet_NaN());
    if (attribute.type == PRO_TYPE_F64) fill(std::numeric_limits<double>::quiet_NaN());
    return bytes;
}

SceneAttribute attributeNamed(const ResidentTargets& resident, const std::string& name) {
    const std::vector<SceneAttribute> all = sceneAttributes(resident);
    const auto found = std::find_if(all.begin(), all.end(), [&](const SceneAttribute& a) { return a.name == name; });
    if (found != all.end()) return *found;
    std::string there;
    for (const SceneAttribute& each : all) there += (there.empty() ? "" : ", ") + each.name;
    throw Error(ExitCode::kBadUsage,
                "no attribute " + name + "; there is " + (there.empty() ? "none in all of the scene" : there));
}

/// A row whose splat is of a target.
struct AskedRow {
    std::uint32_t target = 0;
    std::size_t row = 0;
};

/// Targets that are on the device first, so that none goes before it was read.
std::vector<AskedRow> askedRows(const ResidentTargets& resident, const HitIds& ids) {
    std::vector<AskedRow> rows;
    for (std::size_t i = 0; i < ids.splats.size(); ++i) {
        if (ids.splats[i] == kNoHit) continue;
        const std::uint32_t tile = ids.tiles.empty() ? kNoTile : ids.tiles[i];
        if (const auto target = findTarget(resident.list(), ids.instances[i], tile)) rows.push_back({*target, i});
    }
    if (resident.list().targets.size() == 1) return rows;
    std::sort(rows.begin(), rows.end(), [&](const AskedRow& a, const AskedRow& b) {
        const bool a_waits = !resident.find(a.target), b_waits = !resident.find(b.target);
        if (a_waits != b_waits) return b_waits;
        return a.target != b.target ? a.target < b.target : a.row < b.row;
    });
    return rows;
}

/// find(scan) once for each target that was hit, and put(row, splat, its source) for each splat.
template <typename FindSource, typename Put>
void forHits(ResidentTargets& resident, const HitIds& ids, const FindSource& find, const Put& put) {
    std::uint32_t target = kNoTile;
    decltype(find(std::declval<const DeviceScan&>())) source{};
    for (const AskedRow& each : askedRows(resident, ids)) {
        if (each.target != target) {
            target = each.target;
            if (!resident.find(target)) resident.bring({&target, 1});
            source = find(*resident.find(target)->scan);
        }
        const std::size_t splat = ids.splats[each.row];
        if (splat < resident.find(target)->scan->info.splat_count) put(each.row, splat, source);
    }
}

void requireRows(const ResidentTargets& resident, const HitIds& ids, std::size_t values, std::size_t of_a_row,
                 const std::string& what) {
    const std::size_t count = ids.splats.size();
    if (ids.tiles.empty() && !resident.list().sets.empty() && count > 0)
        throw Error(ExitCode::kBadUsage, what + ": splats of tile sets have the number of their tile, too (tile_ids)");
    if (ids.instances.size() != count || values != count * of_a_row ||
        (!ids.tiles.empty() && ids.tiles.size() != count))
        throw Error(ExitCode::kBadUsage, what + ": the arrays do not have the same number of rows");
}

/// The values of a file. A tile may have others than its set says.
const std::byte* valuesOf(const DeviceScan& scan, const SceneAttribute& wanted) {
    pro_attribute found;
    if (pro_find_attribute(scan.file, wanted.name.c_str(), &found) != 1 || !isAlike(described(found), wanted))
        throw Error(ExitCode::kBadInput, scan.path + ": has no attribute " + wanted.name + " as its set has it");
    return static_cast<const std::byte*>(found.values);
}

/// sRGB; white in a scan without colours.
std::array<std::uint8_t, 3> colorOf(const DeviceScan& file, std::size_t splat) {
    if ((file.info.flags & PRO_FLAG_COLOR) == 0) return {255, 255, 255};
    pro_splat decoded;
    pro_splat_decode(file.view.splats + splat * PRO_SPLAT_WORDS, 1, 1, &decoded); // but for the colour
    return {decoded.color[0], decoded.color[1], decoded.color[2]};
}

/// Of the scene's coordinates, as the instance says; 0 where it does not.
double metresOf(const ResidentTargets& resident, const TargetRun& instance) {
    const TargetList& list = resident.list();
    const double scale = list.targets[instance.first].placement.scale;
    if (instance.set) return list.sets[*instance.set].set.metres / scale;
    pro_world world;
    pro_get_world(resident.find(instance.first)->scan->file, &world);
    return world.metres_per_unit / scale;
}

} // namespace

std::vector<SceneAttribute> sceneAttributes(const ResidentTargets& resident) {
    const std::vector<TargetRun>& instances = resident.list().instances;
    if (instances.empty()) return {};
    std::vector<SceneAttribute> shared = attributesOf(resident, instances.front());
    for (const TargetRun& instance : instances) keepShared(shared, attributesOf(resident, instance));
    return shared;
}

void gatherAttribute(ResidentTargets& resident, const std::string& name, const HitIds& ids,
                     std::span<std::byte> values) {
    const SceneAttribute attribute = attributeNamed(resident, name);
    const std::size_t bytes = attribute.bytes;
    requireRows(resident, ids, values.size(), bytes, name);
    const std::vector<std::byte> none = missing(attribute);
    for (std::size_t i = 0; i < ids.splats.size(); ++i) std::memcpy(values.data() + i * bytes, none.data(), bytes);
    forHits(
        resident, ids, [&](const DeviceScan& scan) { return valuesOf(scan, attribute); },
        [&](std::size_t row, std::size_t splat, const std::byte* source) {
            std::memcpy(values.data() + row * bytes, source + splat * bytes, bytes);
        });
}

void gatherColors(ResidentTargets& resident, const HitIds& ids, std::span<std::uint8_t> colors) {
    requireRows(resident, ids, colors.size(), 3, "colors");
    std::fill(colors.begin(), colors.end(), std::uint8_t{0});
    forHits(
        resident, ids, [](const DeviceScan& scan) { return &scan; },
        [&](std::size_t row, std::size_t splat, const DeviceScan* scan) {
            const std::array<std::uint8_t, 3> color = colorOf(*scan, splat);
            std::copy(color.begin(), color.end(), colors.begin() + static_cast<std::ptrdiff_t>(3 * row));
        });
}

double metresPerUnit(const ResidentTargets& resident) {
    const std::vector<TargetRun>& instances = resident.list().instances;
    if (instances.empty()) return 0;
    const double first = metresOf(resident, instances.front());
    const bool alike = std::all_of(instances.begin(), instances.end(),
                                   [&](const TargetRun& each) { return metresOf(resident, each) == first; });
    return alike ? first : 0;
}

} // namespace pointrt
