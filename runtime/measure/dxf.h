// SPDX-License-Identifier: Apache-2.0
// Drawings as DXF of AutoCAD R12, which every CAD program reads.
#pragma once

#include <string>
#include <vector>

#include "pointrt/measure.hpp"

namespace pointrt {

struct DxfEntity {
    enum class Kind { kPoints, kPolyline, kPolygon } kind = Kind::kPolyline; ///< kPoints: each position is a POINT
    std::string layer;                                                       ///< letters, digits, - and _
    std::vector<Position> positions;
};

/// POINTs and 3D POLYLINEs. Coordinates have this many decimals.
std::string dxfText(const std::vector<DxfEntity>& entities, int decimals);

} // namespace pointrt
