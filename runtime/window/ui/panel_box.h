// SPDX-License-Identifier: Apache-2.0
// Boxes on the picture, beside the panel.
#pragma once

#include <imgui.h>

#include <functional>

namespace pointrt {

/// Where a box stands; the pivot's part of it (0, 0: its upper left corner) is at this place.
struct BoxPlace {
    ImVec2 at, pivot;
};

/// A box without a title, as high as its content. Returns its height, known from its last frame.
float boxOnPicture(const char* name, const BoxPlace& place, float width, ImGuiWindowFlags flags,
                   const std::function<void()>& content);

} // namespace pointrt
