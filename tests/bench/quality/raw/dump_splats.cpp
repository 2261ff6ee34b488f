// SPDX-License-Identifier: Apache-2.0
// dump_splats SCENE.pro OUT.ply: writes the splats' centres and normals as points, in input coordinates.
#include <cstdio>

#include "format/base/run_tool.h"
#include "tests/bench/quality/scenes.h"
#include "tests/bench/quality/shapes.h"

int main(int argc, char** argv) {
    using namespace pointrt;
    return runTool("dump_splats", [&] {
        if (argc != 3) throw Error(ExitCode::kBadUsage, "dump_splats SCENE.pro OUT.ply");
        quality::Discs discs = quality::loadDiscs(argv[1], {});
        Cloud cloud;
        cloud.positions = std::move(discs.centers);
        cloud.normals = std::move(discs.normals);
        quality::writeMesh(argv[2], cloud);
        return 0;
    });
}
