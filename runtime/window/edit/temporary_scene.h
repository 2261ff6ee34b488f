// SPDX-License-Identifier: Apache-2.0
// Scene files for programs that the window starts.
#pragma once

#include <filesystem>
#include <string>

#include "runtime/scene/scene_description.h"

namespace pointrt {

/// A temporary folder for scene files, deleted with them by the destructor.
class TemporaryScenes {
public:
    /// Throws Error kCannotWrite.
    TemporaryScenes();
    ~TemporaryScenes();
    TemporaryScenes(const TemporaryScenes&) = delete;
    TemporaryScenes& operator=(const TemporaryScenes&) = delete;

    /// Writes NAME.toml and returns its path. Throws as writeSceneFile does.
    std::string write(const std::string& name, const SceneDescription& scene) const;

private:
    std::filesystem::path folder_;
};

} // namespace pointrt
