// SPDX-License-Identifier: Apache-2.0
// The part of a disc that lies in a cube, by duality: what is left out of it is proven to be outside. Cubes are around
// the origin; rounding is up to the caller, who takes the cube larger.
#pragma once

#include "format/index/cell_codec.h"

namespace pointrt {

/// A disc, its centre as seen from the cube's middle; normal is of unit length.
struct PlacedDisc {
    Vector center{}, normal{};
    float radius = 0;
};

/// As seen from the cell's middle.
PlacedDisc placedIn(const CellDisc& disc, const CellBox& box);

/// Whether the disc and the cube [-half, half]^3 have a point in common; sometimes true without. The cube must meet the
/// disc's plane.
bool meetsCube(const PlacedDisc& disc, float half);

/// How far the disc's part in the cube reaches from its centre along a unit vector in its plane, at most: as far as
/// both the disc and the plane's section of the cube do.
float reachInCube(const PlacedDisc& disc, const Vector& along, float half);

} // namespace pointrt
