// SPDX-License-Identifier: Apache-2.0
// Parts of SVG drawings. Lengths are in pixels, 96 per inch.
#pragma once

#include <string>

namespace pointrt {

/// A number with two decimals.
std::string svgPixels(double pixels);
/// The start of a drawing on a white page, with a font for labels. "</svg>" ends it.
std::string svgHeader(double width, double height);
std::string svgLine(double x0, double y0, double x1, double y1, const char* color);
/// anchor: start, middle or end of the text at x. text: without characters that XML reserves.
std::string svgText(double x, double y, const char* anchor, const std::string& text);
/// A bar of this length, in units of the drawing, with its label above. x, y: its left end.
std::string svgScaleBar(double x, double y, double length, double pixels_per_unit, const std::string& unit);

} // namespace pointrt
