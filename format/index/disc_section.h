// SPDX-License-Identifier: Apache-2.0
// Conservative tests of the part of a disc inside a cube, by duality: what they exclude is proven to be outside. Cubes
// are centred at the origin; the caller enlarges them for rounding.
#pragma once

#include "format/index/cell_codec.h"

namespace pointrt {

/// A disc relative to the middle of the cube; normal has unit length.
struct PlacedDisc {
    Vector center{}, normal{};
    float radius = 0;
};

/// The disc relative to the middle of the cell.
PlacedDisc placedIn(const CellDisc& disc, const CellBox& box);

/// Whether the disc and the cube [-half, half]^3 may have a common point; false is certain. The disc's plane must
/// intersect the cube.
bool overlapsCube(const PlacedDisc& disc, float half);

/// Upper bound of the extent of the disc's part in the cube from its centre along a unit vector in its plane: that of
/// the disc or of the plane's section of the cube, whichever is smaller.
float reachInCube(const PlacedDisc& disc, const Vector& along, float half);

} // namespace pointrt
