// SPDX-License-Identifier: Apache-2.0
// Trajectories of simulated scanners.
#include "pointrt/lidar.hpp"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/trace_refusal.h"

using namespace pointrt;

POINTRT_FUZZ_TARGET(trajectory) {
    const fuzz::MemoryFile file(input);
    fuzz::expectReadOrRefused(file.path(), [&] { fuzz::asError([&] { readLidarTrajectory(file.path()); }); });
}
