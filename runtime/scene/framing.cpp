// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/framing.h"

#include <algorithm>
#include <cmath>

#include "format/base/error.h"
#include "runtime/scene/default_view.h"
#include "runtime/scene/dense_part.h"

namespace pointrt {
namespace {

/// Scanners and rooms may need wider pictures than objects; beyond this angle, perspective distorts too much.
constexpr double kWidest_deg = 80;
/// If a scanner saw the scene at a smaller angle, it was so far away that its position is no better than any other.
constexpr double kNarrowest_deg = 20;
/// Distance of the pivot inside a room, relative to the mean distance of the surfaces.
constexpr double kPivotShare = 0.5;

Vec3 usable(Vec3 up, Vec3 side) {
    if (length(cross(up, side)) > 1e-3 * length(up)) return up;
    return std::abs(side.z) > 0.9 * length(side) ? Vec3{0, 1, 0} : Vec3{0, 0, -1};
}

double meanDistance(const SceneSample& sample, Vec3 eye) {
    double sum = 0;
    for (const SampledSplat& splat : sample.splats) sum += length(splat.position - eye);
    return sum / static_cast<double>(sample.splats.size());
}

/// The many candidate views are compared with a regular subset of the sample: between this many splats and twice as
/// many.
constexpr std::size_t kChoosing = 8192;

SceneSample thinned(const SceneSample& sample) {
    SceneSample some = sample;
    const std::size_t step = std::max<std::size_t>(1, sample.splats.size() / kChoosing);
    some.splats.clear();
    for (std::size_t i = 0; i < sample.splats.size(); i += step) some.splats.push_back(sample.splats[i]);
    return some;
}

ViewChoice chosen(const CameraRequest& request, const SceneSample& sample, Vec3 up) {
    if (!request.view) return chooseView(sample, up);
    if (*request.view != StandardView::kSensor) return {sideOf(*request.view, up), {}};
    if (const auto view = viewOfSensor(sample, up)) return *view;
    throw Error{ExitCode::kBadUsage, "--view sensor: no scan file states a scanner position"};
}

/// A view from a fixed eye; if the field of view is free, it becomes as wide as needed.
FramedRequest fromPlace(CameraRequest request, const SceneSample& sample, const ViewChoice& choice,
                        const FixedEyeFit& fit, Vec3 up, bool free_fov) {
    const Vec3 eye = *choice.eye;
    const bool sees_all = fit.fov_deg < kWidest_deg; // otherwise the eye is in the middle of the scene
    FramedRequest framed;
    framed.within = true;
    const Vec3 forward = sees_all ? fit.forward : -1.0 * choice.side;
    if (free_fov) request.fov_deg = std::min(fit.fov_deg, kWidest_deg);
    request.eye = eye;
    request.target = eye + (sees_all ? 1 : kPivotShare) * meanDistance(sample, eye) * forward;
    request.up = up;
    framed.camera = request;
    framed.pivot = *request.target;
    const Surrounding surrounding = surroundingOf(sample, eye, up);
    if (isEnclosed(surrounding)) framed.walls = surrounding;
    return framed;
}

FramedRequest fromOutside(CameraRequest request, const SceneSample& sample, Vec3 side, Vec3 up,
                          const PictureArea& area) {
    const ViewBasis basis = basisOf(-1.0 * side, up);
    FramedRequest framed;
    if (request.ortho || request.ortho_height) {
        const Fit fit = fitParallel(sample, basis, area);
        if (!request.ortho_height) request.ortho_height = fit.height;
        framed.pivot = fit.pivot;
        framed.aside = fit.aside;
        request.target = fit.pivot + fit.aside * *request.ortho_height * basis.right;
        request.side = side;
    } else {
        const Fit fit = fitPinhole(sample, basis, request.fov_deg, area);
        framed.pivot = fit.pivot;
        framed.aside = fit.aside;
        request.eye = fit.eye;
        request.target = fit.eye + dot(fit.pivot - fit.eye, basis.forward) * basis.forward;
    }
    request.up = up;
    framed.camera = request;
    return framed;
}

/// Where a panorama is seen from if no eye is given: a scanner's position, or the middle of a room.
FramedRequest fromWithin(const CameraRequest& request, const SceneSample& sample, Vec3 up) {
    const ViewChoice choice = chosen(request, thinned(sample), up);
    if (!choice.eye)
        throw Error{ExitCode::kBadUsage,
                    "--panorama: cannot choose a camera position inside this scan; give --eye X,Y,Z"};
    FramedRequest framed{request, {}};
    framed.camera.view.reset();
    framed.camera.eye = choice.eye;
    if (!request.target) framed.camera.target = *choice.eye - choice.side;
    if (!request.up) framed.camera.up = up;
    return framed;
}

/// Fills in the walls around the request's eye.
FramedRequest fromGivenEye(FramedRequest framed, const SceneSample& sample, Vec3 up) {
    const Surrounding surrounding = surroundingOf(sample, *framed.camera.eye, up);
    framed.within = isEnclosed(surrounding);
    if (framed.within) framed.walls = surrounding;
    return framed;
}

/// A given target, seen from the side of a view at frameCamera's distance, or from a scanner's position.
FramedRequest fromSideOf(CameraRequest request, const SceneSample& sample, Vec3 up) {
    const ViewChoice choice = chosen(request, sample, up);
    request.eye = choice.eye;
    request.side = choice.side;
    request.up = usable(upIn(*request.view, up), choice.side);
    request.view.reset();
    return {request, {}};
}

} // namespace

FramedRequest frameScene(const CameraRequest& request, const SceneSample& all, Vec3 up, const PictureArea& area,
                         bool free_fov) {
    FramedRequest framed{request, {}};
    framed.camera.view.reset();
    if (request.panorama && !request.eye && !all.splats.empty()) framed = fromWithin(request, withoutStrays(all), up);
    if (framed.camera.eye && !all.splats.empty() && !all.has_shapes) return fromGivenEye(framed, all, up);
    if (request.panorama) return framed;
    if (request.view && request.target && !request.eye && !all.splats.empty())
        return fromSideOf(request, thinned(withoutStrays(all)), up);
    if (request.eye || request.target || all.splats.empty() || (all.has_shapes && !request.view)) return framed;
    const SceneSample sample = withoutStrays(all);
    // an --up other than the scene's only rotates the picture: keep the side of the request
    const bool tilted = !request.view && request.up && length(cross(*request.up, up)) > 1e-6 * length(*request.up);
    const bool from_side = tilted || request.keeps_side;
    const ViewChoice choice = from_side ? ViewChoice{request.side, {}} : chosen(request, thinned(sample), up);
    const Vec3 picture_up = request.view ? upIn(*request.view, up) : tilted ? *request.up : up;
    const Vec3 level = usable(picture_up, choice.side);
    if (!choice.eye || request.ortho || request.ortho_height)
        return fromOutside(framed.camera, choice.is_site ? densePart(sample, up) : sample, choice.side, level, area);
    // if the scanner was far away, or a given field of view would crop the scene, frame it from outside instead
    const FixedEyeFit fit = fitFromEye(sample, *choice.eye, -1.0 * choice.side, level, area);
    const bool hardly_seen = fit.fov_deg < (free_fov ? kNarrowest_deg : kNarrowest_deg / 2);
    const bool cut = !free_fov && fit.fov_deg > request.fov_deg && fit.fov_deg < kWidest_deg;
    if (hardly_seen || cut) return fromOutside(framed.camera, sample, -1.0 * fit.forward, level, area);
    return fromPlace(framed.camera, sample, choice, fit, level, free_fov);
}

PlaceKind kindOfPlace(const SceneSample& sample, Vec3 up, bool is_surveyed) {
    return placeKind(thinned(withoutStrays(sample)), up, is_surveyed);
}

} // namespace pointrt
