// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/measure_picture.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "runtime/scene/box_pen.h"
#include "runtime/scene/camera.h"
#include "runtime/scene/small_font_glyphs.h"

namespace pointrt {
namespace {

// As in the window: light lines on dark ones are visible on any picture.
constexpr Srgb8 kOutline{0, 0, 0}, kPathColor{125, 190, 235}, kDotColor{255, 255, 255};
constexpr double kOutlineOpacity = 0.6, kOutlineHalfWidth = 1.75, kPathHalfWidth = 0.75; // units of a layout
constexpr double kOutlineDot = 3.5, kDot = 2.25;
constexpr std::size_t kLabelPadding = 3;

/// A place in the coordinates of the camera's axes.
struct CameraPlace {
    double right = 0, up = 0, forward = 0;
};

/// The axes of calibrated cameras are not orthonormal, as they include the lens.
CameraPlace alongAxes(const Camera& camera, Vec3 point) {
    const Vec3 to = point - camera.eye, across = cross(camera.up, camera.forward);
    const double volume = dot(camera.right, across);
    return {dot(to, across) / volume, dot(to, cross(camera.forward, camera.right)) / volume,
            dot(to, cross(camera.right, camera.up)) / volume};
}

PixelPlace project(const Camera& camera, PixelSize size, CameraPlace place) {
    const bool is_ortho = camera.ortho_height > 0;
    const double half =
        is_ortho ? camera.ortho_height / 2 : place.forward * std::tan(verticalHalfAngle(camera.fov_deg));
    const double pixels = size.height / 2.0 / half;
    return {size.width / 2.0 + pixels * place.right, size.height / 2.0 - pixels * place.up};
}

class MeasurePen {
public:
    MeasurePen(const Camera& camera, PixelSize size, double nearest, PictureOverlay& overlay)
        : camera_(camera), size_(size), nearest_(nearest), scale_(overlayScale(size)), overlay_(overlay) {}

    /// The part of the leg that is in front of the eye.
    void leg(Vec3 from, Vec3 to) {
        CameraPlace a = alongAxes(camera_, from), b = alongAxes(camera_, to);
        if (a.forward > b.forward) std::swap(a, b);
        if (b.forward <= nearest_) return;
        if (a.forward < nearest_) {
            const double share = (nearest_ - a.forward) / (b.forward - a.forward);
            a = {std::lerp(a.right, b.right, share), std::lerp(a.up, b.up, share), nearest_};
        }
        twice(project(camera_, size_, a), project(camera_, size_, b), {kOutlineHalfWidth, kPathHalfWidth}, kPathColor);
    }

    void corner(Vec3 at) {
        if (const auto place = placeInPicture(camera_, size_, at))
            twice(*place, *place, {kOutlineDot, kDot}, kDotColor);
    }

    /// Adds a label centred on a place, moved into the picture. Omitted if the place is outside.
    void label(Vec3 at, const std::string& text) {
        const auto place = placeInPicture(camera_, size_, at);
        if (!place || place->x < 0 || place->y < 0 || place->x > size_.width || place->y > size_.height) return;
        OverlayBox box = darkBox(widthOf(text) + 2 * kLabelPadding, kGlyphHeight + 2 * kLabelPadding, scale_);
        BoxPen{box, scale_}.write(kLabelPadding, kLabelPadding, writable(text));
        box.left = firstOf(place->x, box.size.width, size_.width);
        box.top = firstOf(place->y, box.size.height, size_.height);
        overlay_.boxes.push_back(std::move(box));
    }

private:
    struct HalfWidths {
        double dark, light;
    };

    void twice(PixelPlace from, PixelPlace to, HalfWidths half, Srgb8 color) {
        const auto scale = static_cast<double>(scale_);
        overlay_.lines.push_back({from, to, scale * half.dark, kOutline, kOutlineOpacity});
        overlay_.lines.push_back({from, to, scale * half.light, color, 1});
    }

    static std::size_t firstOf(double middle, std::uint32_t extent, std::uint32_t most) {
        const double last = most > extent ? most - extent : 0;
        return static_cast<std::size_t>(std::clamp(std::round(middle - extent / 2.0), 0.0, last));
    }

    const Camera& camera_;
    PixelSize size_;
    double nearest_; ///< smallest distance along forward at which lines are drawn
    std::size_t scale_;
    PictureOverlay& overlay_;
};

} // namespace

std::optional<PixelPlace> placeInPicture(const Camera& camera, PixelSize size, Vec3 point) {
    const CameraPlace place = alongAxes(camera, point);
    if (!(place.forward > 0)) return std::nullopt;
    return project(camera, size, place);
}

void addMeasures(std::span<const MeasureDescription> measures, const MeasureUnits& units, const Camera& camera,
                 PixelSize size, PictureOverlay& overlay) {
    if (camera.panorama) return;
    constexpr double kNearest = 1e-6; // share of the scene's size: in front of the eye, and large enough to divide by
    MeasurePen pen(camera, size, kNearest * units.scene_size, overlay);
    for (const MeasureDescription& each : measures) {
        if (!each.visible) continue;
        for (std::size_t i = 1; i < each.points.size(); ++i) pen.leg(each.points[i - 1], each.points[i]);
        if (each.closed) pen.leg(each.points.back(), each.points.front());
        for (const Vec3 point : each.points) pen.corner(point);
        pen.label(labelPlace(each), labelOf(each, units));
    }
}

} // namespace pointrt
