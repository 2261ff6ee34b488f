// SPDX-License-Identifier: Apache-2.0
// Selection of the tiles of sets for a picture of a loaded scene.
#pragma once

#include "runtime/device_scene/scene_tiles.h"
#include "runtime/render/loaded_scene.h"

namespace pointrt {

/// The bytes of `memory` that a picture of the settings' size leaves for tiles.
std::uint64_t pictureTileMemory(const Device& device, const RenderSettings& settings, std::uint64_t memory);

/// The tile request of the loaded camera, or of the turntable of request, at the settings' size.
TileRequest tileRequest(const Device& device, const LoadedScene& loaded, const LoadRequest& request);

/// Loads finer tiles outside the views where secondary rays hit them, in several rounds, and rebuilds tables and
/// programs. Needs loaded tiles and a tracer; its photons are not used.
void refineTiles(Device& device, LoadedScene& loaded, const LoadRequest& request);

/// Replaces the tiles by those for a picture from the loaded camera, refined: the same tiles as in a scene loaded for
/// that camera.
void reselectTiles(Device& device, LoadedScene& loaded, const LoadRequest& request);

} // namespace pointrt
