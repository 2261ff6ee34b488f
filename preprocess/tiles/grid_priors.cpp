// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/grid_priors.h"

#include "preprocess/surface/dequantize.h"
#include "preprocess/surface/estimate.h"
#include "preprocess/surface/silhouettes.h"

namespace pointrt {
namespace {

/// The batch's scan as a cloud of its own.
Cloud scanOf(const PointBatch& batch) {
    Cloud cloud;
    cloud.origin = batch.cloud.origin;
    cloud.positions = batch.cloud.positions;
    cloud.scans = {batch.cloud.scans.back()};
    cloud.scans.front().first_point = 0;
    cloud.grids = batch.cloud.grids;
    for (RangeGrid& grid : cloud.grids) grid.scan = 0;
    return cloud;
}

/// Points that did not move keep their coordinates in double.
std::vector<Vec3d> movedPositions(const PointBatch& batch, const Cloud& cloud) {
    std::vector<Vec3d> positions = batch.positions;
    for (std::size_t i = 0; i < positions.size(); ++i)
        if (cloud.positions[i] != batch.cloud.positions[i])
            positions[i] = cloud.origin + cloud.positions[i].cast<double>();
    return positions;
}

} // namespace

GridPriors gridPriorsOf(const PointBatch& batch, const SurfaceOptions& options, PriorKinds kinds) {
    GridPriors priors;
    if (batch.cloud.grids.empty() || !usesGrids(options)) return priors;
    Cloud cloud = scanOf(batch);
    if (dequantizeDepths(cloud).moved > 0) priors.positions = movedPositions(batch, cloud);
    if (kinds == PriorKinds::kAll) priors.silhouettes = flagSilhouettes(cloud);
    priors.noise = std::move(cloud.noise);
    return priors;
}

} // namespace pointrt
