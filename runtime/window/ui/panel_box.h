// SPDX-License-Identifier: Apache-2.0
// Boxes over the picture.
#pragma once

#include <imgui.h>

#include <functional>

namespace pointrt {

/// Position of a box: its pivot (0, 0: its upper left corner) is at `at`.
struct BoxPlace {
    ImVec2 at, pivot;
};

/// A box without a title, as high as its content. Returns its height in the last frame.
float boxOnPicture(const char* name, const BoxPlace& place, float width, ImGuiWindowFlags flags,
                   const std::function<void()>& content);

} // namespace pointrt
