// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "runtime/measure/given_points.h"
#include "runtime/studies/cast_batch.h"
#include "runtime/studies/plan_frame.h"
#include "runtime/studies/study_values.h"
#include "runtime/studies/unoccluded.h"

namespace pointrt {
namespace {

constexpr double kDefaultStations = 1000;
constexpr double kMostStations = 1 << 22;
/// Largest number of surfaces on a ray; foliage in airborne scans has some tens.
constexpr std::uint32_t kMostLayers = 256;
/// The smallest distance between two surfaces on a ray, relative to the scene's height: some rounding errors of a
/// float.
constexpr double kLeastApart = 1e-6;
/// The largest number of rays across a band.
constexpr double kMostAcross = 101;

/// A station of the line in a plan.
struct Station {
    double along = 0;
    Vec3 place; ///< at the height of the plan's origin
    Vec3 aside; ///< across the line, unit length
};

class Stations {
public:
    Stations(const std::vector<Vec3>& line, const PlanFrame& frame, double step) {
        for (const Vec3& point : line) {
            const Vec3 plan = frame.planOf(point);
            const Vec3 level{plan.x, plan.y, 0};
            if (!corners_.empty() && level == corners_.back()) continue;
            ends_.push_back(corners_.empty() ? 0 : ends_.back() + length(level - corners_.back()));
            corners_.push_back(level);
        }
        if (corners_.size() < 2) refuseMeasure("the line has no horizontal length");
        step_ = step > 0 ? step : ends_.back() / kDefaultStations;
        if (!(ends_.back() / step_ < kMostStations)) refuseMeasure("the step is too short: more than 2^22 stations");
        // in steps: the end of the line gets its own station unless the last station is this close to it
        constexpr double kRounding = 1e-6;
        count_ = static_cast<std::size_t>(std::ceil(ends_.back() / step_ - kRounding)) + 1;
    }

    std::size_t count() const { return count_; }
    double step() const { return step_; }

    Station at(std::size_t number) const {
        const double along = std::min(static_cast<double>(number) * step_, ends_.back());
        const auto next = std::upper_bound(ends_.begin() + 1, ends_.end() - 1, along);
        const auto leg = static_cast<std::size_t>(next - ends_.begin());
        const Vec3 from = corners_[leg - 1], to = corners_[leg];
        const Vec3 forward = normalize(to - from);
        return {along, from + (along - ends_[leg - 1]) * forward, {-forward.y, forward.x, 0}};
    }

private:
    std::vector<Vec3> corners_; ///< z is 0
    std::vector<double> ends_;  ///< length of the line up to each corner
    double step_ = 0;
    std::size_t count_ = 0;
};

/// The vertical rays of a profile.
struct VerticalRays {
    const TraceScene& scene;
    const PlanFrame& frame;
    double start = 0; ///< z in the plan where rays start
    double sign = -1; ///< direction of the rays along z

