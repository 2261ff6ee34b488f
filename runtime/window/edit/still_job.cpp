// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/still_job.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "runtime/session/tool_run.h"
#include "runtime/window/edit/free_name.h"
#include "runtime/window/edit/viewer_run.h"

namespace pointrt {

StillJob::StillJob(const Still& still, const std::string& device)
    : job_("Rendering " + still.path, [=](JobControl& control) {
          const std::string size = std::to_string(still.size.width) + "x" + std::to_string(still.size.height);
          runViewer(still.scene, {"--size", size, "-o", safeArgument(still.path)}, device, control);
      }) {}

std::string freeStillName(const std::string& scene, const std::vector<Still>& waiting) {
    const std::string stem = stemOf(scene) + "-still-";
    for (std::size_t number = 1;; ++number) {
        const std::string name = stem + std::to_string(number) + ".png";
        std::error_code ignored;
        const bool waits =
            std::any_of(waiting.begin(), waiting.end(), [&](const Still& each) { return each.path == name; });
        if (!waits && !std::filesystem::exists(name, ignored)) return name;
    }
}

} // namespace pointrt
