// SPDX-License-Identifier: GPL-3.0-or-later
// Scans of any format, as a bake reads them: unpacked, told by their content, read, faces sampled.
#include <tbb/global_control.h>

#include "preprocess/input/read.h"
#include "tests/fuzz/fuzz_target.h"

using namespace pointrt;

POINTRT_FUZZ_TARGET(scan) {
    static const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const fuzz::MemoryFile file(input);
    ReadOptions options;
    options.sample_count = std::nullopt;
    options.scales_degrees = true;
    fuzz::expectReadOrRefused(file.path(), [&] { readInputs({file.path()}, options); });
}
