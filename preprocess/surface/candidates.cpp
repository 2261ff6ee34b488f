// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/candidates.h"

#include <algorithm>

namespace pointrt::surface {
namespace {

/// Ranks counted at once: two vector registers of any x86-64.
constexpr std::size_t kLanes = 8;

/// Copies the values up to a limit, with their indices, to the front of kept, which may be the same arrays. Returns
/// their number. Writes every value, but advances only past those to keep, which avoids mispredicted branches.
std::size_t keepUpTo(float limit, const float* squared, const std::uint32_t* indices, std::size_t count, float* kept,
                     std::uint32_t* kept_indices) {
    std::size_t end = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const float value = squared[i];
        kept[end] = value;
        kept_indices[end] = indices[i];
        end += value <= limit;
    }
    return end;
}

} // namespace

Candidates::Candidates(std::size_t most) {
    indices_.resize(most);
    for (auto* values : {&x_, &y_, &z_, &squared_, &sorted_}) values->resize(most);
    kept_.resize(most + kLanes);
    for (auto* indices : {&kept_indices_, &sorted_indices_}) indices->resize(most);
    used_.resize(most);
}

bool Candidates::fetch(const NearestSearch& search, const std::vector<Vec3f>& positions, const Vec3f& center,
                       float radius) {
    count_ = search.within(center, radius * radius, indices_);
    if (count_ > indices_.size()) return false;
    for (std::size_t i = 0; i < count_; ++i) {
        const Vec3f& position = positions[indices_[i]];
        x_[i] = position.x(), y_[i] = position.y(), z_[i] = position.z();
    }
    return true;
}

std::size_t Candidates::choose(const Vec3f& from, float squared_radius, std::size_t wanted) {
    measure(from);
    keepWithin(squared_radius);
    if (kept_count_ > wanted) thinKept(squared_radius, wanted);
    sortKept();
    return kept_count_;
}

/// squaredDistance to all candidates.
void Candidates::measure(const Vec3f& from) {
    const float from_x = from.x(), from_y = from.y(), from_z = from.z();
    const float *x = x_.data(), *y = y_.data(), *z = z_.data();
    float* __restrict squared = squared_.data();
    for (std::size_t i = 0; i < count_; ++i) {
        const float dx = from_x - x[i], dy = from_y - y[i], dz = from_z - z[i];
        squared[i] = dx * dx + dy * dy + dz * dz;
    }
}

void Candidates::keepWithin(float squared_radius) {
    kept_count_ =
        keepUpTo(squared_radius, squared_.data(), indices_.data(), count_, kept_.data(), kept_indices_.data());
}

/// On a surface, the number of points grows with the square of the radius: drops those beyond the radius that should
/// hold the wanted number and a third more. Keeps all if that is too few.
void Candidates::thinKept(float squared_radius, std::size_t wanted) {
    constexpr float kSpare = 4.0f / 3.0f;
    const float limit = squared_radius * kSpare * float(wanted) / float(kept_count_);
    const auto enough = std::count_if(kept_.begin(), kept_.begin() + std::ptrdiff_t(kept_count_),
                                      [&](float squared) { return squared <= limit; });
    if (std::size_t(enough) < wanted) return;
    kept_count_ = keepUpTo(limit, kept_.data(), kept_indices_.data(), kept_count_, kept_.data(), kept_indices_.data());
}

/// Sorts by distance, then index. Counts the rank of each against all others: for the usual 25, that takes half the
/// time of a sort with branches.
void Candidates::sortKept() {
    const std::size_t count = kept_count_;
    std::fill_n(used_.begin(), count, std::uint16_t(0));
    bool ties = false;
    for (std::size_t first = 0; first < count; first += kLanes) {
        float mine[kLanes];
        std::int32_t rank[kLanes] = {};
        std::copy_n(kept_.data() + first, kLanes, mine);
        for (std::size_t other = 0; other < count; ++other)
            for (std::size_t lane = 0; lane < kLanes; ++lane) rank[lane] += kept_[other] < mine[lane];
        for (std::size_t lane = 0; lane < std::min(kLanes, count - first); ++lane) {
            const auto lowest = std::size_t(rank[lane]);
            ties = ties || used_[lowest] > 0;
            const std::size_t place = lowest + used_[lowest]++;
            sorted_[place] = mine[lane];
            sorted_indices_[place] = kept_indices_[first + lane];
        }
    }
    if (!ties) return;
    for (std::size_t first = 0, last; first < count; first = last) {
        for (last = first + 1; last < count && sorted_[last] == sorted_[first];) ++last;
        std::sort(sorted_indices_.begin() + std::ptrdiff_t(first), sorted_indices_.begin() + std::ptrdiff_t(last));
    }
}

} // namespace pointrt::surface
