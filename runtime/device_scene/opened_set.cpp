// SPDX-License-Identifier: Apache-2.0
#include "runtime/device_scene/opened_set.h"

#include <limits>

#include "format/set/open_tile.h"
#include "runtime/device_scene/render_space.h"

namespace pointrt {
OpenedSet openSet(const std::string& folder) {
    OpenedSet set;
    set.folder = folder;
    set.set = readTileSet(folder);
    set.children = childrenOf(set.set);
    set.missing.assign(set.set.tiles.size(), false);
    set.hit_unseen.assign(set.set.tiles.size(), false);
    return set;
}

std::string tilePath(const OpenedSet& set, std::uint32_t tile) { return tilePath(set.folder, set.set.tiles[tile]); }

CutView cutView(const Placement& placement, const Camera& camera, PixelSize size) {
    CutView view;
    view.camera.eye = unplaced(placement, camera.eye);
    view.camera.right = unrotated(placement, camera.right);
    view.camera.up = unrotated(placement, camera.up);
    view.camera.forward = unrotated(placement, camera.forward);
    view.camera.fov_deg = camera.fov_deg;
    view.camera.panorama = camera.panorama;
    view.camera.ortho_height = camera.ortho_height / placement.scale;
    view.aspect = static_cast<double>(size.width) / size.height;
    view.height = size.height;
    return view;
}

void chooseCuts(OpenedSet& set, CutRequest request) {
    request.missing = set.missing;
    request.hit_unseen = set.hit_unseen;
    set.cut = chooseCut(set.set, set.children, request);
    set.full_cut = set.cut;
    if (set.cut.fits) return;
    request.memory = std::numeric_limits<std::uint64_t>::max();
    set.full_cut = chooseCut(set.set, set.children, request);
}

} // namespace pointrt
