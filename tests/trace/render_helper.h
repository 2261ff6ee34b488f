// SPDX-License-Identifier: Apache-2.0
// Renders a .pro in this process, with the validation layer on where it is installed.
#pragma once

#include <string>

#include "runtime/frame_params.h"
#include "runtime/render.h"
#include "runtime/tracer.h"

namespace pointrt::test {

struct Rendered {
    Film film;
    RayCounts rays;
    Camera camera;
    gpu::FrameParams params{}; ///< what the shaders saw
    pro_info info{};
};

/// size x size pixels, one sample through each centre.
RenderSettings square(std::uint32_t size);

/// first_hits is always on.
Rendered renderFile(const std::string& path, RenderSettings settings);

/// Luminance-free access: channel c of pixel (x, y).
float pixel(const Film& film, std::uint32_t x, std::uint32_t y, int channel);

} // namespace pointrt::test
