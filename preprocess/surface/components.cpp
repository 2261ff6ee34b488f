// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/components.h"

#include <atomic>
#include <numeric>

namespace pointrt::surface {

ParitySets::ParitySets(std::size_t count) : parent_(count), flipped_(count, 0), rank_(count, 0) {
    std::iota(parent_.begin(), parent_.end(), 0u);
}

std::pair<std::uint32_t, bool> ParitySets::find(std::uint32_t point) {
    bool flipped = false;
    while (parent_[point] != point) {
        const std::uint32_t parent = parent_[point];
        // Path halving: makes the point a child of its grandparent. This changes nothing if the parent is the root: a
        // root is its own parent, and its flag is 0.
        flipped_[point] ^= flipped_[parent];
        parent_[point] = parent_[parent];
        flipped ^= flipped_[point] != 0;
        point = parent_[point];
    }
    return {point, flipped};
}

bool ParitySets::join(std::uint32_t a, std::uint32_t b, bool flipped) {
    const auto [root_a, flipped_a] = find(a);
    const auto [root_b, flipped_b] = find(b);
    if (root_a == root_b) return false;
    const bool a_below = rank_[root_a] < rank_[root_b];
    const std::uint32_t above = a_below ? root_b : root_a, below = a_below ? root_a : root_b;
    parent_[below] = above;
    flipped_[below] = flipped != (flipped_a != flipped_b);
    if (rank_[above] == rank_[below]) ++rank_[above];
    return true;
}

void ParitySets::flatten() {
    for (std::uint32_t i = 0; i < parent_.size(); ++i) {
        const auto [root, flipped] = find(i);
        if (root == i) continue;
        parent_[i] = root;
        flipped_[i] = flipped;
    }
}

SharedSets::SharedSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }

// Parents only move to lower points of the same set, so that any value another thread sees is valid.

std::uint32_t SharedSets::find(std::uint32_t point) {
    for (;;) {
        std::atomic_ref<std::uint32_t> link(parent_[point]);
        const std::uint32_t parent = link.load(std::memory_order_relaxed);
        if (parent == point) return point;
        std::uint32_t expected = parent;
        const std::uint32_t above = std::atomic_ref(parent_[parent]).load(std::memory_order_relaxed);
        if (above != parent) link.compare_exchange_weak(expected, above, std::memory_order_relaxed);
        point = above;
    }
}

void SharedSets::join(std::uint32_t a, std::uint32_t b) {
    for (;;) {
        a = find(a), b = find(b);
        if (a == b) return;
        if (a < b) std::swap(a, b);
        std::uint32_t expected = a;
        // Fails if another thread has changed the parent of a.
        if (std::atomic_ref(parent_[a]).compare_exchange_strong(expected, b, std::memory_order_relaxed)) return;
    }
}

} // namespace pointrt::surface
