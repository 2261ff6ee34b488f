// SPDX-License-Identifier: Apache-2.0
#include "tests/support/gaussian_set.h"

#include <filesystem>

#include "preprocess/tiles/bake_block.h"
#include "preprocess/tiles/make_plan.h"
#include "preprocess/tiles/make_tiles.h"
#include "preprocess/tiles/split.h"
#include "tests/gaussians/gaussian_ply.h"

namespace pointrt::test {

TileSet bakeGaussianSet(const std::string& folder, const std::vector<OracleGaussian>& gaussians,
                        std::uint64_t per_tile) {
    SetRequest request;
    request.inputs = {folder + "/capture.ply"};
    request.output = folder + "/capture.proset";
    request.points_per_tile = per_tile;
    request.settings = "{}";
    writeGaussianPly(request.inputs[0], gaussians);
    SetPlan plan = makePlan(request);
    std::filesystem::create_directories(plan.work);
    writePlan(plan);
    splitPoints(plan, request);
    bakeBlocks(plan, {0, plan.blocks()}, 2);
    mergeLevels(plan, per_tile, 2);
    return makeSet(plan, R"({"writer":"test"})", 2);
}

} // namespace pointrt::test
