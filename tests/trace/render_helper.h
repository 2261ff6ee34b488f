// SPDX-License-Identifier: Apache-2.0
// Renders a .pro in this process, with the validation layer on where it is installed.
#pragma once

#include <string>

#include "runtime/frame_params.h"
#include "runtime/render.h"
#include "runtime/scene_description.h"
#include "runtime/tracer.h"

namespace pointrt::test {

struct Rendered {
    Film film;
    RayCounts rays;
    Camera camera;
    gpu::FrameParams params{}; ///< what the shaders saw
    pro_info info{};           ///< of the first instance
    double cell_edge = 0;      ///< of its bricks, cube units
    SceneDescription scene;    ///< with what was put around it
};

/// size x size pixels, one sample through each centre, three lights on the ring, no room.
RenderSettings square(std::uint32_t size);

/// first_hits is always on.
Rendered renderScene(SceneDescription scene, RenderSettings settings);
/// The same of a .pro alone.
Rendered renderFile(const std::string& path, RenderSettings settings);

/// Luminance-free access: channel c of pixel (x, y).
float pixel(const Film& film, std::uint32_t x, std::uint32_t y, int channel);

} // namespace pointrt::test
