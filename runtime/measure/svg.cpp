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

} // namespace pointrt
