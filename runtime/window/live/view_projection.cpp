// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/live/view_projection.h"

namespace pointrt {
namespace {

/// The row of an affine map: the distance along direction, measured from the point `from`, times scale.
gpu::vec4 affineRow(gpu::vec3 direction, float scale, gpu::vec3 from) {
    const gpu::vec3 d{direction.x * scale, direction.y * scale, direction.z * scale};
    return {d.x, d.y, d.z, -(d.x * from.x + d.y * from.y + d.z * from.z)};
}

} // namespace

ViewProjection::ViewProjection(const gpu::FrameParams& frame)
    : size_{frame.picture_width, frame.picture_height}, eye_(frame.eye), right_(frame.right), up_(frame.up),
      forward_(affineRow(frame.forward, 1, frame.eye)), middle_{0.5f * static_cast<float>(size_.width),
                                                                0.5f * static_cast<float>(size_.height)},
      tan_half_fov_(frame.tan_half_fov), half_window_(frame.half_window), aspect_(frame.aspect) {
    across_ = affineRow(frame.right, middle_.x / aspect_, frame.eye);
    down_ = affineRow(frame.up, -middle_.y, frame.eye);
}

gpu::vec3 ViewProjection::pointOnPlane(gpu::vec3 from, float half_height, std::uint32_t x, std::uint32_t y) const {
    const float across = (2 * (static_cast<float>(x) + 0.5f) / static_cast<float>(size_.width) - 1) * aspect_;
    const float upwards = 1 - 2 * (static_cast<float>(y) + 0.5f) / static_cast<float>(size_.height);
    const float r = across * half_height, u = upwards * half_height;
    return {from.x + r * right_.x + u * up_.x, from.y + r * right_.y + u * up_.y, from.z + r * right_.z + u * up_.z};
}

} // namespace pointrt
