// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/points/octree_folder.h"

#include <algorithm>
#include <initializer_list>

namespace pointrt {
namespace {

bool holdsKeys(std::string_view text, std::initializer_list<std::string_view> keys) {
    const std::size_t start = text.find_first_not_of(" \t\r\n");
    if (start == std::string_view::npos || text[start] != '{') return false;
    return std::all_of(keys.begin(), keys.end(),
                       [&](std::string_view key) { return text.find(key) != std::string_view::npos; });
}

} // namespace

bool isEptMeta(std::string_view text) {
    return holdsKeys(text, {"\"dataType\"", "\"hierarchyType\"", "\"schema\"", "\"bounds\""});
}

bool isPotreeMeta(std::string_view text) {
    return holdsKeys(text, {"\"hierarchy\"", "\"firstChunkSize\"", "\"attributes\"", "\"boundingBox\""});
}

bool selectsNode(const Sink& sink, int level, const Eigen::AlignedBox3d& box) {
    if (sink.level && level > *sink.level) return false;
    const auto& bounds = sink.filter.options().bounds;
    if (!bounds) return true;
    const Eigen::Affine3d world_from_file = sink.transform.world_from_input.value_or(Eigen::Affine3d::Identity());
    // rounding to the file's steps may move a point on the box's face outside
    const Vec3d margin = Vec3d::Constant(1e-3 * box.sizes().maxCoeff());
    Eigen::AlignedBox3d world;
    for (int corner = 0; corner < 8; ++corner) {
        Vec3d place;
        for (int axis = 0; axis < 3; ++axis)
            place[axis] = corner >> axis & 1 ? box.max()[axis] + margin[axis] : box.min()[axis] - margin[axis];
        world.extend(world_from_file * place);
    }
    return bounds->intersects(world);
}

Eigen::AlignedBox3d childBox(const Eigen::AlignedBox3d& box, unsigned child) {
    const Vec3d middle = box.center();
    Eigen::AlignedBox3d part = box;
    for (int axis = 0; axis < 3; ++axis) {
        if ((child >> (2 - axis) & 1) != 0)
            part.min()[axis] = middle[axis];
        else
            part.max()[axis] = middle[axis];
    }
    return part;
}

} // namespace pointrt
