// SPDX-License-Identifier: Apache-2.0
// Rays of a file traced by the walk alone, so that its hits and rate can be compared with those of the library and
// tools.
#pragma once

#include <string>

#include "tests/support/ray_caster.h"

namespace pointrt::test {

/// Sums over the batches of a file, each of which is traced several times.
struct FileWalk {
    std::size_t rays = 0, hits = 0;
    double seconds = 0; ///< the sum of the batches' medians
};

/// Traces the rays at path, a file for pointrt-rays cast, for first hits. Each batch of batch_rays is traced once as a
/// warm-up and then runs times. Unless hits_path is empty, writes hits to an array of records there: t_hit (in lengths
/// of the direction, infinity for a miss) and splat_ids (kNoSplat). Throws Error.
FileWalk walkFile(RayCaster& caster, const std::string& scene, const std::string& path, const std::string& hits_path,
                  std::size_t batch_rays, int runs);

} // namespace pointrt::test
