// SPDX-License-Identifier: Apache-2.0
// make_shape sphere|torus|plate|cube OUT.ply: writes the mesh of an analytic surface and prints its facets' errors.
#include <cstdio>

#include "format/base/run_tool.h"
#include "tests/bench/quality/shapes.h"

int main(int argc, char** argv) {
    using namespace pointrt;
    return runTool("make_shape", [&] {
        if (argc != 3) throw Error(ExitCode::kBadUsage, "make_shape sphere|torus|plate|cube OUT.ply");
        const quality::Shape shape = quality::makeShape(argv[1]);
        quality::writeMesh(argv[2], shape.mesh);
        std::printf("%s: %zu facets at most %.2g off the surface; normals wrong by at most %.3f degrees, "
                    "interpolated by %.5f\n",
                    argv[2], shape.mesh.triangles.size(), shape.errors.distance, shape.errors.face_normal,
                    shape.errors.smooth_normal);
        return 0;
    });
}
