// SPDX-License-Identifier: Apache-2.0
// Scene files. A scene written and read again must be the same.
#include <cstdio>
#include <cstdlib>

#include "format/base/error.h"
#include "runtime/scene_io/scene_file.h"
#include "runtime/scene_io/scene_write.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/support/temporary_folder.h"

using namespace pointrt;

namespace {

/// The folder of files that a scene names.
const std::string& folderOfScenes() {
    static const test::TemporaryFolder folder;
    static const std::string path = folder.path.string();
    static const std::string scan = folder.write("a.pro", ""), sky = folder.write("a.hdr", "");
    return path;
}

void expectSameOnceWritten(const SceneDescription& scene) {
    const std::string written = sceneText(scene, folderOfScenes());
    std::string again;
    try {
        again = sceneText(parseScene(written, scene.path), folderOfScenes());
    } catch (const Error& error) {
        again = error.what();
    }
    if (written == again) return;
    std::fprintf(stderr, "written:\n%s\nread and written again:\n%s\n", written.c_str(), again.c_str());
    std::abort();
}

} // namespace

POINTRT_FUZZ_TARGET(scene) {
    const std::string path = folderOfScenes() + "/scene.toml";
    fuzz::expectReadOrRefused(path, [&] { expectSameOnceWritten(parseScene(fuzz::textOf(input), path)); });
}
