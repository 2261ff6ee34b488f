// SPDX-License-Identifier: Apache-2.0
#include "runtime/bricks.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <exception>
#include <limits>
#include <span>
#include <thread>

#include "pointrt/tool.hpp"
#include "runtime/node_walk.h"
#include "shaders/brick_layout.h"

namespace pointrt {

namespace {

/// Shaders address the lists with signed integers.
constexpr std::size_t kListedMost = std::numeric_limits<std::int32_t>::max();

/// Leaves are handed to the threads in runs this long.
constexpr std::size_t kRunLeaves = 256;

/// Cells are taken this much larger, in edges, because of rounding; and by this many position steps, because rays look
/// one step ahead (shaders/trace.glsl).
constexpr float kSlackEdges = 1e-3f, kSlackSteps = 1.5f;

using Vector = std::array<float, 3>;

/// A leaf of the file with its place.
struct LeafPlace {
    std::uint32_t leaf;
    Corner corner;
    std::uint32_t shift; ///< log2 of its edge in position steps
};

/// A splat of the leaf in hand, in cell edges from the leaf's lowest corner.
struct Entry {
    std::uint32_t splat;
    Vector center, normal, reach; ///< reach: of the disc's bounding box
    float radius, slab;           ///< slab: half height
};

/// Bricks count cells, and cells list words, from the part's own first.
struct Part {
    std::vector<std::uint32_t> bricks, cells, lists;
};

/// By how much a brick's cells are taken larger; edges: cell edges to a cube unit.
float slackOf(float edges) { return std::max(kSlackEdges, kSlackSteps * PRO_POSITION_STEP * edges); }

float dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Whether disc (slab 0) or slab can meet the cell around middle: its bounding box, its planes and its sphere all do.
/// slack: see slackOf.
bool mayMeet(const Entry& entry, const Vector& middle, float slab, float slack) {
    const float half = 0.5f + slack;
    float along = 0, widest = 0, beyond = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const float offset = entry.center[axis] - middle[axis], normal = std::fabs(entry.normal[axis]);
        const float outside = std::max(std::fabs(offset) - half, 0.0f);
        if (outside > entry.reach[axis] + slab * normal) return false;
        along += entry.normal[axis] * offset;
        widest += normal;
        beyond += outside * outside;
    }
    return std::fabs(along) <= half * widest + slab && beyond <= entry.radius * entry.radius + slab * slab;
}

class BrickBuilder {
public:
    BrickBuilder(const pro_info& info, const pro_view& view, Part& part) : info_(info), view_(view), part_(part) {}

    void run(const LeafPlace& place) {
        gather(place);
        for (auto& list : hittable_) list.clear();
        for (auto& list : blending_) list.clear();
        for (std::uint32_t e = 0; e < entries_.size(); ++e) spread(e);
        std::uint32_t mask = 0;
        const auto first_cell = static_cast<std::uint32_t>(part_.cells.size() / CELL_WORDS);
        for (std::uint32_t c = 0; c < BRICK_CELLS; ++c) {
            if (hittable_[c].empty()) continue; // nothing can be hit where only slabs reach
            mask |= 1u << c;
            emit(c);
        }
        part_.bricks.insert(part_.bricks.end(), {mask, first_cell, place.shift, 0u});
    }

private:
    static Vector middleOf(std::uint32_t cell) {
        return {static_cast<float>(cell % 3) + 0.5f, static_cast<float>(cell / 3 % 3) + 0.5f,
                static_cast<float>(cell / 9) + 0.5f};
    }

    void gather(const LeafPlace& place) {
        const std::uint32_t* leaf = view_.leaves + std::size_t{place.leaf} * PRO_LEAF_WORDS;
        const std::uint32_t members = leaf[PRO_LEAF_COUNTS] & PRO_LEAF_MEMBER_MASK;
        const std::uint32_t refs = leaf[PRO_LEAF_COUNTS] >> PRO_LEAF_REF_SHIFT;
        const float edges = BRICK_SIDE * std::ldexp(1.0f, static_cast<int>(PRO_POSITION_BITS - place.shift));
        slack_ = slackOf(edges);
        entries_.clear();
        for (std::uint32_t k = 0; k < members; ++k) add(place, leaf[PRO_LEAF_FIRST_MEMBER] + k, edges);
        for (std::uint32_t k = 0; k < refs; ++k) add(place, view_.refs[leaf[PRO_LEAF_FIRST_REF] + k], edges);
    }

