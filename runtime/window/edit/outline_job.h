// SPDX-License-Identifier: Apache-2.0
// Draws the outline of a cut in the background.
#pragma once

#include <optional>
#include <string>

#include "runtime/scene/scene_description.h"
#include "runtime/session/find_tool.h"
#include "runtime/window/edit/job.h"

namespace pointrt {

/// The plane in the notation of pointrt-rays section --plane, such as "z=1.2". None if it is not perpendicular to an
/// axis.
std::optional<std::string> planeOption(const ClipPlane& plane);

/// Runs pointrt-rays section on the scans of a scene, without the clips. Writes NAME.dxf in scene coordinates, and
/// NAME.svg.
class OutlineJob {
public:
    /// name: of the files without their suffixes
    OutlineJob(const SceneDescription& scene, const std::string& plane, const std::string& name,
               const std::string& device, const std::string& tool = findTool(kRaysTool));

    Job& job() { return job_; }
    const Job& job() const { return job_; }

private:
    Job job_;
};

} // namespace pointrt
