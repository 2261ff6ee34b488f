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

std::vector<SceneAttribute> attributesOf(const InstanceResidency& resident, const InstanceRun& scene_instance) {
    const InstanceList& list = resident.list();
    return scene_instance.set ? attributesOf(list.sets[*scene_instance.set].set)
                              : attributesOf(*resident.find(scene_instance.first)->scan);
}

bool isAlike(const SceneAttribute& a, const SceneAttribute& b) {
    return a.name == b.name && a.type == b.type && a.components == b.components;
}

/// Keeps the shared attributes that an instance has too, and extends their ranges. A range of 0 to 0 means no values.
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

/// The value for a miss.
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

SceneAttribute attributeNamed(const InstanceResidency& resident, const std::string& name) {
    const std::vector<SceneAttribute> all = sceneAttributes(resident);
    const auto found = std::find_if(all.begin(), all.end(), [&](const SceneAttribute& a) { return a.name == name; });
    if (found != all.end()) return *found;
    std::string there;
    for (const SceneAttribute& each : all) there += (there.empty() ? "" : ", ") + each.name;
    throw Error(ExitCode::kBadUsage, "no attribute " + name + "; " +
                                         (there.empty() ? "the instances have none in common" : "available: " + there));
}

/// A row that hit a splat of an instance.
struct HitRow {
    std::uint32_t instance = 0;
    std::size_t row = 0;
};

/// Rows sorted by instance, resident instances first, so that none is evicted before it is read.
std::vector<HitRow> hitRows(const InstanceResidency& resident, const HitIds& ids) {
    std::vector<HitRow> rows;
    for (std::size_t i = 0; i < ids.splats.size(); ++i) {
        if (ids.splats[i] == kNoHit) continue;
        const std::uint32_t tile = ids.tiles.empty() ? kNoTile : ids.tiles[i];
        if (const auto instance = findInstance(resident.list(), ids.instances[i], tile)) rows.push_back({*instance, i});
    }
    if (resident.list().instances.size() == 1) return rows;
    std::sort(rows.begin(), rows.end(), [&](const HitRow& a, const HitRow& b) {
        const bool a_waits = !resident.find(a.instance), b_waits = !resident.find(b.instance);
        if (a_waits != b_waits) return b_waits;
        return a.instance != b.instance ? a.instance < b.instance : a.row < b.row;
    });
    return rows;
}

/// Calls find(scan) once for each instance that was hit, and put(row, splat, source) for each splat.
template <typename FindSource, typename Put>
void forHits(InstanceResidency& resident, const HitIds& ids, const FindSource& find, const Put& put) {
    std::uint32_t instance = kNoTile;
    decltype(find(std::declval<const DeviceScan&>())) source{};
    for (const HitRow& each : hitRows(resident, ids)) {
        if (each.instance != instance) {
            instance = each.instance;
            if (!resident.find(instance)) resident.load({&instance, 1});
            source = find(*resident.find(instance)->scan);
        }
        const std::size_t splat = ids.splats[each.row];
        if (splat < resident.find(instance)->scan->info.splat_count) put(each.row, splat, source);
    }
}

void requireRows(const InstanceResidency& resident, const HitIds& ids, std::size_t values, std::size_t of_a_row,
                 const std::string& what) {
    const std::size_t count = ids.splats.size();
    if (ids.tiles.empty() && !resident.list().sets.empty() && count > 0)
        throw Error(ExitCode::kBadUsage, what + ": tile_ids are required for scenes with tile sets");
    if (ids.instances.size() != count || values != count * of_a_row ||
        (!ids.tiles.empty() && ids.tiles.size() != count))
        throw Error(ExitCode::kBadUsage, what + ": the arrays differ in their numbers of rows");
}

/// The values of an attribute in a file. A tile may lack it although its set lists it.
const std::byte* valuesOf(const DeviceScan& scan, const SceneAttribute& wanted) {
    pro_attribute found;
    if (pro_find_attribute(scan.file, wanted.name.c_str(), &found) != 1 || !isAlike(described(found), wanted))
        throw Error(ExitCode::kBadInput, scan.path + ": has no attribute " + wanted.name + " of the type in its set");
    return static_cast<const std::byte*>(found.values);
}

/// The sRGB colour of a splat; white in a scan without colours.
std::array<std::uint8_t, 3> colorOf(const DeviceScan& file, std::size_t splat) {
    if ((file.info.flags & PRO_FLAG_COLOR) == 0) return {255, 255, 255};
    pro_splat decoded;
    pro_splat_decode(file.view.splats + splat * PRO_SPLAT_WORDS, 1, 1, &decoded); // only the colour is valid
    return {decoded.color[0], decoded.color[1], decoded.color[2]};
}

/// Metres per world unit according to an instance; 0 if unknown.
double metresOf(const InstanceResidency& resident, const InstanceRun& scene_instance) {
    const InstanceList& list = resident.list();
    const double scale = list.instances[scene_instance.first].placement.scale;
    if (scene_instance.set) return list.sets[*scene_instance.set].set.metres / scale;
    pro_world world;
    pro_get_world(resident.find(scene_instance.first)->scan->file, &world);
    return world.metres_per_unit / scale;
}

} // namespace

std::vector<SceneAttribute> sceneAttributes(const InstanceResidency& resident) {
    const std::vector<InstanceRun>& scene_instances = resident.list().scene_instances;
    if (scene_instances.empty()) return {};
    std::vector<SceneAttribute> shared = attributesOf(resident, scene_instances.front());
    for (const InstanceRun& scene_instance : scene_instances)
        keepShared(shared, attributesOf(resident, scene_instance));
    return shared;
}

void gatherAttribute(InstanceResidency& resident, const std::string& name, const HitIds& ids,
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

void gatherColors(InstanceResidency& resident, const HitIds& ids, std::span<std::uint8_t> colors) {
    requireRows(resident, ids, colors.size(), 3, "colors");
    std::fill(colors.begin(), colors.end(), std::uint8_t{0});
    forHits(
        resident, ids, [](const DeviceScan& scan) { return &scan; },
        [&](std::size_t row, std::size_t splat, const DeviceScan* scan) {
            const std::array<std::uint8_t, 3> color = colorOf(*scan, splat);
            std::copy(color.begin(), color.end(), colors.begin() + static_cast<std::ptrdiff_t>(3 * row));
        });
}

double metresPerUnit(const InstanceResidency& resident) {
    const std::vector<InstanceRun>& scene_instances = resident.list().scene_instances;
    if (scene_instances.empty()) return 0;
    const double first = metresOf(resident, scene_instances.front());
    const bool alike = std::all_of(scene_instances.begin(), scene_instances.end(),
                                   [&](const InstanceRun& each) { return metresOf(resident, each) == first; });
    return alike ? first : 0;
}

} // namespace pointrt
