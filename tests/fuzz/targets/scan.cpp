// SPDX-License-Identifier: GPL-3.0-or-later
// Scans of any format, as a bake reads them: unpacked, format detected, read, faces sampled.
#include <tbb/global_control.h>

#include "preprocess/input/read.h"
#include "tests/fuzz/fuzz_target.h"

using namespace pointrt;

POINTRT_FUZZ_TARGET(scan) {
    static const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const fuzz::MemoryFile file(input);
    ReadOptions options;
    options.scales_degrees = true;
    bool has_faces = false;
    fuzz::expectReadOrRefused(file.path(), [&] { has_faces = !readInputs({file.path()}, options).triangles.empty(); });
    options.sample_count = 100; // the default number takes a hundred times as long
    if (has_faces) fuzz::expectReadOrRefused(file.path(), [&] { readInputs({file.path()}, options); });
}
