// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/point_classes.h"

#include <array>

namespace pointrt {
namespace {

struct PointClass {
    const char* name;
    Srgb8 color;
};

constexpr std::array kClasses = {
    PointClass{"never classified", {105, 105, 105}},
    PointClass{"unclassified", {170, 170, 170}},
    PointClass{"ground", {161, 82, 46}},
    PointClass{"low vegetation", {110, 220, 60}},
    PointClass{"medium vegetation", {0, 190, 0}},
    PointClass{"high vegetation", {0, 130, 0}},
    PointClass{"building", {255, 168, 0}},
    PointClass{"low noise", {255, 0, 255}},
    PointClass{"model key point", {255, 0, 0}}, // until LAS 1.3
    PointClass{"water", {0, 80, 255}},
    PointClass{"rail", {150, 60, 220}},
    PointClass{"road surface", {70, 75, 90}},
    PointClass{"overlap", {255, 240, 60}}, // until LAS 1.3
    PointClass{"wire, guard", {0, 220, 220}},
    PointClass{"wire, conductor", {0, 170, 200}},
    PointClass{"transmission tower", {220, 40, 90}},
    PointClass{"wire connector", {0, 120, 150}},
    PointClass{"bridge deck", {200, 130, 90}},
    PointClass{"high noise", {200, 0, 170}},
    PointClass{"overhead structure", {255, 110, 80}},
    PointClass{"ignored ground", {120, 90, 60}},
    PointClass{"snow", {235, 245, 255}},
    PointClass{"temporal exclusion", {90, 60, 110}},
};

} // namespace

std::string className(std::uint8_t number) {
    return number < kClasses.size() ? kClasses[number].name : "class " + std::to_string(number);
}

Srgb8 classColor(std::uint8_t number) {
    if (number < kClasses.size()) return kClasses[number].color;
    static const ColorScale others(ColorMap::kScans, {});
    return others(number);
}

} // namespace pointrt
