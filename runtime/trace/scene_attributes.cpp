// SPDX-License-Identifier: Apache-2.0
#include "runtime/trace/scene_attributes.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include "format/base/error.h"
#include "pointrt/pro.h"

namespace pointrt {
namespace {

SceneAttribute described(const pro_attribute& attribute) {
    return {attribute.name,       attribute.type,
            attribute.components, std::size_t{pro_type_bytes(attribute.type)} * attribute.components,
            attribute.low,        attribute.high};
}

/// Where file has numbers of this attribute, wanted's reach to them. Files without any say 0 and 0.
void widen(const DeviceScan& file, SceneAttribute& wanted) {
    pro_attribute found;
    pro_find_attribute(file.file, wanted.name.c_str(), &found);
    if (found.low == 0 && found.high == 0) return;
    const bool none_yet = wanted.low == 0 && wanted.high == 0;
    wanted.low = none_yet ? found.low : std::min(wanted.low, found.low);
    wanted.high = none_yet ? found.high : std::max(wanted.high, found.high);
}

/// The file of a hit's splat; nullptr for a miss.
const DeviceScan* fileOf(const DeviceScene& scene, std::uint32_t splat, std::uint32_t instance) {
    if (instance >= scene.instances.size()) return nullptr;
    const DeviceScan& file = scene.files[scene.instances[instance].file];
    return splat < file.info.splat_count ? &file : nullptr;
}

/// sRGB; white in a scan without colours.
std::array<std::uint8_t, 3> colorOf(const DeviceScan& file, std::uint32_t splat) {
    if ((file.info.flags & PRO_FLAG_COLOR) == 0) return {255, 255, 255};
    pro_splat decoded;
    pro_splat_decode(file.view.splats + std::size_t{splat} * PRO_SPLAT_WORDS, 1, 1, &decoded); // but for the colour
    return {decoded.color[0], decoded.color[1], decoded.color[2]};
}

/// Whether the file has the like.
bool has(const DeviceScan& file, const SceneAttribute& wanted) {
    pro_attribute found;
    return pro_find_attribute(file.file, wanted.name.c_str(), &found) == 1 && found.type == wanted.type &&
           found.components == wanted.components;
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

SceneAttribute attributeNamed(const DeviceScene& scene, const std::string& name) {
    const std::vector<SceneAttribute> all = sceneAttributes(scene);
    const auto found = std::find_if(all.begin(), all.end(), [&](const SceneAttribute& a) { return a.name == name; });
    if (found != all.end()) return *found;
    std::string there;
    for (const SceneAttribute& each : all) there += (there.empty() ? "" : ", ") + each.name;
    throw Error(ExitCode::kBadUsage,
                "no attribute " + name + "; there is " + (there.empty() ? "none in all of the scene" : there));
}

/// The values of each instance's file.
std::vector<const std::byte*> valuesOf(const DeviceScene& scene, const std::string& name) {
    std::vector<const std::byte*> values;
    for (const Instance& instance : scene.instances) {
        pro_attribute attribute;
        pro_find_attribute(scene.files[instance.file].file, name.c_str(), &attribute);
        values.push_back(static_cast<const std::byte*>(attribute.values));
    }
    return values;
}

} // namespace

std::vector<SceneAttribute> sceneAttributes(const DeviceScene& scene) {
    std::vector<SceneAttribute> shared;
    const pro_file* first = scene.files[scene.instances.front().file].file;
    for (std::uint32_t i = 0; i < pro_attribute_count(first); ++i) {
        pro_attribute attribute;
        pro_get_attribute(first, i, &attribute);
        SceneAttribute wanted = described(attribute);
        if (std::all_of(scene.files.begin(), scene.files.end(),
                        [&](const DeviceScan& file) { return has(file, wanted); })) {
            for (const DeviceScan& file : scene.files) widen(file, wanted);
            shared.push_back(wanted);
        }
    }
    return shared;
}

void gatherAttribute(const DeviceScene& scene, const std::string& name, std::span<const std::uint32_t> splats,
                     std::span<const std::uint32_t> instances, std::span<std::byte> values) {
    const SceneAttribute attribute = attributeNamed(scene, name);
    if (splats.size() != instances.size() || values.size() != splats.size() * attribute.bytes)
        throw Error(ExitCode::kBadUsage, name + ": the arrays do not have the same number of rows");
    const std::vector<const std::byte*> sources = valuesOf(scene, name);
    const std::vector<std::byte> none = missing(attribute);
    for (std::size_t i = 0; i < splats.size(); ++i) {
        const bool hit = fileOf(scene, splats[i], instances[i]) != nullptr;
        const std::byte* from = hit ? sources[instances[i]] + std::size_t{splats[i]} * attribute.bytes : none.data();
        std::memcpy(values.data() + i * attribute.bytes, from, attribute.bytes);
    }
}

void gatherColors(const DeviceScene& scene, std::span<const std::uint32_t> splats,
                  std::span<const std::uint32_t> instances, std::span<std::uint8_t> colors) {
    if (splats.size() != instances.size() || colors.size() != 3 * splats.size())
        throw Error(ExitCode::kBadUsage, "colors: the arrays do not have the same number of rows");
    for (std::size_t i = 0; i < splats.size(); ++i) {
        std::array<std::uint8_t, 3> color{};
        if (const DeviceScan* file = fileOf(scene, splats[i], instances[i])) color = colorOf(*file, splats[i]);
        std::copy(color.begin(), color.end(), colors.begin() + static_cast<std::ptrdiff_t>(3 * i));
    }
}

double metresPerUnit(const DeviceScene& scene) {
    const auto unitOf = [](const DeviceScan& file) {
        pro_world world;
        pro_get_world(file.file, &world);
        return world.metres_per_unit;
    };
    const double first = unitOf(scene.files.front());
    const bool alike = std::all_of(scene.files.begin(), scene.files.end(),
                                   [&](const DeviceScan& file) { return unitOf(file) == first; });
    return alike ? first : 0;
}

} // namespace pointrt
