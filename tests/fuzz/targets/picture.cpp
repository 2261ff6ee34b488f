// SPDX-License-Identifier: Apache-2.0
// HDR pictures: Radiance and OpenEXR.
#include "runtime/image/image_read.h"
#include "tests/fuzz/fuzz_target.h"

using namespace pointrt;

POINTRT_FUZZ_TARGET(picture) {
    const fuzz::MemoryFile file(input);
    fuzz::expectReadOrRefused(file.path(), [&] { readFloatImage(file.path()); });
}
