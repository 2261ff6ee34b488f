// SPDX-License-Identifier: Apache-2.0
// Tables of simulated scanners' beams.
#include "runtime/studies/sensor_keys.h"
#include "tests/fuzz/fuzz_target.h"

using namespace pointrt;

POINTRT_FUZZ_TARGET(beams) {
    const fuzz::MemoryFile file(input);
    fuzz::expectReadOrRefused(file.path(), [&] { readBeams(file.path()); });
}
