// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/edit/temporary_scene.h"

#include <system_error>

#include "format/base/error.h"
#include "format/os/temporary_folder.h"
#include "runtime/scene_io/scene_write.h"

namespace pointrt {

namespace fs = std::filesystem;

TemporaryScenes::TemporaryScenes() : folder_(makeTemporaryFolder()) {
    if (folder_.empty())
        throw Error{ExitCode::kCannotWrite, fs::temp_directory_path().string() + ": cannot create a temporary folder"};
}

TemporaryScenes::~TemporaryScenes() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
}

std::string TemporaryScenes::write(const std::string& name, const SceneDescription& scene) const {
    const std::string path = (folder_ / (name + ".toml")).string();
    writeSceneFile(path, scene);
    return path;
}

} // namespace pointrt
