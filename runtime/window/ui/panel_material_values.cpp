// SPDX-License-Identifier: Apache-2.0
// Properties of a material.
#include <algorithm>
#include <cmath>

#include "runtime/scene/material_fields.h"
#include "runtime/window/ui/panel_edit.h"
#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/ui/panel_widgets.h"

namespace pointrt {
namespace {

/// Edits absorption as the colour of white light after a tenth of the scene's size, which is easier to judge than an
/// absorption coefficient.
void tintRow(Workspace& w, const MaterialField& field, Color& absorption) {
    const double depth = 0.1 * sceneSize(w);
    constexpr double darkest = 1e-3;
    Color tint;
    for (std::size_t c = 0; c < tint.size(); ++c)
        tint[c] = static_cast<float>(std::exp(-depth * static_cast<double>(absorption[c])));
    if (!reportSceneEdit(w, colorRow(field.label, tint, field.tip))) return;
    for (std::size_t c = 0; c < tint.size(); ++c)
        absorption[c] = static_cast<float>(-std::log(std::clamp(static_cast<double>(tint[c]), darkest, 1.0)) / depth);
}

void fieldRow(Workspace& w, const MaterialField& field, MaterialDescription& material) {
    if (field.unless && material.*field.unless) return;
    if (field.shown_with && !(material.*field.shown_with > 0)) return;
    if (const auto* number = std::get_if<float MaterialDescription::*>(&field.member))
        reportSceneEdit(w, sliderRow(field.label, material.**number, {field.low, field.high, field.logarithmic},
                                     field.format, field.tip));
    if (const auto* flag = std::get_if<bool MaterialDescription::*>(&field.member))
        reportSceneEdit(w, checkboxRow(field.label, material.**flag, field.tip));
    if (const auto* color = std::get_if<Color MaterialDescription::*>(&field.member))
        tintRow(w, field, material.**color);
}

} // namespace

void drawMaterialValues(Workspace& w, MaterialDescription& material) {
    reportSceneEdit(w, colorRow("Colour", material.color, "reflected colour; for glass, transmitted colour"));
    reportSceneEdit(w, checkboxRow("Scan colours", material.splat_color, "multiply by the colours of the scan"));
    for (const MaterialField* field : fieldsOf(material.kind)) fieldRow(w, *field, material);
}

} // namespace pointrt
