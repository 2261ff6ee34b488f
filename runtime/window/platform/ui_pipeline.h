// SPDX-License-Identifier: Apache-2.0
// The graphics pipeline of the UI: alpha-blended triangles with a font texture.
#pragma once

namespace pointrt {

/// Push constants of ui.vert.glsl: clip space = position * scale + offset.
struct UiPush {
    float scale[2], offset[2];
};

} // namespace pointrt
