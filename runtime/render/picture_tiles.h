// SPDX-License-Identifier: Apache-2.0
// The tiles of sets that a picture of a loaded scene is traced with.
#pragma once

#include "runtime/device_scene/scene_tiles.h"
#include "runtime/render/loaded_scene.h"

namespace pointrt {

/// Of `memory` bytes those that tiles may take beside a picture of the settings' size.
std::uint64_t pictureTileMemory(const Device& device, const RenderSettings& settings, std::uint64_t memory);

/// What loaded's camera, or the turntable that request tells of, wants at its settings' size.
TileRequest tileRequest(const Device& device, const LoadedScene& loaded, const LoadRequest& request);

/// Finer tiles where rays meet what no camera sees, round by round, with tables and programs for them. Tiles stand
/// already, and the tracer is there, without photons that count.
void refineTiles(Device& device, LoadedScene& loaded, const LoadRequest& request);

/// The tiles of a picture from loaded's camera in place of those of the last one, as a scene that is loaded for it has
/// them, refined.
void standTilesAnew(Device& device, LoadedScene& loaded, const LoadRequest& request);

} // namespace pointrt
