// SPDX-License-Identifier: Apache-2.0
// The UI's graphics pipeline: alpha-blended triangles with a font texture.
#pragma once

namespace pointrt {

/// Push constants of ui.vert.glsl: clip position = position * scale + offset.
struct UiPush {
    float scale[2], offset[2];
};

} // namespace pointrt
