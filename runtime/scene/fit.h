// SPDX-License-Identifier: Apache-2.0
// How near a camera comes to what it shows.
#pragma once

#include "runtime/scene/scene_sample.h"

namespace pointrt {

/// The part of a picture that nothing covers: all of its height, and from the left a share of its width.
struct PictureArea {
    double aspect = 1; ///< of the whole picture, width over height
    double free_share = 1;
};

/// Of the free part, in the direction in which it is more: the middle of 75% and 85%.
constexpr double kFramedShare = 0.8;

/// Orthonormal; right x up = -forward.
struct ViewBasis {
    Vec3 right, up, forward;
};

/// up: not along forward
ViewBasis basisOf(Vec3 forward, Vec3 up);

struct Fit {
    Vec3 eye;
    Vec3 pivot;        ///< the middle of what is shown, at its depth; right of the line of sight or on it
    double aside = 0;  ///< how far to the left of the picture's middle it is, in heights of the picture
    double height = 0; ///< of a parallel picture, world units
};

/// Where an eye that looks along basis sees all of sample, to the rims of its discs, fill kFramedShare of the free
/// part, in its middle. fov_deg: vertical. sample: not empty
Fit fitPinhole(const SceneSample& sample, const ViewBasis& basis, double fov_deg, const PictureArea& area);
Fit fitParallel(const SceneSample& sample, const ViewBasis& basis, const PictureArea& area);

/// The field of view in degrees with which an eye that stands sees all of sample do so, and the direction
/// that it looks in then. forward: a first guess, all of sample ahead of the eye.
struct FixedEyeFit {
    Vec3 forward;
    double fov_deg = 0; ///< vertical, below 180
};
FixedEyeFit fitFromEye(const SceneSample& sample, Vec3 eye, Vec3 forward, Vec3 up, const PictureArea& area);

} // namespace pointrt
