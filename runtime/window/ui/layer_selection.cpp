// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/ui/layer_selection.h"

#include <imgui.h>

#include "runtime/window/ui/panel_edit.h"

namespace pointrt {
namespace {

/// Names of stored numbers.
constexpr const char* kKind = "selected layer kind";
constexpr const char* kNumber = "selected layer";
constexpr const char* kOfferedFrame = "handles offered"; ///< the last frame in which the selected layer was shown

} // namespace

LayerId selectedLayer() {
    const auto kind = static_cast<LayerKind>(storedInt(kKind, 0));
    return {kind, static_cast<std::size_t>(storedInt(kNumber, 0))};
}

void selectLayer(LayerId id) {
    storedInt(kKind, 0) = static_cast<int>(id.kind);
    storedInt(kNumber, 0) = static_cast<int>(id.number);
    // the sections of lights and clips have their own selections, which follow
    if (id.kind == LayerKind::kLight) storedInt("selected light", 0) = static_cast<int>(id.number);
    if (id.kind == LayerKind::kClip) storedInt("selected clip", 0) = static_cast<int>(id.number);
}

void offerHandles(LayerId id) {
    if (id == selectedLayer()) storedInt(kOfferedFrame, 0) = ImGui::GetFrameCount();
}

std::optional<LayerId> layerWithHandles() {
    if (storedInt(kOfferedFrame, -1) != ImGui::GetFrameCount()) return std::nullopt;
    return selectedLayer();
}

} // namespace pointrt