    Vec3 originAt(Vec3 plan, double z) const { return frame.pointAt({plan.x, plan.y, z}); }
    Vec3 direction() const { return sign * frame.up; }
};

VerticalRays verticalRays(const TraceScene& scene, const PlanFrame& frame, const ProfileRules& rules) {
    const PlanHeights heights = planHeights(scene, frame);
    const bool down = rules.from == ProfileSide::kAbove;
    VerticalRays rays{scene, frame, down ? heights.high : heights.low, down ? -1.0 : 1.0};
    if (rules.start_height) rays.start = *rules.start_height - dot(frame.origin, frame.up);
    return rays;
}

ProfilePoint pointAt(const VerticalRays& rays, const Station& station, std::uint32_t layer, double z) {
    const Vec3 position = rays.originAt(station.place, z);
    const double height = dot(position, rays.frame.up);
    return {station.along, layer, true, arrayOf(position), height, height, height};
}

ProfilePoint missAt(const VerticalRays& rays, const Station& station) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    return {station.along, 0, false, arrayOf(rays.frame.pointAt(station.place)), none, none, none};
}

/// A ray that continues past its last hit.
struct OpenRay {
    std::size_t station; ///< among those of the batch
    double z;
};

/// All surfaces along the rays of these stations; with one layer, only the first.
void castLayers(const VerticalRays& rays, std::span<const Station> stations, std::uint32_t layers, double apart,
                std::vector<ProfilePoint>& points) {
    std::vector<std::vector<ProfilePoint>> found(stations.size());
    std::vector<OpenRay> open;
    for (std::size_t i = 0; i < stations.size(); ++i) open.push_back({i, rays.start});
    CastBatch batch;
    for (std::uint32_t layer = 0; layer < layers && !open.empty(); ++layer) {
        batch.clear();
        for (const OpenRay& ray : open) batch.add(rays.originAt(stations[ray.station].place, ray.z), rays.direction());
        const std::span<const double> distances = batch.cast(rays.scene);
        std::vector<OpenRay> further;
        for (std::size_t k = 0; k < open.size(); ++k) {
            if (!std::isfinite(distances[k])) continue;
            const double z = open[k].z + rays.sign * distances[k];
            found[open[k].station].push_back(pointAt(rays, stations[open[k].station], layer, z));
            further.push_back({open[k].station, z + rays.sign * apart});
        }
        open = std::move(further);
    }
    for (std::size_t i = 0; i < stations.size(); ++i) {
        if (found[i].empty()) found[i].push_back(missAt(rays, stations[i]));
        points.insert(points.end(), found[i].begin(), found[i].end());
    }
}

double medianOf(std::vector<double>& numbers) {
    std::ranges::sort(numbers);
    const std::size_t middle = numbers.size() / 2;
    return numbers.size() % 2 == 1 ? numbers[middle] : (numbers[middle - 1] + numbers[middle]) / 2;
}

/// The median over rays across the line, evenly spaced from edge to edge of the band.
void castBand(const VerticalRays& rays, std::span<const Station> stations, double width, std::size_t across,
              std::vector<ProfilePoint>& points) {
    CastBatch batch;
    for (const Station& station : stations)
        for (std::size_t k = 0; k < across; ++k) {
            const double off = width * (static_cast<double>(k) / static_cast<double>(across - 1) - 0.5);
            batch.add(rays.originAt(station.place + off * station.aside, rays.start), rays.direction());
        }
    const std::span<const double> distances = batch.cast(rays.scene);
    for (std::size_t i = 0; i < stations.size(); ++i) {
        std::vector<double> heights;
        for (std::size_t k = 0; k < across; ++k)
            if (const double t = distances[i * across + k]; std::isfinite(t))
                heights.push_back(rays.start + rays.sign * t);
        if (heights.empty()) {
            points.push_back(missAt(rays, stations[i]));
            continue;
        }
        ProfilePoint point = pointAt(rays, stations[i], 0, medianOf(heights));
        const double ground = dot(rays.frame.origin, rays.frame.up);
        point.low = ground + heights.front();
        point.high = ground + heights.back();
        points.push_back(point);
    }
}

void requireRules(const ProfileRules& rules) {
    for (const double length : {rules.step, rules.apart, rules.width})
        if (!(length >= 0 && std::isfinite(length))) refuseMeasure("lengths of a profile must be finite and 0 or more");
    if (rules.start_height && !std::isfinite(*rules.start_height)) refuseMeasure("the start height must be finite");
    if (rules.all && rules.width > 0) refuseMeasure("all surfaces and a band's width cannot be combined");
}

} // namespace

std::vector<ProfilePoint> surfaceProfile(const TraceScene& scene, std::span<const Position> line,
                                         const ProfileRules& rules) {
    const std::vector<Vec3> corners = vectorsOf(line, 2, "a profile");
    requireRules(rules);
    const PlanFrame frame = planFrame(corners[0], rules.up);
    const Stations stations(corners, frame, rules.step);
    const VerticalRays rays = verticalRays(scene, frame, rules);
    const PlanHeights heights = planHeights(scene, frame);
    const double apart = std::max(rules.apart, kLeastApart * (heights.high - heights.low));
    const double across =
        rules.width > 0 ? std::clamp(2 * std::floor(rules.width / 2 / stations.step()) + 1, 3.0, kMostAcross) : 1;
    const std::size_t at_once = kRaysAtOnce / static_cast<std::size_t>(across);
    std::vector<ProfilePoint> points;
    std::vector<Station> some;
    for (std::size_t first = 0; first < stations.count(); first += at_once) {
        some.clear();
        for (std::size_t i = first; i < std::min(stations.count(), first + at_once); ++i)
            some.push_back(stations.at(i));
        if (rules.width > 0)
            castBand(rays, some, rules.width, static_cast<std::size_t>(across), points);
        else
            castLayers(rays, some, rules.all ? kMostLayers : 1, apart, points);
    }
    return points;
}

} // namespace pointrt
