// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/film_signature.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <map>
#include <string_view>
#include <vector>

#include "runtime/scene/render_setting_table.h"
#include "runtime/scene_io/scene_file.h"
#include "runtime/util/input_file.h"

namespace pointrt {
namespace {

constexpr std::string_view kSeparator = "; ";
/// Signature entry of films started by megakernels; films of wavefront kernels have none.
constexpr const char* kMegakernelEntry = "passes=fused";

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

std::string lensText(const Camera& camera) {
    if (camera.panorama) return "panorama " + exact(camera.eyes_apart);
    return camera.ortho_height > 0 ? "ortho " + exact(camera.ortho_height) : exact(camera.fov_deg);
}

std::string cameraText(const Camera& camera) {
    return vectorText(camera.eye) + " " + vectorText(camera.right) + " " + vectorText(camera.up) + " " +
           vectorText(camera.forward) + " " + lensText(camera);
}

/// Formats real numbers with all digits.
template <typename Limits>
std::string exactText(const Limits& limits, typename Limits::Value value) {
    if constexpr (std::is_same_v<Limits, RealRange>)
        return exact(static_cast<double>(value));
    else
        return valueText(limits, value);
}

template <typename Row>
std::string settingInFilm(const Row& row, const RenderSettings& settings) {
    if (row.film.text) return row.film.text(settings);
    const auto value = settingOf(settings, row.member);
    return value ? exactText(row.limits, *value) : "default";
}

template <typename Row>
bool isInSignature(const Row& row, const RenderSettings& settings) {
    return !row.film.omits_default || settingOf(settings, row.member) != settingOf(RenderSettings{}, row.member);
}

/// The half-spaces that the enabled clips keep, each as a point and a normal.
std::string clipsText(const SceneDescription& description) {
    std::string text;
    for (const HalfSpace& each : keptHalfSpaces(description.clips))
        text += (text.empty() ? "" : " ") + vectorText(each.point) + " " + vectorText(each.normal);
    return text;
}

/// The values that the enabled filters show.
std::string filtersText(const SceneDescription& description) {
    std::string text;
    for (const FilterDescription& each : description.filters) {
        if (!hidesSplats(each)) continue;
        text += (text.empty() ? "" : " ") + each.shown.attribute;
        for (const ValueRange& range : each.shown.ranges) text += " " + exact(range.low) + ":" + exact(range.high);
    }
    return text;
}

/// Removes the next "name=value" from text.
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

std::string filmSignature(const DeviceScene& scene, const RenderSettings& settings, const Camera& camera,
                          KernelForm form) {
    std::map<int, std::string> entries = {{kCameraPlaceInFilm, "camera=" + cameraText(camera)}};
    forEachRenderSetting([&](const auto& row) {
        if (row.film.place != 0 && isInSignature(row, settings))
            entries[row.film.place] = std::string(row.film.name) + "=" + settingInFilm(row, settings);
    });
    std::string signature = "renderer=" POINTRT_VERSION + std::string(kSeparator) + "scene=" + sceneHash(scene);
    for (const auto& [place, entry] : entries) signature += std::string(kSeparator) + entry;
    const std::string clips = clipsText(scene.description);
    if (!clips.empty()) signature += std::string(kSeparator) + "clips=" + clips;
    const std::string filters = filtersText(scene.description);
    if (!filters.empty()) signature += std::string(kSeparator) + "filters=" + filters;
    return signature + (form == KernelForm::kMegakernel ? std::string(kSeparator) + kMegakernelEntry : "");
}

KernelForm formOf(const std::string& signature) {
    std::string_view text = signature;
    while (!text.empty())
        if (takeEntry(text) == kMegakernelEntry) return KernelForm::kMegakernel;
    return KernelForm::kWavefront;
}

std::string signatureDifference(const std::string& before, const std::string& now) {
    std::string_view old_text = before, new_text = now;
    while (!old_text.empty() || !new_text.empty()) {
        const std::string_view was = takeEntry(old_text), is = takeEntry(new_text);
        if (was == is) continue;
        const std::string_view entry = is.empty() ? was : is;
        return std::string(entry.substr(0, entry.find('='))) + " was " + valueOf(was) + " but is now " + valueOf(is);
    }
    return "";
}

} // namespace pointrt
