// SPDX-License-Identifier: Apache-2.0
#include "runtime/session/scene_notes.h"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string_view>

#include "format/base/printable.h"
#include "format/base/up_text.h"
#include "pointrt/pro_layout.h"
#include "runtime/device_scene/clip_planes.h"
#include "runtime/scene_io/scene_file.h"
#include "runtime/util/parse.h"

namespace pointrt {
namespace {

using Json = nlohmann::json;

template <typename Number>
Number load(std::string_view bytes, std::size_t offset) {
    Number number;
    std::memcpy(&number, bytes.data() + offset, sizeof number);
    return number;
}

/// The contents of META, which files opened for tracing do not expose; "" if the file has no META.
std::string_view metadataOf(const pro_file* file) {
    std::size_t size = 0;
    const auto* const start = static_cast<const char*>(pro_bytes(file, &size));
    const std::string_view bytes(start, size);
    const std::size_t table_end = std::min<std::size_t>(PRO_HEADER_BYTES, size);
    for (std::size_t at = PRO_TABLE_OFFSET; at + PRO_SECTION_BYTES <= table_end; at += PRO_SECTION_BYTES) {
        if (load<std::uint32_t>(bytes, at + PRO_SEC_OFF_KIND) != PRO_KIND_META) continue;
        const auto offset = load<std::uint64_t>(bytes, at + PRO_SEC_OFF_OFFSET);
        const auto length = load<std::uint64_t>(bytes, at + PRO_SEC_OFF_LENGTH);
        return offset <= size && length <= size - offset ? bytes.substr(offset, length) : std::string_view();
    }
    return {};
}

/// The object "world" of META; empty if META lacks it. Deeper values are dropped, so that a hostile file nests nothing.
Json worldOf(std::string_view metadata) {
    constexpr int kDepth = 2;
    const auto is_shallow = [](int depth, Json::parse_event_t, Json&) { return depth <= kDepth; };
    const Json json = Json::parse(metadata.begin(), metadata.end(), is_shallow, false);
    const bool has_world = json.is_object() && json.contains("world") && json["world"].is_object();
    return has_world ? json["world"] : Json::object();
}

std::string textOf(const Json& world, const char* key) {
    const auto found = world.find(key);
    return found != world.end() && found->is_string() ? printable(found->get<std::string>()) : std::string();
}

/// The name by which users know a scan, never the name of a file in the cache.
const std::string& nameOf(const DeviceScene& scene, const DeviceScan& scan) {
    const SceneDescription& description = scene.description;
    const bool is_scan = description.instances.size() == 1 && !isSceneOrSet(description.path);
    return is_scan ? description.path : scan.path;
}

/// The up of the first scan that has one, if a bake found or guessed it; the viewer's default if no scan has one.
std::string upNote(const DeviceScene& scene) {
    const std::vector<const DeviceScan*> scans = representativeScans(scene);
    for (const DeviceScan* scan : scans) {
        pro_world world;
        pro_get_world(scan->file, &world);
        const std::array<double, 3> up{world.up[0], world.up[1], world.up[2]};
        if (up == std::array<double, 3>{}) continue;
        const Json json = worldOf(metadataOf(scan->file));
        const std::string from = textOf(json, "up_from");
        const std::string text = from == "format" ? "" : upText(up, from, textOf(json, "up_reason"));
        return text.empty() ? text : nameOf(scene, *scan) + ": " + text;
    }
    if (scans.empty()) return {};
    return nameOf(scene, *scans.front()) + ": " + upText({0, 1, 0}, "guess", "as the file names none");
}

} // namespace

std::vector<std::string> sceneNotes(const LoadedScene& loaded, bool up_is_given) {
    std::vector<std::string> notes;
    const std::string up = up_is_given ? std::string() : upNote(loaded.scene);
    if (!up.empty()) notes.push_back(up);
    if (loaded.colored_by_default)
        notes.push_back("the scan has no colours: it is coloured by " + loaded.settings.color_by +
                        " (--color-by rgb turns that off)");
    if (cutsInstances(loaded.scene.description) && loaded.kept_sample.splats.empty())
        notes.push_back("the clips hide the scans completely");
    if (hidesAllSplats(loaded.scene.paint)) notes.push_back("the filters hide every point");
    const RenderSettings& settings = loaded.settings;
    const bool shows_caustics = settings.caustics && usesLights(settings.integrator) && castsCaustics(loaded.scene);
    if (settings.relight && shows_caustics && hasGaussians(loaded.scene))
        notes.push_back("relit Gaussians receive no caustics: the light passes through them to the surfaces behind");
    const double height = loaded.camera.ortho_height;
    if (loaded.section_camera && height > 0)
        notes.push_back("the picture of the section is " + plainText(height) + " units high, " +
                        plainText(height / loaded.settings.height) + " per pixel (--ortho sets the height)");
    return notes;
}

} // namespace pointrt
