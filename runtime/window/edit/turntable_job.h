// SPDX-License-Identifier: Apache-2.0
// Renders a turntable, or a path through the views, in the background with a pointrt-view process, so that pictures
// equal those of the command line.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/scene/scene_description.h"
#include "runtime/window/edit/job.h"

namespace pointrt {

class TurntableJob {
public:
    /// Renders `pictures` frames of scene to pattern (turntable.h) on the selected device. Creates pattern's folder.
    /// Throws Error kBadUsage or kCannotWrite for an unusable pattern.
    /// @param follows_views the camera moves through the views of the scene, not around it
    TurntableJob(const SceneDescription& scene, const std::string& pattern, std::uint32_t pictures, bool follows_views,
                 const std::string& device);

    Job& job() { return job_; }
    const Job& job() const { return job_; }

private:
    Job job_;
};

} // namespace pointrt
