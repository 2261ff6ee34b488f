// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/outline_job.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "runtime/session/tool_run.h"
#include "runtime/window/edit/rays_run.h"
#include "runtime/window/edit/temporary_scene.h"

namespace pointrt {
namespace {

/// The visible scans in their places, without clips.
SceneDescription scansOf(const SceneDescription& scene) {
    SceneDescription scans;
    scans.up = scene.up;
    for (const InstanceDescription& each : scene.instances)
        if (each.visible && !each.deleted) scans.instances.push_back(bareScan(each));
    return scans;
}

void draw(const SceneDescription& scene, const std::string& plane, const std::string& file, const std::string& device,
          const std::string& tool, JobControl& control) {
    const TemporaryScenes scenes;
    runRays(tool, "section", {scenes.write("scans", scene), "--plane", plane, "-q", "-o", safeArgument(file)}, device,
            control);
}

} // namespace

std::optional<std::string> planeOption(const ClipPlane& plane) {
    constexpr double kSquare = 1 - 1e-9; // cosine of the angle to an axis, within rounding
    const std::array<double, 3> normal{plane.normal.x, plane.normal.y, plane.normal.z};
    const std::array<double, 3> point{plane.point.x, plane.point.y, plane.point.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (std::abs(normal[axis]) < kSquare) continue;
        std::array<char, 40> text{};
        std::snprintf(text.data(), text.size(), "%c=%.10g", "xyz"[axis], point[axis]);
        return text.data();
    }
    return std::nullopt;
}

OutlineJob::OutlineJob(const SceneDescription& scene, const std::string& plane, const std::string& name,
                       const std::string& device, const std::string& tool)
    : job_("Drawing the outline at " + plane, [=, scans = scansOf(scene)](JobControl& control) {
          for (const char* suffix : {".dxf", ".svg"}) draw(scans, plane, name + suffix, device, tool, control);
      }) {}

} // namespace pointrt
