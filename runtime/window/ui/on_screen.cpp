// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/ui/on_screen.h"

#include <cmath>

namespace pointrt {

std::optional<ImVec2> onScreen(const Workspace& w, Vec3 point) {
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    const auto at = projected(w.camera, {static_cast<double>(window.x), static_cast<double>(window.y)}, point);
    constexpr double farthest = 1e5;
    if (!at || !(std::abs(at->x) < farthest) || !(std::abs(at->y) < farthest)) return std::nullopt;
    return ImVec2(static_cast<float>(at->x), static_cast<float>(at->y));
}

} // namespace pointrt
