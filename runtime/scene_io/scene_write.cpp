// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene_io/scene_write.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <span>

#include "format/base/error.h"
#include "runtime/scene/added_surroundings.h"
#include "runtime/scene/upright.h"
#include "runtime/scene_io/scene_file.h"
#include "runtime/scene_io/write_parts.h"
#include "runtime/util/output_file.h"

namespace pointrt {
namespace {

template <typename Value>
void putOptional(SceneWriting& writing, const char* key, const std::optional<Value>& value) {
    if (value) put(writing, key, tomlOf(*value));
}

void putCamera(SceneWriting& writing, const CameraRequest& camera) {
    putOptional(writing, "eye", camera.eye);
    putOptional(writing, "target", camera.target);
    if (camera.up != writing.scene.up) putOptional(writing, "up", camera.up);
    if (!camera.ortho)
        put(writing, "fov", tomlOf(camera.fov_deg));
    else
        put(writing, "ortho", camera.ortho_height ? tomlOf(*camera.ortho_height) : "\"fit\"");
}

/// Writes up as a word if cameras use the front that the word selects.
void putUp(SceneWriting& writing) {
    const SceneDescription& scene = writing.scene;
    const auto looks_by_word = [](const CameraRequest& camera) { return camera.side != CameraRequest{}.side; };
    const bool by_word =
        looks_by_word(scene.camera) || std::any_of(scene.views.begin(), scene.views.end(),
                                                   [&](const NamedView& view) { return looks_by_word(view.camera); });
    const std::string word = by_word && scene.up ? axisName(*scene.up) : "";
    if (word.empty())
        putOptional(writing, "up", scene.up);
    else
        put(writing, "up", tomlOf(word));
}

void writeViews(SceneWriting& writing) {
    for (const NamedView& view : writing.scene.views) {
        begin(writing, "[[view]]");
        put(writing, "name", tomlOf(view.name));
        putCamera(writing, view.camera);
    }
}

void writeSurroundings(SceneWriting& writing) {
    if (!writing.scene.surroundings) return;
    const AddedSurroundings& added = *writing.scene.surroundings;
    begin(writing, "[surroundings]");
    put(writing, "room", tomlOf(std::string(added.room ? nameOf(kRoomNames, *added.room) : kStudioWord)));
    putOptional(writing, "lamps", added.lamps);
    if (added.has_lights) put(writing, "lights", "true");
}

void writeSky(SceneWriting& writing) {
    if (!writing.scene.sky) return;
    const SkyDescription& sky = *writing.scene.sky;
    begin(writing, "[sky]");
    if (sky.image.empty()) {
        put(writing, "zenith", tomlOf(sky.zenith));
        put(writing, "horizon", tomlOf(sky.horizon));
        put(writing, "ground", tomlOf(sky.ground));
    } else {
        put(writing, "image", tomlOf(pathFrom(writing.folder, sky.image)));
        put(writing, "rotation", tomlOf(sky.rotation_deg));
    }
    put(writing, "strength", tomlOf(sky.strength));
    put(writing, "ambient", tomlOf(sky.ambient));
}

} // namespace

std::string pathFrom(const std::string& folder, const std::string& path) {
    const std::string prefix = folder.empty() ? "" : folder + "/";
    const std::string rest = path.starts_with(prefix) ? path.substr(prefix.size()) : "";
    if (!rest.empty() && rest[0] != '/') return rest;
    // resolve symbolic links: ".." after a link does not lead to the folder that contains the link
    std::error_code error;
    const std::string near = std::filesystem::proximate(path, folder.empty() ? "." : folder, error).string();
    if (!error && !near.empty()) return near;
    return std::filesystem::absolute(path, error).string();
}

void putLayer(SceneWriting& writing, const Layer& layer) {
    if (!layer.name.empty()) put(writing, "name", tomlOf(layer.name));
    if (layer.locked) put(writing, "locked", "true");
}

std::string sceneText(const SceneDescription& scene, const std::string& scene_dir) {
    SceneWriting writing{scene, scene_dir, materialNames(scene), "# Written by pointrt-view.\n"};
    putUp(writing);
    writeSettings(writing, FileTable::kScene);
    putOptional(writing, "staged_for", scene.staged_for);
    begin(writing, "[camera]");
    putCamera(writing, scene.camera);
    writeViews(writing);
    writeRender(writing);
    writeSurroundings(writing);
    writeSky(writing);
    writeMaterials(writing);
    writeInstances(writing);
    writeClips(writing);
    writeFilters(writing);
    writeMeasures(writing);
    writeShapes(writing);
    writeLights(writing);
    return writing.text;
}

void writeSceneFile(const std::string& path, const SceneDescription& scene) {
    requireWritable(path);
    const std::string text = sceneText(scene, std::filesystem::path(path).parent_path().string());
    if (text.size() > kMaxSceneBytes)
        throw Error{ExitCode::kCannotWrite, path + ": would be larger than 1 MiB, the limit of scene files"};
    parseScene(text, path);
    writeFile(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

} // namespace pointrt
