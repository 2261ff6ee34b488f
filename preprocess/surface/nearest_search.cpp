// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/nearest_search.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <tbb/parallel_invoke.h>
#include <tuple>

namespace pointrt::surface {
namespace {

/// As measured with FLANN: its default of 10 takes half as long again to build, and as long to search.
constexpr std::uint32_t kLeafPoints = 24;

/// Fewer points are divided by one thread: starting a second one takes longer than a hundredth of their time.
constexpr std::uint32_t kParallelPoints = 4096;

using Node = NearestSearch::Node;
using Box = NearestSearch::Box;

/// Divides ranges of points in place.
class TreeBuilder {
public:
    explicit TreeBuilder(NearestSearch::Columns& columns) : columns_(columns) {}

    Box boxOf(std::uint32_t begin, std::uint32_t end) const {
        Box box;
        for (int axis = 0; axis < 3; ++axis) std::tie(box.low[axis], box.high[axis]) = limitsOf(begin, end, axis);
        return box;
    }

    /// Appends the nodes of a range, and shrinks box, which holds its points, to them.
    void divide(std::uint32_t begin, std::uint32_t end, Box& box, std::vector<Node>& nodes) {
        const std::size_t place = nodes.size();
        nodes.push_back({.begin = begin, .end = end});
        if (end - begin <= kLeafPoints) {
            box = boxOf(begin, end);
            return;
        }
        const Cut cut = cutOf(begin, end, box);
        const std::uint32_t middle = split(begin, end, cut);
        Box first = box, second = box;
        first.high[cut.axis] = second.low[cut.axis] = cut.value;
        std::vector<Node> others;
        const auto divideFirst = [&] { divide(begin, middle, first, nodes); };
        if (end - begin < kParallelPoints)
            divideFirst();
        else
            tbb::parallel_invoke(divideFirst, [&] { divide(middle, end, second, others); });
        const std::size_t at = nodes.size() - place;
        if (others.empty())
            divide(middle, end, second, nodes);
        else
            nodes.insert(nodes.end(), others.begin(), others.end());
        nodes[place] = {first.high[cut.axis], second.low[cut.axis], std::uint32_t(cut.axis), std::uint32_t(at)};
        box = {first.low.cwiseMin(second.low), first.high.cwiseMax(second.high)};
    }

private:
    struct Cut {
        int axis = 0;
        float value = 0;
    };

    std::pair<float, float> limitsOf(std::uint32_t begin, std::uint32_t end, int axis) const {
        const float* values = columns_.axes[std::size_t(axis)].data();
        float low = values[begin], high = low;
        for (std::uint32_t i = begin + 1; i < end; ++i)
            low = values[i] < low ? values[i] : low, high = values[i] > high ? values[i] : high;
        return {low, high};
    }

    /// The middle of the points along the axis on which they spread most. box may be wider than they are.
    Cut cutOf(std::uint32_t begin, std::uint32_t end, const Box& box) const {
        const Vec3f spans = box.high - box.low;
        int widest = 0;
        for (int axis = 1; axis < 3; ++axis)
            if (spans[axis] > spans[widest]) widest = axis;
        Cut cut;
        float most = -1;
        const auto consider = [&](int axis) {
            const auto [low, high] = limitsOf(begin, end, axis);
            if (high - low <= most) return;
            most = high - low;
            cut = {axis, (low + high) / 2};
        };
        consider(widest);
        for (int axis = 0; axis < 3; ++axis)
            if (axis != widest && spans[axis] > most) consider(axis);
        return cut;
    }

    void swapPoints(std::uint32_t a, std::uint32_t b) {
        for (std::vector<float>& axis : columns_.axes) std::swap(axis[a], axis[b]);
        std::swap(columns_.indices[a], columns_.indices[b]);
    }

    /// Moves the points for which isFirst(value) holds to the front. Returns the end of these.
    template <typename Test>
    std::uint32_t partition(std::uint32_t begin, std::uint32_t end, int axis, const Test& isFirst) {
        const float* values = columns_.axes[std::size_t(axis)].data();
        for (;;) {
            while (begin < end && isFirst(values[begin])) ++begin;
            while (begin < end && !isFirst(values[end - 1])) --end;
            if (begin >= end) return begin;
            swapPoints(begin++, --end);
        }
    }

    /// Moves the points below the cut to the front, those above it to the back, and returns where the halves meet: as
    /// near to the middle as those on the cut allow.
    std::uint32_t split(std::uint32_t begin, std::uint32_t end, const Cut& cut) {
        const std::uint32_t below = partition(begin, end, cut.axis, [&](float value) { return value < cut.value; });
        const std::uint32_t above = partition(below, end, cut.axis, [&](float value) { return value <= cut.value; });
        return std::clamp(begin + (end - begin) / 2, below, above);
    }

    NearestSearch::Columns& columns_;
};

/// Keeps the nearest points sorted; ties go to the lower index.
class NearestFound {
public:
    NearestFound(std::size_t most, float limit) : limit_(limit) {
        static thread_local std::vector<std::uint64_t> keys;
        if (keys.size() < most) keys.resize(most);
        keys_ = {keys.data(), most};
    }

    /// A little above the farthest, because add decides ties.
    float limit() const {
        constexpr float kNextFloat = 1 + std::numeric_limits<float>::epsilon();
        return isFull() ? std::min(limit_, squaredOf(keys_.back()) * kNextFloat) : limit_;
    }

    void add(const std::uint32_t* indices, const float* squared, std::size_t count) {
        const float limit = this->limit();
        for (std::size_t i = 0; i < count; ++i)
            if (squared[i] < limit) insert(std::uint64_t(std::bit_cast<std::uint32_t>(squared[i])) << 32 | indices[i]);
    }

