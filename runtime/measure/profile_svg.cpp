// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "runtime/measure/decimal_text.h"
#include "runtime/measure/profile_files.h"
#include "runtime/measure/profile_runs.h"
#include "runtime/measure/svg.h"

namespace pointrt {
namespace {

// Sizes in SVG pixels, 96 per inch.
constexpr double kChartWidth = 1000, kChartLeft = 90, kChartTop = 30, kChartBottom = 60, kChartRight = 30;
constexpr double kLeastHeight = 200, kMostHeight = 600; ///< height of the chart's area
constexpr double kTickGap = 80;                         ///< distance between ticks: room for a label of ten digits

/// The transform from stations and heights to pixels.
struct ChartScale {
    double start = 0, end = 0, low = 0, high = 0; ///< limits of the axes
    double pixels_per_unit = 1;                   ///< along the stations
    double exaggeration = 1;                      ///< factor for heights
    double area = 0;                              ///< height of the chart's area

    double x(double station) const { return kChartLeft + (station - start) * pixels_per_unit; }
    double y(double height) const { return kChartTop + area - (height - low) * pixels_per_unit * exaggeration; }
};

ChartScale chartScale(const std::vector<ProfilePoint>& points) {
    ChartScale scale;
    scale.low = HUGE_VAL;
    scale.high = -HUGE_VAL;
    for (const ProfilePoint& point : points) {
        scale.end = std::max(scale.end, point.station);
        if (!point.hit) continue;
        scale.low = std::min(scale.low, point.low);
        scale.high = std::max(scale.high, point.high);
    }
    if (scale.low > scale.high) scale.low = scale.high = 0; // there are no hits
    const double length = scale.end > 0 ? scale.end : 1;
    scale.pixels_per_unit = (kChartWidth - kChartLeft - kChartRight) / length;
    const double pixels = (scale.high - scale.low) * scale.pixels_per_unit;
    if (pixels > kMostHeight) scale.exaggeration = kMostHeight / pixels;
    if (pixels > 0 && pixels < kLeastHeight) scale.exaggeration = roundBelow(2 * kLeastHeight / pixels);
    scale.area = std::max(kLeastHeight, pixels * scale.exaggeration);
    return scale;
}

/// Calls draw(value, label) for each round value from low to high.
template <typename Draw>
void forTicks(double low, double high, double pixels_per_unit, const Draw& draw) {
    const double step = 2 * roundBelow(kTickGap / pixels_per_unit);
    for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
        draw(k * step, decimalText(k * step, decimalsOf(step)));
}

std::string axes(const ChartScale& scale, const std::string& unit) {
    constexpr double kLabelGap = 8, kLineHeight = 18;
    const double bottom = kChartTop + scale.area, right = kChartWidth - kChartRight;
    std::string text;
    forTicks(scale.start, scale.end, scale.pixels_per_unit, [&](double station, const std::string& label) {
        text += svgLine(scale.x(station), kChartTop, scale.x(station), bottom, "#ddd");
        text += svgText(scale.x(station), bottom + kLineHeight, "middle", label);
    });
    forTicks(scale.low, scale.high, scale.pixels_per_unit * scale.exaggeration,
             [&](double height, const std::string& label) {
                 text += svgLine(kChartLeft, scale.y(height), right, scale.y(height), "#ddd");
                 text += svgText(kChartLeft - kLabelGap, scale.y(height) + kLabelGap / 2, "end", label);
             });
    const std::string of_unit = unit.empty() ? "" : " (" + unit + ")";
    text += svgText((kChartLeft + right) / 2, bottom + 2.5 * kLineHeight, "middle", "distance" + of_unit);
    text += svgText(kChartLeft - kLabelGap, kChartTop - kLabelGap, "end", "height" + of_unit);
    if (scale.exaggeration != 1)
        text += svgText(right, kChartTop - kLabelGap, "end",
                        "heights x " + decimalText(scale.exaggeration, scale.exaggeration < 1 ? 3 : 0));
    return text;
}

std::string pointsOf(const std::vector<ProfilePoint>& run, const ChartScale& scale, double ProfilePoint::*height,
                     bool reversed = false) {
    std::string text;
    for (std::size_t i = 0; i < run.size(); ++i) {
        const ProfilePoint& point = run[reversed ? run.size() - 1 - i : i];
        text += (text.empty() ? "" : " ") + svgPixels(scale.x(point.station)) + "," + svgPixels(scale.y(point.*height));
    }
    return text;
}

std::string curve(const std::vector<ProfilePoint>& run, const ChartScale& scale, bool has_band) {
    std::string text;
    if (has_band)
        text += "<polygon points=\"" + pointsOf(run, scale, &ProfilePoint::low) + " " +
                pointsOf(run, scale, &ProfilePoint::high, true) + "\" fill=\"#bbd0e6\"/>\n";
    return text + "<polyline points=\"" + pointsOf(run, scale, &ProfilePoint::height) +
           "\" fill=\"none\" stroke=\"#1f5a96\" stroke-width=\"1.5\"/>\n";
}

std::string dots(const std::vector<ProfilePoint>& run, const ChartScale& scale) {
    std::string text;
    for (const ProfilePoint& point : run)
        text += "<circle cx=\"" + svgPixels(scale.x(point.station)) + "\" cy=\"" + svgPixels(scale.y(point.height)) +
                "\" r=\"1\" fill=\"#1f5a96\"/>\n";
    return text;
}

} // namespace

std::string profileSvg(const ProfileDrawing& profile) {
    const ChartScale scale = chartScale(profile.points);
    std::string text = svgHeader(kChartWidth, kChartTop + scale.area + kChartBottom) + axes(scale, profile.unit);
    const bool has_layers = hasLayers(profile.points);
    for (const std::vector<ProfilePoint>& run : profileRuns(profile.points))
        text += has_layers || run.size() == 1 ? dots(run, scale) : curve(run, scale, profile.has_band);
    return text + "</svg>\n";
}

} // namespace pointrt
