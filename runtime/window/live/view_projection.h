// SPDX-License-Identifier: Apache-2.0
// World to pixel and pixel to ray, for one camera and frame size.
#pragma once

#include <cstdint>

#include "runtime/util/pixel_size.h"
#include "shaders/shared/params.h"

namespace pointrt {

struct PlaneVector {
    float x = 0, y = 0;
};

/// Implements both directions of shaders/lib/camera_ray.glsl on the host, in render space.
class ViewProjection {
public:
    /// frame: parameters of the full frame.
    explicit ViewProjection(const gpu::FrameParams& frame);

    /// A projected point.
    struct Projected {
        float x = 0, y = 0; ///< pixels from the upper left corner; finite
        float depth = 0;    ///< along the view direction, from the eye; 0 or less: not visible
    };
    /// weight: 1 for a position, 0 for a direction (a point at infinity).
    Projected project(gpu::vec3 position, float weight) const {
        const float depth = dotOf(position, forward_, weight);
        const float half_height = weight * half_window_ + depth * tan_half_fov_;
        const float scale = half_height > 0 ? 1 / half_height : 0;
        return {dotOf(position, across_, weight) * scale + middle_.x,
                dotOf(position, down_, weight) * scale + middle_.y, half_height > 0 ? depth : 0};
    }

    /// The ray through a pixel's centre. Each length of its direction advances the depth by 1.
    gpu::vec3 origin(std::uint32_t x, std::uint32_t y) const { return pointOnPlane(eye_, half_window_, x, y); }
    gpu::vec3 direction(std::uint32_t x, std::uint32_t y) const {
        return pointOnPlane({forward_.x, forward_.y, forward_.z}, tan_half_fov_, x, y);
    }
    PixelSize size() const { return size_; }

private:
    static float dotOf(gpu::vec3 v, gpu::vec4 row, float weight) {
        return v.x * row.x + v.y * row.y + v.z * row.z + weight * row.w;
    }
    gpu::vec3 pointOnPlane(gpu::vec3 from, float half_height, std::uint32_t x, std::uint32_t y) const;

    PixelSize size_;
    gpu::vec3 eye_, right_, up_;
    gpu::vec4 forward_, across_, down_; ///< w: offset at the world's origin
    PlaneVector middle_;
    float tan_half_fov_, half_window_, aspect_;
};

} // namespace pointrt
