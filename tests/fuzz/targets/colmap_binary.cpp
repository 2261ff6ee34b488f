// SPDX-License-Identifier: Apache-2.0
// COLMAP's cameras.bin and images.bin.
#include "runtime/scene_io/list_readers.h"
#include "tests/fuzz/fuzz_target.h"

using namespace pointrt;

POINTRT_FUZZ_TARGET(colmap_binary) {
    const fuzz::TwoFiles files = fuzz::splitInTwo(input);
    const fuzz::MemoryFile cameras(files.first), images(files.second);
    fuzz::expectReadOrRefused("/proc/self/fd/", [&] { readColmapBinary(images.path(), cameras.path(), {}); });
}
