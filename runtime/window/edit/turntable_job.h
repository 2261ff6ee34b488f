// SPDX-License-Identifier: Apache-2.0
// A turntable rendered behind the window, by a pointrt-view of its own: pictures are those of the command line.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/scene/scene_description.h"
#include "runtime/window/edit/job.h"

namespace pointrt {

class TurntableJob {
public:
    /// Renders so many pictures of scene to pattern (turntable.h), on the device with this selector. Creates pattern's
    /// folder where it is not there. Throws Error kBadUsage or kCannotWrite for a pattern that will not do.
    TurntableJob(const SceneDescription& scene, const std::string& pattern, std::uint32_t pictures,
                 const std::string& device);

    Job& job() { return job_; }
    const Job& job() const { return job_; }

private:
    Job job_;
};

} // namespace pointrt
