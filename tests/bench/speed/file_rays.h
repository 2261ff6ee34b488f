// SPDX-License-Identifier: Apache-2.0
// Rays of a file through the walk alone, so that its hits and its rate can be held against those of all that is built
// on it.
#pragma once

#include <string>

#include "tests/support/ray_caster.h"

namespace pointrt::test {

/// Of all batches of a file, each traced several times.
struct FileWalk {
    std::size_t rays = 0, hits = 0;
    double seconds = 0; ///< the sum of the batches' medians
};

/// Traces the rays at path, as pointrt-rays cast takes them, in batches of as many as caster holds, first hits, each
/// batch runs times after one that is not counted. Hits are put into the array at hits_path unless that is empty: a
/// record for each, t_hit (lengths of its direction, infinity for a miss) and splat_ids (kNoSplat). Throws Error.
FileWalk walkFile(RayCaster& caster, const std::string& scene, const std::string& path, const std::string& hits_path,
                  std::size_t batch_rays, int runs);

} // namespace pointrt::test
