// SPDX-License-Identifier: Apache-2.0
// Writers of the sections of a scene file, and values as TOML.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "runtime/scene/render_setting_table.h"
#include "runtime/scene/scene_description.h"

namespace pointrt {

struct SceneWriting {
    const SceneDescription& scene;
    std::string folder;                      ///< of the scene file
    std::vector<std::string> material_names; ///< of scene.materials; "" for the default material of shapes
    std::string text;                        ///< written so far
};

/// Unique names of the materials.
std::vector<std::string> materialNames(const SceneDescription& scene);

/// path relative to the folder of a scene file.
std::string pathFrom(const std::string& folder, const std::string& path);

/// The render settings of a table of the file.
void writeSettings(SceneWriting& writing, FileTable table);
void writeRender(SceneWriting& writing);
void writeMaterials(SceneWriting& writing);
void writeInstances(SceneWriting& writing);
void writeClips(SceneWriting& writing);
void writeFilters(SceneWriting& writing);
void writeMeasures(SceneWriting& writing);
void writeShapes(SceneWriting& writing);
void writeLights(SceneWriting& writing);

/// The keys "attribute", and "values" or "range".
void putSelection(SceneWriting& writing, const SplatSelection& selection);
/// The keys "name" and "locked", where they are set.
void putLayer(SceneWriting& writing, const Layer& layer);
/// An empty line, and a header such as "[camera]".
void begin(SceneWriting& writing, const std::string& header);
/// "key = value"
void put(SceneWriting& writing, const char* key, const std::string& value);

/// "[a, b]", for one value or more.
std::string listOf(std::initializer_list<std::string> values);
/// The shortest text that parses to the same number.
std::string tomlOf(double number);
std::string tomlOf(float number);
std::string tomlOf(std::uint32_t number);
std::string tomlOf(bool flag);
std::string tomlOf(Vec3 vector);
std::string tomlOf(const Color& color);
std::string tomlOf(const std::array<Vec3, 3>& rows);
/// text in quotes.
std::string tomlOf(const std::string& text);

} // namespace pointrt
