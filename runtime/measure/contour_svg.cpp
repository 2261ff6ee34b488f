// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "runtime/measure/contour_files.h"
#include "runtime/measure/decimal_text.h"
#include "runtime/measure/svg.h"

namespace pointrt {
namespace {

// Sizes in SVG pixels, 96 per inch.
constexpr double kPlanSide = 1000, kPlanMargin = 40, kBarHeight = 50;
/// Only lines longer than this are labelled.
constexpr double kLabelled = 60;
constexpr const char* kLineColor = "#8a5a2b"; // brown, as on topographic maps

double dotOf(const Position& a, const Position& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The transform from the plan to pixels.
struct PlanScale {
    double west = HUGE_VAL, east = -HUGE_VAL, south = HUGE_VAL, north = -HUGE_VAL;
    double pixels_per_unit = 1;

    double x(double eastwards) const { return kPlanMargin + (eastwards - west) * pixels_per_unit; }
    double y(double northwards) const { return kPlanMargin + (north - northwards) * pixels_per_unit; }
    double width() const { return 2 * kPlanMargin + (east - west) * pixels_per_unit; }
    double height() const { return 2 * kPlanMargin + (north - south) * pixels_per_unit + kBarHeight; }
};

PlanScale planScale(const ContourDrawing& drawing) {
    PlanScale scale;
    for (const Contour& contour : drawing.contours)
        for (const Position& point : contour.points) {
            const double east = dotOf(point, drawing.east), north = dotOf(point, drawing.north);
            scale.west = std::min(scale.west, east);
            scale.east = std::max(scale.east, east);
            scale.south = std::min(scale.south, north);
            scale.north = std::max(scale.north, north);
        }
    if (!(scale.west <= scale.east)) scale.west = scale.east = scale.south = scale.north = 0; // there are no lines
    const double side = std::max(scale.east - scale.west, scale.north - scale.south);
    scale.pixels_per_unit = side > 0 ? kPlanSide / side : 1;
    return scale;
}

std::string lineText(const Contour& contour, const ContourDrawing& drawing, const PlanScale& scale) {
    std::string points;
    for (const Position& point : contour.points)
        points += (points.empty() ? "" : " ") + svgPixels(scale.x(dotOf(point, drawing.east))) + "," +
                  svgPixels(scale.y(dotOf(point, drawing.north)));
    return std::string(contour.closed ? "<polygon" : "<polyline") + " points=\"" + points +
           "\" fill=\"none\" stroke=\"" + kLineColor + "\" stroke-width=\"" + (contour.is_index ? "1.4" : "0.6") +
           "\"/>\n";
}

/// A label with the height, in the middle of a line.
std::string labelText(const Contour& contour, const ContourDrawing& drawing, const PlanScale& scale, int decimals) {
    const Position& at = contour.points[contour.points.size() / 2];
    return svgText(scale.x(dotOf(at, drawing.east)), scale.y(dotOf(at, drawing.north)), "middle",
                   decimalText(contour.height, decimals));
}

/// The largest extent along an axis in pixels: at most the length, and enough to know whether a label fits.
double extentOf(const Contour& contour, const PlanScale& scale) {
    double most = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto [low, high] =
            std::minmax_element(contour.points.begin(), contour.points.end(),
                                [&](const Position& a, const Position& b) { return a[axis] < b[axis]; });
        most = std::max(most, (*high)[axis] - (*low)[axis]);
    }
    return most * scale.pixels_per_unit;
}

/// A scale bar of a round length, about a fifth of the plan.
std::string scaleBar(const PlanScale& scale, const std::string& unit) {
    const double length = roundBelow(kPlanSide / 5 / scale.pixels_per_unit), y = scale.height() - kPlanMargin;
    return svgScaleBar(kPlanMargin, y, length, scale.pixels_per_unit, unit) +
           svgText(scale.width() - kPlanMargin, y, "end", "north is up");
}

/// Decimals to print heights with: those that resolve the smallest difference.
int heightDecimals(const std::vector<Contour>& contours) {
    double interval = 0;
    for (std::size_t i = 1; i < contours.size(); ++i) {
        const double step = contours[i].height - contours[i - 1].height;
        if (step > 0 && (interval == 0 || step < interval)) interval = step;
    }
    return decimalsOf(interval > 0 ? interval : 1);
}

} // namespace

std::string contourSvg(const ContourDrawing& drawing) {
    const PlanScale scale = planScale(drawing);
    const int decimals = heightDecimals(drawing.contours);
    std::string text = svgHeader(scale.width(), scale.height());
    for (const Contour& each : drawing.contours) text += lineText(each, drawing, scale);
    std::string labels;
    for (const Contour& each : drawing.contours)
        if (each.is_index && extentOf(each, scale) > kLabelled) labels += labelText(each, drawing, scale, decimals);
    // outlines first, since few programs support paint-order
    text += "<g stroke=\"white\" stroke-width=\"4\">\n" + labels + "</g>\n<g fill=\"" + kLineColor + "\">\n" + labels;
    return text + "</g>\n" + scaleBar(scale, drawing.unit) + "</svg>\n";
}

} // namespace pointrt
