// SPDX-License-Identifier: Apache-2.0
// The content of a .pro file for tests to change and write, and a tiny valid example.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pointrt/pro.hpp"

namespace pointrt::test {

struct Scene {
    pro_info info{};
    std::vector<std::uint32_t> nodes, leaves, refs, splats, order;
    std::vector<float> materials;
    std::string metadata;

    /// Sets the counts in info and returns pointers into this scene.
    pro_view view() {
        info.node_count = static_cast<std::uint32_t>(nodes.size());
        info.leaf_count = static_cast<std::uint32_t>(leaves.size() / PRO_LEAF_WORDS);
        info.ref_count = static_cast<std::uint32_t>(refs.size());
        info.splat_count = static_cast<std::uint32_t>(splats.size() / PRO_SPLAT_WORDS);
        info.material_count = static_cast<std::uint32_t>(materials.size() / PRO_MATERIAL_FLOATS);
        return {nodes.data(),    leaves.data(),    refs.data(),
                splats.data(),   materials.data(), order.empty() ? nullptr : order.data(),
                metadata.data(), metadata.size()};
    }

    void write(const std::string& path) {
        const pro_view pointers = view();
        writePro(path, info, pointers);
    }

    void addSplat(const pro_splat& splat) {
        splats.resize(splats.size() + PRO_SPLAT_WORDS);
        pro_splat_encode(&splat, info.radius_max, info.radius_step, &splats[splats.size() - PRO_SPLAT_WORDS]);
    }

    void addLeaf(std::uint32_t first_member, std::uint32_t members, std::uint32_t first_ref, std::uint32_t references) {
        leaves.insert(leaves.end(), {first_member, first_ref, members | references << PRO_LEAF_REF_SHIFT, 0});
    }

    void addMaterial(float reflectivity, float specular, float shininess) {
        materials.insert(materials.end(), {1, 1, 1, reflectivity, specular, shininess});
        materials.resize((materials.size() + PRO_MATERIAL_FLOATS - 1) / PRO_MATERIAL_FLOATS * PRO_MATERIAL_FLOATS);
    }
};

/// Five splats in five leaves of a tree of depth 2. Leaf 3 is a border leaf (references only), leaf 1 has members and a
/// reference. Cube edge 2 at (10, 20, 30). golden/tiny_compact.pro holds these bytes.
inline Scene tinyScene() {
    Scene scene;
    pro_info& info = scene.info;
    info.flags = PRO_FLAG_COLOR | PRO_FLAG_ORIENTED;
    info.max_depth = 2;
    info.radius_max = 0.25f;
    info.radius_step = 0.03125f;
    info.blend_slab = 0.5f;
    info.scale = 2;
    const double origin[3] = {10, 20, 30}, low[3] = {10.5, 20.6, 30.2}, high[3] = {11.8, 21.5, 31.5};
    for (int axis = 0; axis < 3; ++axis) {
        info.origin[axis] = origin[axis];
        info.bounds_min[axis] = low[axis];
        info.bounds_max[axis] = high[axis];
    }
    const auto inner = [](std::uint32_t group) { return PRO_NODE_INNER | group; };
    scene.nodes = {inner(1), 0,        0, 0, 0, 0, 0, 0,  // the root
                   1,        inner(2), 4, 0, 0, 0, 0, 5,  // depth 1
                   0,        0,        0, 2, 0, 0, 0, 3}; // depth 2, in the upper half of x
    scene.addLeaf(0, 2, 0, 0);
    scene.addLeaf(2, 1, 0, 1);
    scene.addLeaf(3, 1, 1, 0);
    scene.addLeaf(4, 0, 1, 2);
    scene.addLeaf(4, 1, 3, 0);
    scene.refs = {3, 0, 1};
    scene.addSplat({{0.25f, 0.375f, 0.25f}, {0, 0, 1}, 0.25f, {255, 0, 0}, 0});
    scene.addSplat({{0.4f, 0.45f, 0.1f}, {1, 0, 0}, 0.1f, {0, 255, 0}, 1});
    scene.addSplat({{0.8f, 0.3f, 0.1f}, {0, -1, 0}, 0.05f, {0, 0, 255}, 0});
    scene.addSplat({{0.9f, 0.4f, 0.45f}, {0.6f, 0, -0.8f}, 0.2f, {128, 64, 32}, 0});
    scene.addSplat({{0.75f, 0.75f, 0.75f}, {-0.36f, 0.48f, -0.8f}, 0.01f, {255, 255, 255}, 1});
    scene.order = {3, 0, 7, 1, 2};
    scene.addMaterial(0, 0.25f, 32);
    scene.addMaterial(0.5f, 1, 200);
    scene.metadata = R"({"tool":"tiny_scene.h"})";
    return scene;
}

} // namespace pointrt::test
