// SPDX-License-Identifier: GPL-3.0-or-later
// plan.json of tile sets baked in steps.
#include "preprocess/tiles/plan.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/support/temporary_folder.h"

using namespace pointrt;

POINTRT_FUZZ_TARGET(plan) {
    static const test::TemporaryFolder work;
    static const std::string sides = work.write("sides.bin", "");
    work.write("plan.json", std::string(fuzz::textOf(input)));
    fuzz::expectReadOrRefused(work.path.string(), [&] {
        const SetPlan plan = readPlan(work.path.string());
        for (const PlanTile& tile : plan.tiles) coreOf(plan, tile);
        tilesOf(plan, {0, plan.blocks()});
    });
}
