// SPDX-License-Identifier: Apache-2.0
// The sections of a scene file that is written, and values as TOML.
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
    std::vector<std::string> material_names; ///< of scene.materials; "" for what shapes have that name none
    std::string text;                        ///< as far as it goes
};

/// Names under which the materials can be told apart.
std::vector<std::string> materialNames(const SceneDescription& scene);

/// How path, as the viewer opens it, is called in a scene file in folder.
std::string pathFrom(const std::string& folder, const std::string& path);

/// The render settings of a table of the file.
void writeSettings(SceneWriting& writing, FileTable table);
void writeRender(SceneWriting& writing);
void writeMaterials(SceneWriting& writing);
void writeInstances(SceneWriting& writing);
void writeShapes(SceneWriting& writing);
void writeLights(SceneWriting& writing);

/// An empty line, and a header such as "[camera]".
void begin(SceneWriting& writing, const std::string& header);
/// "key = value"
void put(SceneWriting& writing, const char* key, const std::string& value);

/// "[a, b]" of one or more.
std::string listOf(std::initializer_list<std::string> values);
/// The shortest text that reads as the same number.
std::string tomlOf(double number);
std::string tomlOf(float number);
std::string tomlOf(std::uint32_t number);
std::string tomlOf(bool flag);
std::string tomlOf(Vec3 vector);
std::string tomlOf(const Color& color);
std::string tomlOf(const std::array<Vec3, 3>& rows);
/// In quotes.
std::string tomlOf(const std::string& text);

} // namespace pointrt