    std::size_t store(std::span<std::uint32_t> indices, std::span<float> squared) const {
        for (std::size_t i = 0; i < count_; ++i) indices[i] = std::uint32_t(keys_[i]), squared[i] = squaredOf(keys_[i]);
        return count_;
    }

private:
    static float squaredOf(std::uint64_t key) { return std::bit_cast<float>(std::uint32_t(key >> 32)); }

    bool isFull() const { return count_ == keys_.size(); }

    void insert(std::uint64_t key) {
        std::uint64_t* const sorted = keys_.data();
        if (isFull() && key >= sorted[count_ - 1]) return;
        std::size_t slot = isFull() ? count_ - 1 : count_++;
        for (; slot > 0 && key < sorted[slot - 1]; --slot) sorted[slot] = sorted[slot - 1];
        sorted[slot] = key;
    }

    std::span<std::uint64_t> keys_; ///< a squared distance's bits, which order as it does, above an index
    float limit_;
    std::size_t count_ = 0;
};

/// Collects all points nearer than a limit.
class NearFound {
public:
    NearFound(std::span<std::uint32_t> indices, float limit) : indices_(indices), limit_(limit) {}

    /// -1, below which there is no distance, ends the search.
    float limit() const { return count_ > indices_.size() ? -1 : limit_; }
    std::size_t count() const { return count_; }

    void add(const std::uint32_t* indices, const float* squared, std::size_t count) {
        if (count_ + count > indices_.size()) return addLast(indices, squared, count);
        for (std::size_t i = 0; i < count; ++i) { // writes all, but advances only past those to keep: no branch
            indices_[count_] = indices[i];
            count_ += squared[i] < limit_;
        }
    }

private:
    /// As add, where not all may fit.
    void addLast(const std::uint32_t* indices, const float* squared, std::size_t count) {
        const float limit = this->limit();
        for (std::size_t i = 0; i < count; ++i) {
            if (!(squared[i] < limit)) continue;
            if (count_ < indices_.size()) indices_[count_] = indices[i];
            count_ = std::min(count_ + 1, indices_.size() + 1);
        }
    }

    std::span<std::uint32_t> indices_;
    float limit_;
    std::size_t count_ = 0;
};

} // namespace

/// A place, and its squared distance along each axis from the node that is visited.
struct NearestSearch::Query {
    Vec3f place, beyond;
};

NearestSearch::NearestSearch(const std::vector<Vec3f>& positions) {
    const auto count = std::uint32_t(positions.size());
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::vector<float>& values = columns_.axes[axis];
        values.resize(count);
        for (std::size_t i = 0; i < count; ++i) values[i] = positions[i][int(axis)];
    }
    columns_.indices.resize(count);
    std::iota(columns_.indices.begin(), columns_.indices.end(), 0u);
    if (count == 0) return;
    TreeBuilder builder(columns_);
    box_ = builder.boxOf(0, count);
    Box shrunk = box_;
    builder.divide(0, count, shrunk, nodes_);
}

template <typename Found>
void NearestSearch::visitLeaf(const Node& leaf, const Vec3f& place, Found& found) const {
    const float px = place.x(), py = place.y(), pz = place.z();
    const float *x = &columns_.axes[0][leaf.begin], *y = &columns_.axes[1][leaf.begin],
                *z = &columns_.axes[2][leaf.begin];
    const std::size_t count = leaf.end - leaf.begin;
    std::array<float, kLeafPoints> squared;
    for (std::size_t i = 0; i < count; ++i) {
        const float dx = px - x[i], dy = py - y[i], dz = pz - z[i];
        squared[i] = dx * dx + dy * dy + dz * dz;
    }
    found.add(&columns_.indices[leaf.begin], squared.data(), count);
}

/// @param squared distance of the node's box, squared
template <typename Found>
void NearestSearch::visit(const Node* node, float squared, Query& query, Found& found) const {
    if (node->second == 0) return visitLeaf(*node, query.place, found);
    const float from_low = query.place[node->axis] - node->low, from_high = query.place[node->axis] - node->high;
    const bool in_first = from_low + from_high < 0;
    const Node *first = node + 1, *second = node + node->second;
    const float gap = in_first ? from_high : from_low, gap_squared = gap * gap;
    visit(in_first ? first : second, squared, query, found);
    float& beyond = query.beyond[node->axis];
    const float before = beyond, other_squared = squared + gap_squared - before;
    if (!(other_squared <= found.limit())) return;
    beyond = gap_squared;
    visit(in_first ? second : first, other_squared, query, found);
    beyond = before;
}

template <typename Found>
void NearestSearch::search(const Vec3f& place, Found& found) const {
    if (nodes_.empty()) return;
    const Vec3f gap = (box_.low - place).cwiseMax(place - box_.high).cwiseMax(0.0f);
    Query query{place, gap.cwiseProduct(gap)};
    visit(nodes_.data(), query.beyond.x() + query.beyond.y() + query.beyond.z(), query, found);
}

std::size_t NearestSearch::nearest(const Vec3f& query, std::span<std::uint32_t> indices,
                                   std::span<float> squared_distances, float squared_limit) const {
    NearestFound found(indices.size(), squared_limit);
    search(query, found);
    return found.store(indices, squared_distances);
}

std::size_t NearestSearch::within(const Vec3f& query, float squared_radius, std::span<std::uint32_t> indices) const {
    NearFound found(indices, squared_radius);
    search(query, found);
    return found.count();
}

} // namespace pointrt::surface
