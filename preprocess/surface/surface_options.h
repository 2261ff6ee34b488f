// SPDX-License-Identifier: GPL-3.0-or-later
// Options of the conversion of clouds to splats.
#pragma once

namespace pointrt {

enum class NormalSource {
    kAuto,    ///< keeps given normals (finite and not zero), estimates the others
    kKeep,    ///< keeps given normals; every point must have one
    kEstimate ///< estimates all, ignoring given normals
};

enum class OrientMode {
    kAuto,   ///< given normals keep their side; others face a known sensor, or follow a spanning tree
    kSensor, ///< to the sensor; every point must have one
    kUp,     ///< up; normals of steep surfaces follow their neighbours
    kMst,    ///< by minimum spanning tree, ignoring given sides and sensors
    kNone    ///< leaves normals as given or fitted, on either side
};

enum class SplatShape {
    kAuto, ///< discs, and balls where points are on no surface (preprocess/surface/balls.h)
    kDisc, ///< all splats are discs
    kBall  ///< all splats are balls
};

struct SurfaceOptions {
    NormalSource normals = NormalSource::kAuto;
    OrientMode orient = OrientMode::kAuto;
    int neighbors = 16;        ///< size of the neighbourhoods, 3 to 255; smaller clouds use all other points
    double radius_scale = 1.0; ///< multiplies every radius, above 0
    bool remove_outliers = true;
    double clean = 1.0; ///< strength of cleaning; 0: none
    SplatShape splat = SplatShape::kDisc;
};

} // namespace pointrt
