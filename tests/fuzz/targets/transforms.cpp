// SPDX-License-Identifier: Apache-2.0
// Cameras of transforms.json.
#include "runtime/scene_io/list_readers.h"
#include "tests/fuzz/fuzz_target.h"

using namespace pointrt;

POINTRT_FUZZ_TARGET(transforms) {
    const fuzz::MemoryFile file(input);
    fuzz::expectReadOrRefused(file.path(), [&] { readTransforms(file.path(), "", {PixelSize{64, 48}, true}); });
}
