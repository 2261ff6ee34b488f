// SPDX-License-Identifier: Apache-2.0
// Equirectangular panoramas: columns are longitudes around the camera's up, rows are latitudes.
#pragma once

#include "runtime/scene/render_settings.h"

namespace pointrt {

/// A ray of a panorama, input coordinates. direction is of unit length.
struct PanoramaRay {
    Vec3 origin, direction;
};

/// The ray through a place in the picture: across from 0 at its left edge to 1 at its right one, down from 0 at its top
/// to 1 at its bottom. The picture's middle looks along camera.forward, its left and right edges backwards, its top
/// along camera.up. In stereo (camera.eyes_apart > 0) the upper half is the left eye's picture: the eyes are where they
/// would be if the head turned to the ray's longitude, and approach each other towards the poles.
PanoramaRay panoramaRay(const Camera& camera, double across, double down);

/// camera turned to a level view: its up becomes the given one (not zero), and forward the horizontal part of
/// camera.forward, or any horizontal direction if that part is zero.
Camera levelCamera(const Camera& camera, Vec3 up);

/// The size of a panorama of this width: twice as wide as high for each eye.
PixelSize panoramaSize(std::uint32_t width, bool in_stereo);

} // namespace pointrt
