// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene_io/scene_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <set>

#include "format/base/error.h"
#include "format/base/printable.h"
#include "format/set/tile_set.h"
#include "runtime/scene/added_surroundings.h"
#include "runtime/scene/camera.h"
#include "runtime/scene/upright.h"
#include "runtime/scene_io/read_parts.h"

namespace pointrt {
namespace {

std::string readText(const std::string& path) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
    if (!file) throw Error{ExitCode::kBadInput, path + ": " + std::strerror(errno)};
    std::string text(kMaxSceneBytes + 1, '\0');
    text.resize(std::fread(text.data(), 1, text.size(), file.get()));
    if (std::ferror(file.get())) throw Error{ExitCode::kBadInput, path + ": " + std::strerror(errno)};
    if (text.size() > kMaxSceneBytes)
        throw Error{ExitCode::kBadInput, path + ": larger than 1 MiB, the limit of scene files"};
    return text;
}

/// Reads a height, or "fit" for the whole scene.
void takeOrtho(const SceneValue& table, const SceneValue& ortho, CameraRequest& camera) {
    if (find(table, "fov"))
        refuse(ortho, "cannot be combined with \"fov\": a parallel projection has no field of view");
    camera.ortho = true;
    if (ortho.node->is_number())
        camera.ortho_height = numberOf(ortho, kLengths);
    else if (!ortho.node->is_string() || textOf(ortho) != "fit")
        refuse(ortho, "must be a height or \"fit\"");
}

/// The camera of [camera] or a [[view]]; its up defaults to the scene's.
CameraRequest cameraOf(const SceneValue& table, const SceneDescription& scene) {
    CameraRequest camera;
    camera.up = scene.up;
    camera.side = scene.camera.side;
    if (const auto eye = find(table, "eye")) camera.eye = vectorOf(*eye);
    if (const auto target = find(table, "target")) camera.target = vectorOf(*target);
    if (const auto up = find(table, "up")) camera.up = directionOf(*up);
    // the same limits as in frameCamera
    takeNumber(table, "fov", {0.001, 179.999}, camera.fov_deg);
    if (const auto ortho = find(table, "ortho")) takeOrtho(table, *ortho, camera);
    if (camera.eye && camera.target && !(length(*camera.target - *camera.eye) > 0))
        refuse(*find(table, "target"), "must differ from \"eye\"");
    return camera;
}

void readCamera(const SceneValue& file, SceneDescription& scene) {
    scene.camera.up = scene.up;
    const auto table = findTable(file, "camera");
    if (!table) return;
    requireKnownKeys(*table, "a camera", {"eye", "target", "up", "fov", "ortho"});
    scene.camera = cameraOf(*table, scene);
}

void readViews(const SceneValue& file, SceneDescription& scene) {
    std::set<std::string> names;
    for (const SceneValue& table : findTables(file, "view")) {
        requireKnownKeys(table, "a view", {"name", "eye", "target", "up", "fov", "ortho"});
        const SceneValue name = require(table, "name");
        if (!names.insert(textOf(name)).second) refuse(name, "is also the name of another view");
        scene.views.push_back({textOf(name), cameraOf(table, scene)});
    }
}

/// The room of [surroundings]: one of --room, or the studio.
std::optional<Room> roomOf(const SceneValue& value) {
    if (value.node->is_string() && textOf(value) == kStudioWord) return std::nullopt;
    std::vector<std::string_view> words = wordsOf(kRoomNames);
    words.push_back(kStudioWord);
    return kRoomNames[choiceOf(value, words)].value;
}

void readSurroundings(const SceneValue& file, SceneDescription& scene) {
    const auto table = findTable(file, "surroundings");
    if (!table) return;
    requireKnownKeys(*table, "surroundings", {"room", "lamps", "lights"});
    AddedSurroundings added{roomOf(require(*table, "room")), {}, false};
    const CountRange lamps = rowOf<&RenderSettings::lights>().limits;
    if (const auto value = find(*table, "lamps")) added.lamps = wholeNumberOf(*value, lamps.low, lamps.high);
    takeFlag(*table, "lights", added.has_lights);
    scene.surroundings = added;
}

/// Reads a direction; an axis, which also selects the front for cameras; or "auto": from the scans.
void readUp(const SceneValue& value, SceneDescription& scene) {
    if (!value.node->is_string()) {
        scene.up = directionOf(value);
        return;
    }
    const std::string word = textOf(value);
    const auto axis = axisNamed(word);
    if (!axis && word != "auto")
        refuse(value, "\"" + printable(word) +
                          "\" is neither a direction such as [0, 0, 1] nor one of auto, x, y, z, -x, -y, -z");
    scene.up = axis;
    if (axis) scene.camera.side = frontSide(*axis);
}

void readWhole(const SceneValue& file, SceneDescription& scene) {
    std::vector<std::string_view> keys = settingKeys(FileTable::kScene);
    keys.insert(keys.begin(), "up");
    keys.insert(keys.end(), {"staged_for", "camera", "view", "render", "instance", "clip", "filter", "measure",
                             "material", "shape", "light", "sky", "surroundings"});
    requireKnownKeys(file, "a scene", keys);
    readSettings(file, FileTable::kScene, scene.render);
    if (const auto up = find(file, "up")) readUp(*up, scene);
    if (const auto eye = find(file, "staged_for")) scene.staged_for = vectorOf(*eye);
    readCamera(file, scene);
    readViews(file, scene);
    readRender(file, scene);
}

} // namespace

bool isSceneFile(const std::string& path) { return path.ends_with(".toml"); }

SceneDescription parseScene(std::string_view text, const std::string& path) {
    const toml::table table = parseToml(text, path);
    const SceneValue file{&path, &table, ""};
    SceneReading reading;
    reading.scene.path = path;
    readWhole(file, reading.scene);
    readMaterials(file, reading);
    readInstances(file, reading);
    readClips(file, reading);
    readFilters(file, reading);
    readMeasures(file, reading);
    readShapes(file, reading);
    readLights(file, reading);
    readSky(file, reading);
    readSurroundings(file, reading.scene);
    if (reading.scene.instances.empty() && reading.scene.shapes.empty())
        refuse(file, "the scene has neither an [[instance]] nor a [[shape]]");
    moveSurroundingMaterialsLast(reading.scene);
    return reading.scene;
}

bool isSceneOrSet(const std::string& path) { return isSceneFile(path) || isTileSet(path); }

SceneDescription readSceneFile(const std::string& path) { return parseScene(readText(path), path); }

void takeLayer(const SceneValue& table, Layer& layer) {
    if (const auto name = find(table, "name")) layer.name = textOf(*name);
    takeFlag(table, "locked", layer.locked);
}

std::string fileOf(const SceneValue& value, const SceneReading& reading) {
    constexpr std::size_t kLongestPath = 4096; // limit of Linux; the end of a path distinguishes files
    const std::string name = textOf(value);
    const std::filesystem::path path = std::filesystem::path(reading.scene.path).parent_path() / name;
    std::error_code error;
    const bool is_folder = std::filesystem::is_directory(path, error) && !isTileSet(path.string());
    if (!std::filesystem::exists(path, error) || is_folder)
        refuse(value, "there is no file \"" + printable(path.string(), kLongestPath) + "\"");
    return path.string();
}

} // namespace pointrt
