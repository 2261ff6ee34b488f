// SPDX-License-Identifier: Apache-2.0
#include "tests/support/pruning_change.h"

#include <algorithm>
#include <numbers>
#include <numeric>

namespace pointrt::test {

namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

/// Quantile of values; 0 if empty. Sorts values.
double quantile(std::vector<double>& values, double share) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// Precise for small angles too, where acos(dot) cancels.
double angleBetween(Vec3 a, Vec3 b) { return kDegrees * std::atan2(length(cross(a, b)), dot(a, b)); }

Vec3 facing(Vec3 normal, Vec3 direction) { return dot(normal, direction) > 0 ? -1.0 * normal : normal; }

class Collector {
public:
    void add(double dt, double radius, Vec3 direction, Vec3 normal_full, Vec3 normal_pruned) {
        const double along_ray = std::abs(dt) / radius,
                     along_normal = along_ray * std::abs(dot(direction, normal_full));
        change_.moved_along_ray += along_ray > kMovedRadii;
        change_.moved_along_normal += along_normal > kMovedRadii;
        moves_.push_back(along_normal);
        angles_.push_back(angleBetween(normal_full, normal_pruned));
    }

    SurfaceChange finish() {
        if (moves_.empty()) return change_;
        change_.move_p999 = quantile(moves_, 0.999);
        change_.move_max = moves_.back();
        change_.angle_mean = std::accumulate(angles_.begin(), angles_.end(), 0.0) / static_cast<double>(angles_.size());
        change_.angle_p99 = quantile(angles_, 0.99);
        change_.angle_p999 = quantile(angles_, 0.999);
        change_.angle_max = angles_.back();
        return change_;
    }

private:
    SurfaceChange change_;
    std::vector<double> moves_, angles_;
};

} // namespace

PruningChange measurePruning(std::span<const CubeSplat> splats, std::span<const Ray> rays,
                             std::span<const CastHit> full, std::span<const CastHit> pruned) {
    PruningChange change;
    change.rays = rays.size();
    Collector flat, blended;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const CastHit &a = full[i], &b = pruned[i];
        change.hits_full += a.hit();
        change.hits_pruned += b.hit();
        change.lost += a.hit() && !b.hit();
        change.gained += !a.hit() && b.hit();
        if (!a.hit() || !b.hit()) continue;
        ++change.hits_both;
        const Vec3 direction = rays[i].direction;
        flat.add(b.t_flat - a.t_flat, splats[a.splat].radius, direction, facing(splats[a.splat].normal, direction),
                 facing(splats[b.splat].normal, direction));
        blended.add(b.t_blended - a.t_blended, a.radius, direction, a.normal, b.normal);
    }
    change.flat = flat.finish();
    change.blended = blended.finish();
    return change;
}

} // namespace pointrt::test
