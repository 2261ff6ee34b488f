// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/points/las_nodes.h"

#include <algorithm>
#include <cmath>

namespace pointrt {
namespace {

/// The node's cube in the world, with a margin: rounding to the file's scale may move a point on the cube's face
/// outside.
Eigen::AlignedBox3d worldBox(const CopcBox& box, const LasFile& file, const Sink& sink) {
    const Eigen::Affine3d world_from_file = sink.transform.world_from_input.value_or(Eigen::Affine3d::Identity());
    Eigen::AlignedBox3d world;
    for (int corner = 0; corner < 8; ++corner) {
        Vec3d position;
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            const double margin = std::abs(file.header.scale[a]);
            position[axis] = corner >> axis & 1 ? box.high[a] + margin : box.low[a] - margin;
        }
        world.extend(world_from_file * position);
    }
    return world;
}

} // namespace

std::vector<LazChunk> selectedNodes(const LasFile& file, const Sink& sink) {
    const auto& bounds = sink.filter.options().bounds;
    return copcChunks(file, [&](int level, const CopcBox& box) {
        if (sink.level && level > *sink.level) return false;
        return !bounds || bounds->intersects(worldBox(box, file, sink));
    });
}

} // namespace pointrt
