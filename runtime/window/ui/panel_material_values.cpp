// SPDX-License-Identifier: Apache-2.0
// The values that a kind of material has.
#include <algorithm>
#include <cmath>

#include "runtime/window/ui/panel_parts.h"
#include "runtime/window/widgets/panel_edit.h"
#include "runtime/window/widgets/panel_widgets.h"

namespace pointrt {
namespace {

bool noteScene(Workspace& w, bool changed) { return noteEdit(w.requests, Edit::kScene, changed); }

void roughnessRow(Workspace& w, MaterialDescription& material) {
    noteScene(w, slideRow("Roughness", material.roughness, {0, 1}, "%.2f", "0: polished, 1: dull"));
}

void indexRow(Workspace& w, MaterialDescription& material) {
    noteScene(w, slideRow("Index", material.index, {1, 4}, "%.2f",
                          "refractive index: water 1.33, glass and varnish 1.5, diamond 2.42"));
}

void matteRows(Workspace& w, MaterialDescription& material) {
    noteScene(w, slideRow("Mirror", material.mirror_share, {0, 1}, "%.2f", "share of light reflected as by a mirror"));
    noteScene(w, slideRow("Highlight", material.specular, {0, 1}, "%.2f", "for direct light and mirrors"));
    if (material.specular > 0)
        noteScene(w, slideRow("Sharpness", material.shininess, {1, 1000, true}, "%.0f", "of the highlight"));
}

/// What is left of white light after a tenth of the scene, which says more than a number per length.
void tintRow(Workspace& w, MaterialDescription& material) {
    const double depth = 0.1 * sceneSize(w);
    constexpr double darkest = 1e-3;
    Color tint;
    for (std::size_t c = 0; c < tint.size(); ++c)
        tint[c] = static_cast<float>(std::exp(-depth * static_cast<double>(material.absorption[c])));
    if (!noteScene(w, colorRow("Tint", tint, "white light after it went through a tenth of the scene"))) return;
    for (std::size_t c = 0; c < tint.size(); ++c)
        material.absorption[c] =
            static_cast<float>(-std::log(std::clamp(static_cast<double>(tint[c]), darkest, 1.0)) / depth);
}

void glassRows(Workspace& w, MaterialDescription& material) {
    indexRow(w, material);
    noteScene(w, switchRow("Pane", material.thin, "a thin pane, not a solid: light goes straight through"));
    if (!material.thin) tintRow(w, material);
}

} // namespace

void drawMaterialValues(Workspace& w, MaterialDescription& material) {
    noteScene(w, colorRow("Colour", material.color, "what it reflects; of glass, what it lets through"));
    noteScene(w, switchRow("Own colours", material.splat_color, "multiplied by the colours of the scan"));
    switch (material.kind) {
    case MaterialKind::kMatte:
        return matteRows(w, material);
    case MaterialKind::kMetal:
        return roughnessRow(w, material);
    case MaterialKind::kPlastic:
        roughnessRow(w, material);
        return indexRow(w, material);
    case MaterialKind::kMirror:
        return;
    case MaterialKind::kGlass:
        return glassRows(w, material);
    }
}

} // namespace pointrt
