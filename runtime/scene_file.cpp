// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include "pointrt/tool.hpp"
#include "runtime/scene_file_parts.h"

namespace pointrt {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 20;

std::string readText(const std::string& path) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
    if (!file) throw Error{ExitCode::kBadInput, path + ": " + std::strerror(errno)};
    std::string text(kMostBytes + 1, '\0');
    text.resize(std::fread(text.data(), 1, text.size(), file.get()));
    if (std::ferror(file.get())) throw Error{ExitCode::kBadInput, path + ": " + std::strerror(errno)};
    if (text.size() > kMostBytes) throw Error{ExitCode::kBadInput, path + ": a scene file has at most 1 MiB"};
    return text;
}

/// [camera]. Without an up of its own it stands as the scene does.
CameraRequest readCamera(const SceneValue& file) {
    CameraRequest camera;
    if (const auto up = find(file, "up")) camera.up = directionOf(*up);
    const auto table = findTable(file, "camera");
    if (!table) return camera;
    requireKnownKeys(*table, "a camera", {"eye", "target", "up", "fov"});
    if (const auto eye = find(*table, "eye")) camera.eye = vectorOf(*eye);
    if (const auto target = find(*table, "target")) camera.target = vectorOf(*target);
    if (const auto up = find(*table, "up")) camera.up = directionOf(*up);
    // as wide as frameCamera takes it
    takeNumber(*table, "fov", {0.001, 179.999}, camera.fov_deg);
    if (camera.eye && camera.target && !(length(*camera.target - *camera.eye) > 0))
        refuse(*find(*table, "target"), "must be another point than \"eye\"");
    return camera;
}

/// [render], within the limits of the command line (options.cpp).
void readRender(const SceneValue& file, SceneDescription& scene) {
    const auto table = findTable(file, "render");
    if (!table) return;
    requireKnownKeys(*table, "render", {"integrator", "bounces", "spp", "size"});
    constexpr Integrator integrators[] = {Integrator::kPhong, Integrator::kWhitted, Integrator::kPath,
                                          Integrator::kNormal, Integrator::kDepth};
    if (const auto name = find(*table, "integrator"))
        scene.integrator = integrators[choiceOf(*name, {"phong", "whitted", "path", "normal", "depth"})];
    if (const auto bounces = find(*table, "bounces")) scene.bounces = wholeNumberOf(*bounces, 0, 64);
    if (const auto spp = find(*table, "spp")) scene.spp = wholeNumberOf(*spp, 1, 65536);
    if (const auto size = find(*table, "size")) {
        if (!size->node->is_array() || size->node->as_array()->size() != 2) refuse(*size, "must be [width, height]");
        const std::vector<SceneValue> sides = elementsOf(*size);
        scene.width = wholeNumberOf(sides[0], 1, 16384);
        scene.height = wholeNumberOf(sides[1], 1, 16384);
    }
}

void readWhole(const SceneValue& file, SceneDescription& scene) {
    requireKnownKeys(file, "a scene",
                     {"up", "room", "camera", "render", "instance", "material", "shape", "light", "sky"});
    constexpr Room rooms[] = {Room::kNone, Room::kMirror, Room::kMatte};
    if (const auto room = find(file, "room")) scene.room = rooms[choiceOf(*room, {"none", "mirror", "matte"})];
    if (const auto up = find(file, "up")) scene.up = directionOf(*up);
    scene.camera = readCamera(file);
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
    readShapes(file, reading);
    readLights(file, reading);
    readSky(file, reading);
    if (reading.scene.instances.empty() && reading.scene.shapes.empty())
        refuse(file, "there is no [[instance]] and no [[shape]] to see");
    return reading.scene;
}

SceneDescription readSceneFile(const std::string& path) { return parseScene(readText(path), path); }

std::string fileOf(const SceneValue& value, const SceneReading& reading) {
    const std::string name = textOf(value);
    const std::filesystem::path path = std::filesystem::path(reading.scene.path).parent_path() / name;
    std::error_code error;
    if (!std::filesystem::exists(path, error) || std::filesystem::is_directory(path, error))
        refuse(value, "there is no file \"" + printable(path.string()) + "\"");
    return path.string();
}

} // namespace pointrt
