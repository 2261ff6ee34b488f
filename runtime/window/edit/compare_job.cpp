// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/compare_job.h"

#include <filesystem>

#include "format/base/error.h"
#include "runtime/scene/layers.h"
#include "runtime/scene_io/scene_write.h"
#include "runtime/window/edit/rays_run.h"
#include "runtime/window/edit/temporary_scene.h"

namespace pointrt {
namespace {

/// A scene with one scan, placed as in scene but not clipped.
SceneDescription sceneOf(const SceneDescription& scene, std::size_t number) {
    SceneDescription alone;
    alone.instances = {bareScan(scene.instances.at(number))};
    alone.instances.front().visible = true;
    return alone;
}

std::string titleOf(const SceneDescription& scene, const Comparison& comparison) {
    return "Comparing " + layerName(scene, {LayerKind::kScan, comparison.compared}) + " with " +
           layerName(scene, {LayerKind::kScan, comparison.reference});
}

/// A path in the cache that depends on both scans and their placements.
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
    runRays(tool, "compare",
            {scenes.write("reference", reference), scenes.write("compared", compared), "--verbose", "-o", output},
            device, control);
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
