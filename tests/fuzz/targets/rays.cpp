// SPDX-License-Identifier: Apache-2.0
// Rays, and points with or without normals, in NumPy arrays and text.
#include "runtime/rays/ray_source.h"
#include "tests/fuzz/fuzz_target.h"

using namespace pointrt;

namespace {

void readRows(const std::string& path, const RowKind& kind) {
    const std::unique_ptr<RaySource> rows = openRays(path, kind);
    for (RayBlock block; rows->next(block);) rows->placeOf(block, 0);
}

} // namespace

POINTRT_FUZZ_TARGET(rays) {
    static const RowKind points{"point", "points", {3, 6}, "3 or 6", "(N, 3)", {"x", "y", "z", "nx", "ny", "nz"}};
    const fuzz::MemoryFile file(input);
    fuzz::expectReadOrRefused(file.path(), [&] { readRows(file.path(), kRayRows); });
    fuzz::expectReadOrRefused(file.path(), [&] { readRows(file.path(), points); });
}
