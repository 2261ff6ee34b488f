// SPDX-License-Identifier: Apache-2.0
#include "runtime/studies/section_sweep.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "runtime/measure/given_points.h"
#include "runtime/studies/unoccluded.h"
#include "runtime/util/vec_array.h"

namespace pointrt {
namespace {

constexpr double kMostSweepRays = 1 << 22;
/// Surfaces on a ray that are less than this many steps apart count as one.
constexpr double kApart = 2;
/// Below sin(12 degrees), a surface runs along the plane, and the place of its cut is arbitrary.
constexpr double kLeastTilt = 0.2;
/// cos(55 degrees): surfaces at which rays of one sweep graze are hit by the other sweep; the ranges overlap by 10
/// degrees.
constexpr double kLeastSlope = 0.57;

/// The transform from the plane's axes to space.
struct CutPlane {
    Vec3 point, right, up;
    Vec3 spaceOf(Vec2 at) const { return point + at.x * right + at.y * up; }
    Vec2 planeOf(Vec3 direction) const { return {dot(direction, right), dot(direction, up)}; }
};

/// A rectangle of the plane.
struct CutBounds {
    Vec2 low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
};

CutBounds boundsIn(const TraceScene& scene, const CutPlane& plane) {
    const SceneBounds box = scene.bounds();
    CutBounds bounds;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const auto side = [&](unsigned axis) { return (corner >> axis & 1 ? box.high : box.low)[axis]; };
        const Vec2 at = plane.planeOf(Vec3{side(0), side(1), side(2)} - plane.point);
        bounds.low = {std::min(bounds.low.x, at.x), std::min(bounds.low.y, at.y)};
        bounds.high = {std::max(bounds.high.x, at.x), std::max(bounds.high.y, at.y)};
    }
    return bounds;
}

/// A ray of a sweep, which continues behind its last hit.
struct SweepRay {
    std::uint32_t number = 0;
    double at = 0; ///< position along the axis
};

struct SweepHit {
    std::uint32_t number = 0; ///< of the ray
    double at = 0;
    Vec2 normal; ///< unit length
};

/// The rays along one axis of the plane.
class Sweep {
public:
    Sweep(const TraceScene& scene, const CutPlane& plane, const CutBounds& bounds, bool upwards, double step)
        : scene_(scene), plane_(plane), upwards_(upwards), step_(step) {
        std::tie(start_, end_) = std::pair(along(bounds.low) - step, along(bounds.high) + step);
        first_ = across(bounds.low) + step / 2;
        const double rays = std::ceil((across(bounds.high) - across(bounds.low)) / step);
        if (!(rays <= kMostSweepRays)) refuseMeasure("the step is too short: more than 2^22 rays");
        count_ = static_cast<std::uint32_t>(rays);
    }

    std::vector<SectionHit> hits() {
        cast(1);
        cast(-1);
        std::ranges::sort(found_, [](const SweepHit& a, const SweepHit& b) {
            return std::tie(a.number, a.at) < std::tie(b.number, b.at);
        });
        std::vector<SectionHit> merged;
        for (std::size_t i = 0; i < found_.size();) merged.push_back(mergedFrom(i));
        return merged;
    }

private:
    double along(Vec2 at) const { return upwards_ ? at.y : at.x; }
    double across(Vec2 at) const { return upwards_ ? at.x : at.y; }
    Vec2 placeOf(std::uint32_t number, double at) const {
        const double aside = first_ + number * step_;
        return upwards_ ? Vec2{aside, at} : Vec2{at, aside};
    }

    /// Casts all rays through all surfaces.
    void cast(double sign) {
        std::vector<SweepRay> open;
        for (std::uint32_t i = 0; i < count_; ++i) open.push_back({i, sign > 0 ? start_ : end_});
        while (!open.empty()) {
            std::vector<SweepRay> further;
            for (std::size_t first = 0; first < open.size(); first += kRaysAtOnce)
                castSome(std::span(open).subspan(first, std::min(kRaysAtOnce, open.size() - first)), sign, further);
            open = std::move(further);
        }
    }

    void castSome(std::span<const SweepRay> rays, double sign, std::vector<SweepRay>& further) {
        const Vec3 direction = sign * (upwards_ ? plane_.up : plane_.right);
        numbers_.clear();
        for (const SweepRay& ray : rays) {
            const Vec3 origin = plane_.spaceOf(placeOf(ray.number, ray.at));
            numbers_.insert(numbers_.end(), {origin.x, origin.y, origin.z, direction.x, direction.y, direction.z});
        }
        distances_.resize(rays.size());
        normals_.resize(3 * rays.size());
        scene_.castRays(std::span<const double>(numbers_), {}, {.t_hit = distances_, .normals = normals_});
        for (std::size_t k = 0; k < rays.size(); ++k) {
            if (!std::isfinite(distances_[k])) continue;
            const double at = rays[k].at + sign * distances_[k];
            addHit(rays[k].number, at, Vec3{normals_[3 * k], normals_[3 * k + 1], normals_[3 * k + 2]});
            further.push_back({rays[k].number, at + sign * kApart * step_});
        }
    }

    void addHit(std::uint32_t number, double at, Vec3 normal) {
        const Vec2 tilted = plane_.planeOf(normal);
        const double tilt = length(tilted);
        if (tilt < kLeastTilt || std::abs(along(tilted)) < kLeastSlope * tilt) return;
        found_.push_back({number, at, (1 / tilt) * tilted});
    }

    /// The mean of the hits on one surface, from hit i on; i is then behind them.
    SectionHit mergedFrom(std::size_t& i) const {
        const SweepHit& first = found_[i];
        double at = 0, count = 0;
        Vec2 normal;
        for (; i < found_.size() && found_[i].number == first.number && found_[i].at - first.at <= kApart * step_;
             ++i) {
            at += found_[i].at;
            normal = normal + (dot(found_[i].normal, first.normal) < 0 ? -1.0 : 1.0) * found_[i].normal;
            ++count;
        }
        const double size = length(normal); // at least 1, since no normal points away from the first
        return {placeOf(first.number, at / count), {-normal.y / size, normal.x / size}};
    }

    const TraceScene& scene_;
    const CutPlane& plane_;
    bool upwards_;
    double step_, start_ = 0, end_ = 0, first_ = 0;
    std::uint32_t count_ = 0;
    std::vector<SweepHit> found_;
    std::vector<double> numbers_, distances_;
    std::vector<float> normals_;
};

} // namespace

std::vector<SectionHit> sweepPlane(const TraceScene& scene, const SectionPlane& plane, double step) {
    const CutPlane cut{vectorOf(plane.point), vectorOf(plane.right), vectorOf(plane.up)};
    const CutBounds bounds = boundsIn(scene, cut);
    std::vector<SectionHit> hits = Sweep(scene, cut, bounds, false, step).hits();
    const std::vector<SectionHit> others = Sweep(scene, cut, bounds, true, step).hits();
    hits.insert(hits.end(), others.begin(), others.end());
    return hits;
}

} // namespace pointrt
