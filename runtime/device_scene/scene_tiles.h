// SPDX-License-Identifier: Apache-2.0
// What stands in a scene, on the device: files, and of sets the tiles that a picture is traced with.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/device_scene/device_scene.h"
#include "runtime/util/pixel_size.h"

namespace pointrt {

/// What tiles are chosen for.
struct TileRequest {
    std::vector<Camera> cameras; ///< of the scene, at least one
    PixelSize size;              ///< of their pictures
    std::uint64_t memory = 0;    ///< bytes that the tiles of all sets may take, in files and on the device
    bool painted = false;        ///< splats are painted: they are held once more
    bool verbose = false;
};

/// Puts the tiles that each set of scene is to be seen with on the device, lets others go, and makes scene.instances
/// anew; its tables, and tracers of it, have to be made anew then too. False where they are the tiles that there were,
/// and nothing is done. A tile that cannot be opened is told of on standard error, once, and its parent stands for it
/// from then on; so is a cut that memory made coarser. Throws Error kBadInput where a root is lost, kCannotRun as
/// loadScan does.
bool standTiles(Device& device, DeviceScene& scene, const TileRequest& request);

/// Makes scene.instances of the files and tiles that are on the device, as its description and its sets' cuts say.
void standInstances(Device& device, DeviceScene& scene);

/// request, or less where the device has memory of its own, and less of that.
std::uint64_t tileMemory(const Device& device, std::uint64_t request);

} // namespace pointrt