    /// edges: cell edges to a cube unit.
    void add(const LeafPlace& place, std::uint32_t splat, float edges) {
        pro_splat plain;
        pro_splat_decode(view_.splats + std::size_t{splat} * PRO_SPLAT_WORDS, info_.radius_max, info_.radius_step,
                         &plain);
        Entry entry{};
        entry.splat = splat;
        entry.radius = plain.radius * edges;
        entry.slab = info_.blend_slab * entry.radius;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const float n = plain.normal[axis];
            entry.normal[axis] = n;
            entry.center[axis] =
                (plain.position[axis] - static_cast<float>(place.corner[axis]) * PRO_POSITION_STEP) * edges;
            entry.reach[axis] = entry.radius * std::sqrt(std::max(0.0f, 1.0f - n * n));
        }
        entries_.push_back(entry);
    }

    /// Puts an entry on the lists of the cells it reaches into.
    void spread(std::uint32_t e) {
        const Entry& entry = entries_[e];
        std::array<int, 3> lo, hi;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const float reach = entry.reach[axis] + entry.slab * std::fabs(entry.normal[axis]) + slack_;
            constexpr float kLast = BRICK_SIDE - 1;
            lo[axis] = static_cast<int>(std::clamp(std::floor(entry.center[axis] - reach), 0.0f, kLast));
            hi[axis] = static_cast<int>(std::clamp(std::floor(entry.center[axis] + reach), 0.0f, kLast));
        }
        for (int z = lo[2]; z <= hi[2]; ++z)
            for (int y = lo[1]; y <= hi[1]; ++y)
                for (int x = lo[0]; x <= hi[0]; ++x) offer(e, static_cast<std::uint32_t>(x + 3 * y + 9 * z));
    }

    void offer(std::uint32_t e, std::uint32_t cell) {
        const Vector middle = middleOf(cell);
        if (!mayMeet(entries_[e], middle, entries_[e].slab, slack_)) return;
        (mayMeet(entries_[e], middle, 0.0f, slack_) ? hittable_ : blending_)[cell].push_back(e);
    }

    void emit(std::uint32_t cell) {
        const auto first = static_cast<std::uint32_t>(part_.lists.size());
        const auto& hit = hittable_[cell];
        const auto& blend = blending_[cell];
        if (std::max(hit.size(), blend.size()) > CELL_COUNT_MASK)
            throw Error(ExitCode::kCannotRun, "a cell lists more splats than this viewer can hold");
        const std::uint32_t counts = static_cast<std::uint32_t>(hit.size()) | static_cast<std::uint32_t>(blend.size())
                                                                                  << CELL_COUNT_SHIFT;
        for (const std::uint32_t e : hit) part_.lists.push_back(entries_[e].splat);
        for (const std::uint32_t e : blend) part_.lists.push_back(entries_[e].splat);
        const std::uint32_t normal_word = encodeNormal(meanNormal(hit));
        part_.cells.insert(part_.cells.end(),
                           {first, counts, normal_word, slabWord(hit, decodeNormal(normal_word), middleOf(cell))});
    }

    /// Not of unit length. Normals may be on either side.
    Vector meanNormal(std::span<const std::uint32_t> list) const {
        Vector sum = entries_[list[0]].normal;
        for (const std::uint32_t e : list.subspan(1)) {
            const float side = dot(sum, entries_[e].normal) < 0 ? -1.0f : 1.0f;
            for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += side * entries_[e].normal[axis];
        }
        return sum;
    }

    static std::uint32_t encodeNormal(const Vector& normal) {
        const float length = std::sqrt(dot(normal, normal));
        std::uint32_t word = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const float scaled = length > 0 ? normal[axis] / length : 0.0f;
            const auto code = static_cast<std::uint32_t>(std::lround((scaled + 1.0f) * CELL_NORMAL_ZERO));
            word |= code << (CELL_NORMAL_BITS * axis);
        }
        return word;
    }

    static Vector decodeNormal(std::uint32_t word) {
        Vector normal;
        for (std::size_t axis = 0; axis < 3; ++axis)
            normal[axis] =
                static_cast<float>(word >> (CELL_NORMAL_BITS * axis) & CELL_NORMAL_MASK) / CELL_NORMAL_ZERO - 1.0f;
        return normal;
    }

    /// Between which heights along the normal, as the shader will decode it, the discs lie.
    std::uint32_t slabWord(std::span<const std::uint32_t> list, const Vector& normal, const Vector& middle) const {
        const float length_squared = dot(normal, normal);
        float lo = std::numeric_limits<float>::infinity(), hi = -lo;
        for (const std::uint32_t e : list) {
            const Entry& entry = entries_[e];
            const Vector offset{entry.center[0] - middle[0], entry.center[1] - middle[1], entry.center[2] - middle[2]};
            const float height = dot(normal, offset), cosine = dot(normal, entry.normal);
            const float reach = entry.radius * std::sqrt(std::max(0.0f, length_squared - cosine * cosine));
            lo = std::min(lo, height - reach);
            hi = std::max(hi, height + reach);
        }
        return halfBelow(lo) | halfBelow(-hi) << 16; // the shader negates the second
    }

    /// The largest half float at most value, which is clamped to what a cell can see of it.
    std::uint32_t halfBelow(float value) const {
        constexpr float kMost = 64.0f; // farther than any point of a cell with its slack from its centre
        const float clamped = std::clamp(value - slack_, -kMost, kMost);
        const float step = std::ldexp(1.0f, std::max(std::ilogb(clamped == 0.0f ? 1.0f : clamped) - 10, -24));
        return toHalf(std::floor(clamped / step) * step);
    }

    /// Exact for values that are halves.
    static std::uint32_t toHalf(float value) {
        const auto bits = std::bit_cast<std::uint32_t>(value);
        const std::uint32_t sign = bits >> 16 & 0x8000u;
        const int exponent = static_cast<int>(bits >> 23 & 0xFF) - 127;
        if (exponent < -14) return sign | static_cast<std::uint32_t>(std::lround(std::fabs(value) * 0x1p24f));
        return sign | static_cast<std::uint32_t>(exponent + 15) << 10 | (bits >> 13 & 0x3FFu);
    }

    const pro_info& info_;
    const pro_view& view_;
    Part& part_;
    float slack_ = kSlackEdges;
    std::vector<Entry> entries_;
    std::array<std::vector<std::uint32_t>, BRICK_CELLS> hittable_, blending_; ///< entries of each cell
};

