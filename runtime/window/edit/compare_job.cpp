// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/compare_job.h"

#include <cstdio>
#include <filesystem>
#include <vector>

#include "format/base/error.h"
#include "runtime/scene/layers.h"
#include "runtime/scene_io/scene_write.h"
#include "runtime/session/tool_run.h"
#include "runtime/window/edit/temporary_scene.h"

namespace pointrt {
namespace {

/// A scene of one scan, placed as in scene and whole.
SceneDescription sceneOf(const SceneDescription& scene, std::size_t number) {
    SceneDescription alone;
    alone.instances = {scene.instances.at(number)};
    InstanceDescription& scan = alone.instances.front();
    scan.visible = true;
    scan.material.reset(); // those of the scene are not in this one
    scan.overrides.clear();
    return alone;
}

/// Parses "Tracing 40%, ..." of a verbose run.
bool parseTenths(const std::string& line, JobControl& control) {
    int percent = 0;
    if (std::sscanf(line.c_str(), "%*[A-Za-z] %d%%,", &percent) != 1) return false;
    control.setProgress(percent / 100.0);
    return true;
}

std::string titleOf(const SceneDescription& scene, const Comparison& comparison) {
    return "Comparing " + layerName(scene, {LayerKind::kScan, comparison.compared}) + " with " +
           layerName(scene, {LayerKind::kScan, comparison.reference});
}

/// A name in the cache that depends on both scans and where they lie.
std::string cachedPath(const FileCache& cache, const SceneDescription& reference, const SceneDescription& compared,
                       const std::string& tool, const JobControl& control) {
    const ScanBake both{{reference.instances.front().path, compared.instances.front().path},
                        {"compare", sceneText(reference, "/"), sceneText(compared, "/")}};
    const std::string key = bakeKey(both, tool, [&] { return control.cancelled(); });
    control.throwIfCancelled();
    return cache.folder + "/" + key + cache.suffix;
}

void compare(const SceneDescription& reference, const SceneDescription& compared, const std::string& output,
             const std::string& tool, const std::string& device, JobControl& control) {
    const TemporaryScenes scenes;
    std::vector<std::string> arguments{
        tool, "compare", scenes.write("reference", reference), scenes.write("compared", compared), "--verbose",
        "-o", output};
    if (!device.empty()) arguments.insert(arguments.end(), {"--device", device});
    const ToolResult end = runTool(
        arguments, "pointrt-rays compare", [&] { return control.cancelled(); },
        [&](const std::string& line) { return parseTenths(line, control); });
    control.throwIfCancelled();
    if (end.wait_status != 0) throw Error{exitCodeOf(end), describeFailure(end, "pointrt-rays compare")};
}

} // namespace

bool mayCompare(const InstanceDescription& scan) { return !scan.deleted && scan.path.ends_with(".pro"); }

CompareJob::CompareJob(const SceneDescription& scene, const Comparison& comparison, const std::string& device,
                       const FileCache& cache, const std::string& tool)
    : job_(titleOf(scene, comparison),
           [this, reference = sceneOf(scene, comparison.reference), compared = sceneOf(scene, comparison.compared),
            device, cache, tool](JobControl& control) {
               if (cache.folder.empty())
                   throw Error{ExitCode::kCannotWrite, "the cache for baked scans is off or has no folder; compare the "
                                                       "scans with pointrt-rays compare"};
               output_ = cachedPath(cache, reference, compared, tool, control);
               std::error_code ignored;
               if (!std::filesystem::exists(output_, ignored)) {
                   makeRoomFor(cache, 0);
                   compare(reference, compared, output_, tool, device, control);
               }
               markUsed(output_);
           }) {}

} // namespace pointrt
