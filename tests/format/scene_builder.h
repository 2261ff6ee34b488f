// SPDX-License-Identifier: Apache-2.0
// Builds a simple octree over any splats, for tests that need more than the tiny scene. Slow and unpruned: every leaf
// refers to each splat whose blending slab may overlap it (by bounding boxes, so none is missed).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "tiny_scene.h"

namespace pointrt::test {

struct TreeOptions {
    std::size_t members_max = 8; ///< cells with more centres are split, down to max_depth
    std::uint32_t max_depth = 12;
    float blend_slab = 0.5f;
    float radius_max = 0.25f, radius_step = 0.03125f; ///< cube units, octaves
};

/// A cell before it becomes a node; lists are indices of input splats.
struct BuildCell {
    std::array<std::uint32_t, 3> corner{}; ///< in units of its own edge
    std::uint32_t depth = 0;
    std::vector<std::uint32_t> members, references;
};

/// Half extents of the bounding box of a disc's slab.
inline std::array<float, 3> halfExtent(const pro_splat& splat, float slab) {
    std::array<float, 3> half;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const float n = splat.normal[axis];
        half[axis] = splat.radius * (std::sqrt(std::max(0.0f, 1 - n * n)) + slab * std::fabs(n));
    }
    return half;
}

inline std::vector<BuildCell> splitCell(const BuildCell& cell, const std::vector<pro_splat>& splats, float slab) {
    std::vector<BuildCell> children(PRO_GROUP_SIZE);
    const float edge = std::exp2(-static_cast<float>(cell.depth + 1));
    for (std::uint32_t slot = 0; slot < PRO_GROUP_SIZE; ++slot) {
        children[slot].depth = cell.depth + 1;
        for (std::uint32_t axis = 0; axis < 3; ++axis)
            children[slot].corner[axis] = 2 * cell.corner[axis] + (slot >> axis & 1);
    }
    const auto sort_in = [&](std::uint32_t index, bool member) {
        const pro_splat& splat = splats[index];
        const auto half = halfExtent(splat, slab);
        for (BuildCell& child : children) {
            bool centre = member, meets = true;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const float low = edge * static_cast<float>(child.corner[axis]), at = splat.position[axis];
                centre &= at >= low && at < low + edge;
                meets &= at + half[axis] >= low && at - half[axis] <= low + edge;
            }
            if (centre)
                child.members.push_back(index);
            else if (meets)
                child.references.push_back(index);
        }
    };
    for (const std::uint32_t index : cell.members) sort_in(index, true);
    for (const std::uint32_t index : cell.references) sort_in(index, false);
    return children;
}

/// Numbers the leaves depth first and fills LEAF, REFS and the order of the splats.
inline void numberLeaves(Scene& scene, const std::vector<BuildCell>& cells, std::size_t node) {
    const std::uint32_t word = scene.nodes[node];
    if (word & PRO_NODE_INNER) {
        for (std::size_t slot = 0; slot < PRO_GROUP_SIZE; ++slot)
            numberLeaves(scene, cells, (word & PRO_NODE_GROUP_MASK) * PRO_GROUP_SIZE + slot);
        return;
    }
    const BuildCell& cell = cells[node];
    if (cell.members.empty() && cell.references.empty()) return;
    const auto count = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
    scene.addLeaf(count(scene.order), count(cell.members), count(scene.refs), count(cell.references));
    scene.nodes[node] = count(scene.leaves) / PRO_LEAF_WORDS;
    scene.order.insert(scene.order.end(), cell.members.begin(), cell.members.end());
    scene.refs.insert(scene.refs.end(), cell.references.begin(), cell.references.end());
}

/// A valid scene of the splats (positions in [0, 1)) with one material and a cube of edge 1 at 0. Throws std::bad_alloc
/// only. Writing fails if options lead to more than 65535 members or references in a leaf.
inline Scene sceneOf(std::vector<pro_splat> splats, const TreeOptions& options = {}) {
    Scene scene;
    scene.info.radius_max = options.radius_max;
    scene.info.radius_step = options.radius_step;
    scene.info.blend_slab = options.blend_slab;
    scene.info.scale = 1;
    for (pro_splat& splat : splats) { // as readers decode it
        std::uint32_t words[PRO_SPLAT_WORDS];
        pro_splat_encode(&splat, options.radius_max, options.radius_step, words);
        pro_splat_decode(words, options.radius_max, options.radius_step, &splat);
    }
    std::vector<BuildCell> cells(PRO_GROUP_SIZE);
    cells[0].members.resize(splats.size());
    std::iota(cells[0].members.begin(), cells[0].members.end(), 0u);
    scene.nodes.assign(PRO_GROUP_SIZE, PRO_NODE_EMPTY);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        scene.info.max_depth = std::max(scene.info.max_depth, cells[i].depth);
        if (cells[i].members.size() <= options.members_max || cells[i].depth >= options.max_depth) continue;
        scene.nodes[i] = PRO_NODE_INNER | static_cast<std::uint32_t>(cells.size() / PRO_GROUP_SIZE);
        std::vector<BuildCell> children = splitCell(cells[i], splats, options.blend_slab);
        cells[i].members.clear(); // moved to the children
        std::move(children.begin(), children.end(), std::back_inserter(cells));
        scene.nodes.resize(cells.size(), PRO_NODE_EMPTY);
    }
    numberLeaves(scene, cells, 0);
    const std::vector<std::uint32_t> refs = scene.refs;
    std::vector<std::uint32_t> place(splats.size()); // of each input splat in the file
    for (std::uint32_t i = 0; i < scene.order.size(); ++i) {
        place[scene.order[i]] = i;
        scene.addSplat(splats[scene.order[i]]);
    }
    std::transform(refs.begin(), refs.end(), scene.refs.begin(), [&](std::uint32_t splat) { return place[splat]; });
    for (int axis = 0; axis < 3; ++axis) {
        const auto less = [axis](const pro_splat& a, const pro_splat& b) {
            return a.position[axis] < b.position[axis];
        };
        const auto [low, high] = std::minmax_element(splats.begin(), splats.end(), less);
        scene.info.bounds_min[axis] = low->position[axis];
        scene.info.bounds_max[axis] = high->position[axis];
    }
    scene.addMaterial(0, 0.25f, 32);
    return scene;
}

} // namespace pointrt::test