/// Runs work(k) for k in [0, count) on all cores.
template <typename Work>
void forRuns(std::size_t count, const Work& work) {
    std::atomic<std::size_t> next{0};
    std::atomic<bool> failed{false};
    std::exception_ptr failure;
    const auto loop = [&] {
        try {
            for (std::size_t k = next++; k < count && !failed; k = next++) work(k);
        } catch (...) {
            if (!failed.exchange(true)) failure = std::current_exception();
        }
    };
    std::vector<std::jthread> threads(std::min<std::size_t>(count, std::max(1u, std::thread::hardware_concurrency())));
    for (auto& thread : threads) thread = std::jthread(loop);
    threads.clear();
    if (failure) std::rethrow_exception(failure);
}

void append(Part& part, std::span<const LeafPlace> places, Bricks& all) {
    const auto first_cell = static_cast<std::uint32_t>(all.cells.size() / CELL_WORDS);
    const std::size_t first_list = all.lists.size();
    for (std::size_t k = 0; k < places.size(); ++k) {
        std::uint32_t* brick = all.bricks.data() + std::size_t{places[k].leaf} * BRICK_WORDS;
        std::copy_n(part.bricks.data() + k * BRICK_WORDS, BRICK_WORDS, brick);
        brick[BRICK_FIRST_CELL] += first_cell;
    }
    for (std::size_t w = CELL_FIRST; w < part.cells.size(); w += CELL_WORDS)
        part.cells[w] += static_cast<std::uint32_t>(first_list);
    all.cells.insert(all.cells.end(), part.cells.begin(), part.cells.end());
    all.lists.insert(all.lists.end(), part.lists.begin(), part.lists.end());
    part = {};
}

} // namespace

Bricks buildBricks(const pro_info& info, const pro_view& view) {
    std::vector<LeafPlace> places;
    places.reserve(info.leaf_count);
    forNodes({view.nodes, info.node_count}, PRO_MAX_DEPTH,
             [&](std::uint32_t node, const Corner& corner, std::uint32_t shift) {
                 places.push_back({node - 1, corner, shift});
             });
    std::vector<Part> parts((places.size() + kRunLeaves - 1) / kRunLeaves);
    const auto run = [&](std::size_t k) {
        return std::span(places).subspan(k * kRunLeaves, std::min(kRunLeaves, places.size() - k * kRunLeaves));
    };
    forRuns(parts.size(), [&](std::size_t k) {
        BrickBuilder builder(info, view, parts[k]);
        for (const LeafPlace& place : run(k)) builder.run(place);
    });
    Bricks all;
    std::size_t cell_words = 0, listed = 0;
    for (const Part& part : parts) {
        cell_words += part.cells.size();
        listed += part.lists.size();
    }
    if (listed > kListedMost)
        throw Error(ExitCode::kCannotRun, "the cells list more than 2^31 splats, too many for this viewer");
    all.cells.reserve(cell_words);
    all.lists.reserve(listed + 3);
    all.bricks.resize(std::size_t{info.leaf_count} * BRICK_WORDS);
    for (std::size_t k = 0; k < parts.size(); ++k) append(parts[k], run(k), all);
    all.lists.resize((all.lists.size() + 3) / 4 * 4);
    return all;
}

} // namespace pointrt
