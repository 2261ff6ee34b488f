// SPDX-License-Identifier: Apache-2.0
// Gaussians for the tiny scene: of every size, listed at every depth of an octree of two groups.
#pragma once

#include <cmath>
#include <initializer_list>
#include <string>
#include <vector>

#include "tiny_scene.h"

namespace pointrt::test {

struct TinyGaussians {
    pro_gaussians coding{};
    std::vector<std::uint32_t> words, nodes, lists;
    std::vector<std::int8_t> harmonics;
    std::vector<pro_exact_gaussian> exact; ///< none in the golden file

    explicit TinyGaussians(const Scene& scene, std::uint32_t degree = 1) {
        coding.degree = degree;
        coding.deviation_low = -12;
        coding.deviation_step = 10.0f / 4096;
        coding.color_low = -0.5f;
        coding.color_step = 0.00390625f;
        for (std::uint32_t d = 0; d < degree; ++d) coding.harmonic_max[d] = 0.5f + 0.25f * static_cast<float>(d);
        for (std::size_t i = 0; i < scene.splats.size() / PRO_SPLAT_WORDS; ++i) add(scene, i);
        // the root lists splat 4; slot 0 has splats 0 and 1, slot 1 children; there slot 3 has splats 2 and 3
        const auto node = [&](std::uint32_t children, std::initializer_list<std::uint32_t> list) {
            nodes.insert(nodes.end(), {children, static_cast<std::uint32_t>(lists.size())});
            lists.insert(lists.end(), list);
        };
        node(1, {4});
        for (int slot = 1; slot < 8; ++slot) node(0, {});
        node(0, {0, 1});
        node(2, {});
        for (int slot = 2; slot < 8; ++slot) node(0, {});
        for (int slot = 0; slot < 3; ++slot) node(0, {});
        node(0, {2, 3});
        for (int slot = 4; slot < 8; ++slot) node(0, {});
    }

    /// Sets the counts and returns pointers into this.
    pro_gaussians view() const {
        pro_gaussians view = coding;
        view.words = words.data();
        view.harmonics = harmonics.empty() ? nullptr : harmonics.data();
        view.nodes = nodes.data();
        view.lists = lists.data();
        view.node_count = static_cast<std::uint32_t>(nodes.size() / PRO_GAUSSIAN_NODE_WORDS);
        view.list_count = static_cast<std::uint32_t>(lists.size());
        view.exact = exact.data();
        view.exact_count = static_cast<std::uint32_t>(exact.size());
        return view;
    }

    pro_result write(Scene& scene, const std::string& path, pro_message* message = nullptr) const {
        const pro_view sections = scene.view();
        const pro_content content{&scene.info, &sections, nullptr, nullptr, nullptr, 0, nullptr};
        const pro_gaussians pointers = view();
        return pro_write_gaussians(path.c_str(), &content, &pointers, 1, message);
    }

private:
    /// A Gaussian that codes represent exactly, so that every machine writes the same bytes.
    void add(const Scene& scene, std::size_t i) {
        const std::uint32_t* splat = &scene.splats[i * PRO_SPLAT_WORDS];
        pro_splat at;
        pro_splat_decode(splat, scene.info.radius_max, scene.info.radius_step, &at);
        const auto k = static_cast<float>(i);
        pro_gaussian gaussian{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            gaussian.mean[axis] = double{at.position[axis]} + (static_cast<double>(i + axis) - 2) / 16 * 0x1p-21;
            gaussian.deviation[axis] = std::exp2(-8 - k + static_cast<float>(axis));
            gaussian.color[axis] = 0.25f * k + 0.125f * static_cast<float>(axis);
        }
        gaussian.rotation[i % 4] = i % 2 == 0 ? 1.0f : -1.0f;
        gaussian.rotation[(i + 1) % 4] = 0.5f;
        gaussian.opacity = 0.2f + 0.2f * k;
        words.resize(words.size() + PRO_GAUSSIAN_WORDS);
        pro_gaussian_encode(&gaussian, &coding, splat, &words[words.size() - PRO_GAUSSIAN_WORDS]);
        for (std::uint32_t h = 0; h < 3 * pro_harmonic_count(coding.degree); ++h)
            harmonics.push_back(static_cast<std::int8_t>(static_cast<int>(37 * i + 11 * h) % 255 - 127));
    }
};

} // namespace pointrt::test
