// SPDX-License-Identifier: Apache-2.0
// Camera positions and fields of view that fit a scene into the picture.
#pragma once

#include "runtime/scene/scene_sample.h"

namespace pointrt {

/// The part of a picture that no panel covers: its full height, and a share of its width from the left.
struct PictureArea {
    double aspect = 1; ///< of the whole picture, width over height
    double free_share = 1;
};

/// Share of the free part that the scene fills in its larger direction: between 75% and 85%.
constexpr double kFramedShare = 0.8;

/// Orthonormal; right x up = -forward.
struct ViewBasis {
    Vec3 right, up, forward;
};

/// up: not along forward
ViewBasis basisOf(Vec3 forward, Vec3 up);

struct Fit {
    Vec3 eye;
    Vec3 pivot;        ///< the centre of the scene as shown
    double aside = 0;  ///< distance of the pivot to the left of the picture's centre, in picture heights
    double height = 0; ///< of a parallel picture, world units
};

/// The eye that looks along basis.forward and sees all discs of sample, centred and filling kFramedShare of the free
/// part. fov_deg: vertical. sample: not empty
Fit fitPinhole(const SceneSample& sample, const ViewBasis& basis, double fov_deg, const PictureArea& area);
Fit fitParallel(const SceneSample& sample, const ViewBasis& basis, const PictureArea& area);

/// The same for a fixed eye: the direction and the field of view. forward: an initial direction with all of sample in
/// front of the eye.
struct FixedEyeFit {
    Vec3 forward;
    double fov_deg = 0; ///< vertical, below 180
};
FixedEyeFit fitFromEye(const SceneSample& sample, Vec3 eye, Vec3 forward, Vec3 up, const PictureArea& area);

} // namespace pointrt
