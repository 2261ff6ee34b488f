// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "runtime/measure/clip_polygon.h"
#include "runtime/measure/given_points.h"
#include "runtime/studies/cast_batch.h"
#include "runtime/studies/plan_frame.h"
#include "runtime/studies/study_values.h"
#include "runtime/studies/unoccluded.h"

namespace pointrt {
namespace {

constexpr double kCellsAcross = 1000;
constexpr double kMostCells = 1 << 28;

/// A plane in a plan: the height at x and y.
struct BasePlane {
    Vec3 center, normal;
    double heightAt(const PlanePoint& at) const {
        return center.z - (normal.x * (at[0] - center.x) + normal.y * (at[1] - center.y)) / normal.z;
    }
};

BasePlane baseIn(const PlanFrame& frame, const FittedPlane& plane) {
    constexpr double kUpright = 1e-3; // cosine of the angle to up below which the plane counts as vertical
    const Vec3 normal = vectorOf(plane.normal);
    const BasePlane base{frame.planOf(vectorOf(plane.center)),
                         {dot(normal, frame.east), dot(normal, frame.north), dot(normal, frame.up)}};
    if (!(std::abs(base.normal.z) > kUpright)) refuseMeasure("the plane of the rim is vertical: it bounds no volume");
    return base;
}

FittedPlane planeOfBase(std::span<const Position> rim, const PlanFrame& frame, const VolumeRules& rules) {
    if (!rules.base_height) return fitPlane(rim);
    if (!std::isfinite(*rules.base_height)) refuseMeasure("the height of the base must be finite");
    const Vec3 center = frame.origin + (*rules.base_height - dot(frame.origin, frame.up)) * frame.up;
    return {arrayOf(center), rules.up, 0};
}

/// The raster over the rim.
struct Raster {
    PlanePoint low{}, high{};
    double cell = 0;

    double count(std::size_t axis) const { return std::ceil((high[axis] - low[axis]) / cell); }
};

Raster rasterOver(const std::vector<PlanePoint>& rim, double cell) {
    Raster raster{rim[0], rim[0], cell};
    for (const PlanePoint& point : rim)
        for (std::size_t axis = 0; axis < 2; ++axis) {
            raster.low[axis] = std::min(raster.low[axis], point[axis]);
            raster.high[axis] = std::max(raster.high[axis], point[axis]);
        }
    const double longer = std::max(raster.high[0] - raster.low[0], raster.high[1] - raster.low[1]);
    if (!(cell >= 0 && std::isfinite(cell))) refuseMeasure("the cell must be a finite length of 0 or more");
    if (cell == 0) raster.cell = longer / kCellsAcross;
    if (!(raster.count(0) * raster.count(1) <= kMostCells))
        refuseMeasure("the cell is too small: the rim has more than 2^28 cells");
    return raster;
}

/// Adds up the volume cell by cell, in batches of rays.
class VolumeSum {
public:
    VolumeSum(const TraceScene& scene, const PlanFrame& frame, const BasePlane& base)
        : scene_(scene), frame_(frame), base_(base), top_(planHeights(scene, frame).high) {}

    void add(const PlaneArea& piece) {
        pieces_.push_back(piece);
        rays_.add(frame_.pointAt({piece.centroid[0], piece.centroid[1], top_}), -1.0 * frame_.up);
        if (pieces_.size() == kRaysAtOnce) cast();
    }

    void cast() {
        const std::span<const double> distances = rays_.cast(scene_);
        for (std::size_t i = 0; i < pieces_.size(); ++i) {
            if (!std::isfinite(distances[i])) continue;
            const double above = top_ - distances[i] - base_.heightAt(pieces_[i].centroid);
            volume.covered += pieces_[i].area;
            (above > 0 ? volume.cut : volume.fill) += std::abs(above) * pieces_[i].area;
        }
        volume.rays += pieces_.size();
        pieces_.clear();
        rays_.clear();
    }

    Volume volume;

private:
    const TraceScene& scene_;
    const PlanFrame& frame_;
    const BasePlane& base_;
    double top_;
    std::vector<PlaneArea> pieces_;
    CastBatch rays_;
};

/// The columns of the raster that a strip of the rim reaches.
std::pair<double, double> columnsOf(const std::vector<PlanePoint>& strip, const Raster& raster) {
    double low = raster.high[0], high = raster.low[0];
    for (const PlanePoint& point : strip) {
        low = std::min(low, point[0]);
        high = std::max(high, point[0]);
    }
    return {std::floor((low - raster.low[0]) / raster.cell), std::ceil((high - raster.low[0]) / raster.cell)};
}

/// @param sense sign of the rim's area
void addCells(const std::vector<PlanePoint>& rim, double sense, const Raster& raster, VolumeSum& sum) {
    constexpr double kNoArea = 1e-9; // share of a cell's area: less is rounding
    const double least = kNoArea * raster.cell * raster.cell;
    for (double row = 0; row < raster.count(1); ++row) {
        const double south = raster.low[1] + row * raster.cell;
        const std::vector<PlanePoint> strip = clippedTo(rim, 1, south, south + raster.cell);
        const auto [first, end] = columnsOf(strip, raster);
        for (double column = first; column < end; ++column) {
            const double west = raster.low[0] + column * raster.cell;
            PlaneArea piece = areaOf(clippedTo(strip, 0, west, west + raster.cell));
            piece.area *= sense;
            if (piece.area < -least) refuseMeasure("the rim crosses itself");
            if (piece.area > least) sum.add(piece);
        }
    }
    sum.cast();
}

} // namespace

Volume measureVolume(const TraceScene& scene, std::span<const Position> rim, const VolumeRules& rules) {
    const std::vector<Vec3> points = vectorsOf(rim, 3, "a volume");
    const PlanFrame frame = planFrame(points[0], rules.up);
    std::vector<PlanePoint> outline;
    for (const Vec3& point : points) {
        const Vec3 plan = frame.planOf(point);
        outline.push_back({plan.x, plan.y});
    }
    const FittedPlane plane = planeOfBase(rim, frame, rules);
    const BasePlane base = baseIn(frame, plane);
    const Raster raster = rasterOver(outline, rules.cell);
    const double area = areaOf(outline).area;
    VolumeSum sum(scene, frame, base);
    addCells(outline, area < 0 ? -1 : 1, raster, sum);
    sum.volume.area = std::abs(area);
    sum.volume.cell = raster.cell;
    sum.volume.base = plane;
    return sum.volume;
}

} // namespace pointrt
