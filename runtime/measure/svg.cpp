// SPDX-License-Identifier: Apache-2.0
#include "runtime/measure/svg.h"

#include "runtime/measure/decimal_text.h"

namespace pointrt {

std::string svgPixels(double pixels) { return decimalText(pixels, 2); }

std::string svgHeader(double width, double height) {
    const std::string size = "width=\"" + svgPixels(width) + "\" height=\"" + svgPixels(height) + "\"";
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" " + size +
           " font-family=\"sans-serif\" font-size=\"12\">\n<rect " + size + " fill=\"white\"/>\n";
}

std::string svgLine(double x0, double y0, double x1, double y1, const char* color) {
    return "<line x1=\"" + svgPixels(x0) + "\" y1=\"" + svgPixels(y0) + "\" x2=\"" + svgPixels(x1) + "\" y2=\"" +
           svgPixels(y1) + "\" stroke=\"" + color + "\"/>\n";
}

std::string svgText(double x, double y, const char* anchor, const std::string& text) {
    return "<text x=\"" + svgPixels(x) + "\" y=\"" + svgPixels(y) + "\" text-anchor=\"" + anchor + "\">" + text +
           "</text>\n";
}

std::string svgScaleBar(double x, double y, double length, double pixels_per_unit, const std::string& unit) {
    constexpr double kTick = 6;
    const double end = x + length * pixels_per_unit;
    const std::string label = decimalText(length, decimalsOf(length)) + (unit.empty() ? "" : " " + unit);
    return svgLine(x, y, end, y, "black") + svgLine(x, y - kTick, x, y, "black") +
           svgLine(end, y - kTick, end, y, "black") + svgText((x + end) / 2, y - kTick, "middle", label);
}

} // namespace pointrt
