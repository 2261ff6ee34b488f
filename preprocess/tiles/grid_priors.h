// SPDX-License-Identifier: GPL-3.0-or-later
// What the range grid of a scan reveals about its points. Tiles have no grids, so this is computed while the scan is
// complete.
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/ingest/batches.h"
#include "preprocess/surface/surface_options.h"

namespace pointrt {

/// Arrays of a batch's points, or empty.
struct GridPriors {
    std::vector<Vec3d> positions; ///< input coordinates, moved by dequantizeDepths; empty: none moved
    std::vector<float> noise;     ///< Cloud::noise
    std::vector<std::uint8_t> silhouettes;
};

/// kDepths leaves out silhouettes, which move no points.
enum class PriorKinds { kDepths, kAll };

/// The priors of a batch with a grid; all empty for other batches, and if the options use no grids.
GridPriors gridPriorsOf(const PointBatch& batch, const SurfaceOptions& options, PriorKinds kinds);

/// The batch with the priors' positions. Refers to both.
inline PointBatch movedBatch(const PointBatch& batch, const GridPriors& priors) {
    return {batch.cloud, priors.positions.empty() ? batch.positions : priors.positions, batch.scan, batch.untyped};
}

} // namespace pointrt
