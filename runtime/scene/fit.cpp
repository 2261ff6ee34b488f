// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace pointrt {
namespace {

constexpr int kRounds = 40;
/// Iterations stop below this relative error, which is invisible.
constexpr double kDone = 0.0005;
/// The smallest depth, as a share of the distance to the centre; splats that are nearer are treated as this far.
constexpr double kNearShare = 0.05;

/// The extents of the splats in the picture: tangents of angles from the line of sight, or lengths if parallel.
struct Shown {
    Extent across, upward;
};

/// A splat in camera axes, relative to the starting point of the fit, and the half extents of its disc.
struct InView {
    double right, up, ahead, reach_right, reach_up;
};

std::vector<InView> viewed(const SceneSample& sample, const ViewBasis& basis, Vec3 from) {
    std::vector<InView> splats;
    splats.reserve(sample.splats.size());
    for (const SampledSplat& splat : sample.splats) {
        const Vec3 to = splat.position - from;
        splats.push_back({dot(to, basis.right), dot(to, basis.up), dot(to, basis.forward),
                          halfExtentAlong(splat, basis.right), halfExtentAlong(splat, basis.up)});
    }
    return splats;
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void include(Extent& extent, double middle, double reach) {
    extent = {std::min(extent.low, middle - reach), std::max(extent.high, middle + reach)};
}

/// distance: from the eye to the origin of the splats' positions; 0 for parallel projection.
Shown shownOf(const std::vector<InView>& splats, double right, double up, double distance) {
    Shown shown{{kInfinity, -kInfinity}, {kInfinity, -kInfinity}};
    for (const InView& splat : splats) {
        const double depth = distance > 0 ? std::max(splat.ahead + distance, kNearShare * distance) : 1;
        include(shown.across, (splat.right - right) / depth, splat.reach_right / depth);
        include(shown.upward, (splat.up - up) / depth, splat.reach_up / depth);
    }
    return shown;
}

/// The size of shown relative to its target size. half_height: half the picture's height, in the unit of shown
double excess(const Shown& shown, double half_height, const PictureArea& area) {
    const double wide = 2 * half_height * area.aspect * area.free_share * kFramedShare;
    return std::max(shown.across.size() / wide, shown.upward.size() / (2 * half_height * kFramedShare));
}

Vec3 middleOf(const SceneSample& sample) {
    const SampleBox box = boundsOf(sample);
    return 0.5 * (box.low + box.high);
}

/// length, or 1 if it is 0 because splats coincide: any length shows them.
double orOne(double length) { return length > 0 && std::isfinite(length) ? length : 1; }

} // namespace

ViewBasis basisOf(Vec3 forward, Vec3 up) {
    const Vec3 right = normalize(cross(forward, up));
    return {right, cross(right, forward), forward};
}

Fit fitPinhole(const SceneSample& sample, const ViewBasis& basis, double fov_deg, const PictureArea& area) {
    const Vec3 middle = middleOf(sample);
    const std::vector<InView> splats = viewed(sample, basis, middle);
    const double tangent = std::tan(fov_deg * std::numbers::pi / 360);
    // the centre of the free part, relative to the centre of the picture
    const double aim = -tangent * area.aspect * (1 - area.free_share);
    const SampleBox box = boundsOf(sample);
    double distance = orOne(length(box.high - box.low)) / std::min(tangent, 1.0), right = 0, up = 0;
    for (int round = 0; round < kRounds; ++round) {
        const Shown shown = shownOf(splats, right, up, distance);
        const double factor = orOne(excess(shown, tangent, area));
        const double sideways = shown.across.middle() - aim, upwards = shown.upward.middle();
        right += sideways * distance;
        up += upwards * distance;
        distance *= std::clamp(factor, 0.5, 2.0);
        if (std::max({std::abs(factor - 1), std::abs(sideways) / tangent, std::abs(upwards) / tangent}) < kDone) break;
    }
    Fit fit;
    fit.eye = middle + right * basis.right + up * basis.up - distance * basis.forward;
    fit.pivot = fit.eye + distance * basis.forward + aim * distance * basis.right;
    fit.aside = -aim / (2 * tangent);
    return fit;
}

Fit fitParallel(const SceneSample& sample, const ViewBasis& basis, const PictureArea& area) {
    const Vec3 middle = middleOf(sample);
    const Shown shown = shownOf(viewed(sample, basis, middle), 0, 0, 0);
    Fit fit;
    fit.height = 2 * orOne(excess(shown, 1, area));
    fit.aside = area.aspect * (1 - area.free_share) / 2;
    fit.pivot = middle + shown.across.middle() * basis.right + shown.upward.middle() * basis.up;
    fit.eye = fit.pivot + fit.aside * fit.height * basis.right;
    return fit;
}

FixedEyeFit fitFromEye(const SceneSample& sample, Vec3 eye, Vec3 forward, Vec3 up, const PictureArea& area) {
    FixedEyeFit fit{forward, 0};
    for (int round = 0; round < kRounds; ++round) {
        const ViewBasis basis = basisOf(fit.forward, up);
        std::vector<InView> splats = viewed(sample, basis, eye);
        double size = 0;
        for (const InView& splat : splats) size = std::max(size, splat.ahead);
        for (InView& splat : splats) splat.ahead = std::max(splat.ahead, kNearShare * size) - 1;
        const Shown shown = shownOf(splats, 0, 0, 1);
        const double tangent = excess(shown, 1, area);
        fit.fov_deg = 2 * std::atan(tangent) * 180 / std::numbers::pi;
        const double sideways = shown.across.middle() + tangent * area.aspect * (1 - area.free_share);
        const double upwards = shown.upward.middle();
        if (std::max(std::abs(sideways), std::abs(upwards)) < kDone * tangent) break;
        fit.forward = normalize(basis.forward + sideways * basis.right + upwards * basis.up);
    }
    return fit;
}

} // namespace pointrt
