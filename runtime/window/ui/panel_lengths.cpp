// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/ui/panel_lengths.h"

#include "runtime/window/ui/panel_numbers.h"

namespace pointrt {
namespace {

std::string withUnit(const std::string& number, const std::string& unit) {
    return unit.empty() ? number : number + " " + unit;
}

} // namespace

std::string shownLength(const Workspace& w, double value, double size) {
    return withUnit(lengthText(value, size), w.measure_units.unit);
}

std::string shownArea(const Workspace& w, double value, double size) {
    const std::string& unit = w.measure_units.unit;
    return withUnit(lengthText(value, size * size), unit.empty() ? "" : unit + "2");
}

std::string shownPoint(const Workspace& w, Vec3 point, double size) {
    return withUnit(pointText(point, size), w.measure_units.unit);
}

std::string lengthFormat(const Workspace& w, const char* number) { return withUnit(number, w.measure_units.unit); }

} // namespace pointrt
