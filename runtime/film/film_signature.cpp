// SPDX-License-Identifier: Apache-2.0
#include "runtime/film/film_signature.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/scene/option_values.h"
#include "runtime/scene_file/scene_file.h"
#include "runtime/util/input_file.h"

namespace pointrt {
namespace {

constexpr std::string_view kSeparator = "; ";

std::string exact(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}

std::string vectorText(Vec3 v) { return exact(v.x) + "," + exact(v.y) + "," + exact(v.z); }

std::uint64_t hashOfFile(const std::string& path) {
    const auto bytes = readFileBytes(path);
    return XXH3_64bits(bytes.data(), bytes.size());
}

std::uint64_t headerChecksum(const DeviceScan& file) {
    std::uint64_t checksum = 0;
    std::size_t bytes = 0;
    std::memcpy(&checksum, static_cast<const char*>(pro_bytes(file.file, &bytes)) + PRO_OFF_HEADER_XXH3,
                sizeof checksum);
    return checksum;
}

std::string sceneHash(const DeviceScene& scene) {
    std::vector<std::uint64_t> parts;
    const SceneDescription& description = scene.description;
    if (isSceneFile(description.path)) parts.push_back(hashOfFile(description.path));
    for (const DeviceScan& file : scene.files)
        if (file.file) parts.push_back(headerChecksum(file));
    if (description.sky && !description.sky->image.empty()) parts.push_back(hashOfFile(description.sky->image));
    char text[24];
    std::snprintf(text, sizeof text, "%016llx",
                  static_cast<unsigned long long>(XXH3_64bits(parts.data(), parts.size() * sizeof parts[0])));
    return text;
}

std::string cameraText(const Camera& camera) {
    return vectorText(camera.eye) + " " + vectorText(camera.right) + " " + vectorText(camera.up) + " " +
           vectorText(camera.forward) + " " +
           (camera.ortho_height > 0 ? "ortho " + exact(camera.ortho_height) : exact(camera.fov_deg));
}

/// Takes the next "name=value" off text.
std::string_view takeEntry(std::string_view& text) {
    const std::size_t end = text.find(kSeparator);
    const std::string_view entry = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + kSeparator.size());
    return entry;
}

std::string valueOf(std::string_view entry) {
    const std::size_t equals = entry.find('=');
    return equals == std::string_view::npos ? "nothing" : std::string(entry.substr(equals + 1));
}

} // namespace

std::string filmSignature(const DeviceScene& scene, const RenderSettings& settings, const Camera& camera) {
    const auto onOff = [](bool on) { return std::string(nameOf(kSwitchNames, on)); };
    const std::pair<const char*, std::string> entries[] = {
        {"renderer", POINTRT_VERSION},
        {"scene", sceneHash(scene)},
        {"size", std::to_string(settings.width) + "x" + std::to_string(settings.height)},
        {"camera", cameraText(camera)},
        {"integrator", nameOf(kIntegratorNames, settings.integrator)},
        {"bounces", std::to_string(settings.bounces)},
        {"seed", std::to_string(settings.seed)},
        {"pixel", settings.spp == 1 ? "centre" : "area"},
        {"room", settings.room ? nameOf(kRoomNames, *settings.room) : "default"},
        {"lights", settings.lights ? std::to_string(*settings.lights) : "default"},
        {"shadows", onOff(settings.shadows)},
        {"blend", onOff(settings.blend)},
        {"caustics", onOff(settings.caustics)},
        {"reflectivity", settings.reflectivity ? exact(*settings.reflectivity) : "default"}};
    std::string signature;
    for (const auto& [name, value] : entries)
        signature += (signature.empty() ? "" : std::string(kSeparator)) + name + "=" + value;
    return signature;
}

std::string signatureDifference(const std::string& before, const std::string& now) {
    std::string_view old_text = before, new_text = now;
    while (!old_text.empty() || !new_text.empty()) {
        const std::string_view was = takeEntry(old_text), is = takeEntry(new_text);
        if (was == is) continue;
        const std::string_view entry = is.empty() ? was : is;
        return std::string(entry.substr(0, entry.find('='))) + " was " + valueOf(was) + " and is " + valueOf(is);
    }
    return "";
}

} // namespace pointrt
