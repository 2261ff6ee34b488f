// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "runtime/measure/decimal_text.h"
#include "runtime/measure/section_files.h"
#include "runtime/measure/svg.h"

namespace pointrt {
namespace {

// Sizes in SVG pixels, 96 per inch.
constexpr double kSheetSide = 1000, kSheetMargin = 40, kNameHeight = 30, kSheetBar = 50;

/// A section's place on the sheet, in its own axes.
struct SheetPart {
    double left = HUGE_VAL, right = -HUGE_VAL, bottom = HUGE_VAL, top = -HUGE_VAL;
    double y = 0; ///< of its top, in pixels
};

SheetPart partOf(const DrawnSection& flat) {
    SheetPart part;
    for (const SectionLine& line : flat.lines)
        for (const Position& point : line.points) {
            part.left = std::min(part.left, point[0]);
            part.right = std::max(part.right, point[0]);
            part.bottom = std::min(part.bottom, point[1]);
            part.top = std::max(part.top, point[1]);
        }
    if (!(part.left <= part.right)) part.left = part.right = part.bottom = part.top = 0; // there are no lines
    return part;
}

/// The parts of the sheet, and its scale.
struct Sheet {
    std::vector<SheetPart> parts;
    double pixels_per_unit = 1, width = 0, height = 0;
};

Sheet sheetOf(const SectionDrawing& flat) {
    Sheet sheet;
    double widest = 0, tallest = 0;
    for (const DrawnSection& section : flat.sections) {
        sheet.parts.push_back(partOf(section));
        widest = std::max(widest, sheet.parts.back().right - sheet.parts.back().left);
        tallest = std::max(tallest, sheet.parts.back().top - sheet.parts.back().bottom);
    }
    const double side = std::max(widest, tallest);
    sheet.pixels_per_unit = side > 0 ? kSheetSide / side : 1;
    sheet.width = 2 * kSheetMargin + widest * sheet.pixels_per_unit;
    sheet.height = kSheetMargin;
    for (SheetPart& part : sheet.parts) {
        part.y = sheet.height + kNameHeight;
        sheet.height = part.y + (part.top - part.bottom) * sheet.pixels_per_unit + kSheetMargin;
    }
    sheet.height += kSheetBar;
    return sheet;
}

std::string sectionLineText(const SectionLine& line, const SheetPart& part, double pixels_per_unit) {
    std::string points;
    for (const Position& point : line.points)
        points += (points.empty() ? "" : " ") + svgPixels(kSheetMargin + (point[0] - part.left) * pixels_per_unit) +
                  "," + svgPixels(part.y + (part.top - point[1]) * pixels_per_unit);
    return std::string(line.closed ? "<polygon" : "<polyline") + " points=\"" + points + "\"/>\n";
}

} // namespace

std::string sectionSvg(const SectionDrawing& drawing) {
    const SectionDrawing flat = flattened(drawing);
    const Sheet sheet = sheetOf(flat);
    std::string text = svgHeader(sheet.width, sheet.height);
    for (std::size_t k = 0; k < sheet.parts.size(); ++k) {
        const SheetPart& part = sheet.parts[k];
        text += svgText(kSheetMargin, part.y - kNameHeight / 2, "start", flat.sections[k].name);
        text += "<g fill=\"none\" stroke=\"black\" stroke-linejoin=\"round\">\n";
        for (const SectionLine& line : flat.sections[k].lines)
            text += sectionLineText(line, part, sheet.pixels_per_unit);
        text += "</g>\n";
    }
    const double bar = roundBelow(kSheetSide / 5 / sheet.pixels_per_unit);
    return text + svgScaleBar(kSheetMargin, sheet.height - kSheetMargin, bar, sheet.pixels_per_unit, drawing.unit) +
           "</svg>\n";
}

} // namespace pointrt
