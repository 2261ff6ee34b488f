// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene_io/write_parts.h"

namespace pointrt {
namespace {

void putForm(SceneWriting& writing, const ClipBox& box) {
    put(writing, "type", "\"box\"");
    put(writing, "min", tomlOf(box.low));
    put(writing, "max", tomlOf(box.high));
    if (box.rotation != ClipBox{}.rotation) put(writing, "rotate", "{ matrix = " + tomlOf(box.rotation) + " }");
}

void putForm(SceneWriting& writing, const ClipPlane& plane) {
    put(writing, "type", "\"plane\"");
    put(writing, "point", tomlOf(plane.point));
    put(writing, "normal", tomlOf(plane.normal));
}

} // namespace

void writeClips(SceneWriting& writing) {
    for (const ClipDescription& clip : writing.scene.clips) {
        begin(writing, "[[clip]]");
        std::visit([&](const auto& form) { putForm(writing, form); }, clip.form);
        if (!clip.enabled) put(writing, "enabled", "false");
        putLayer(writing, clip.layer);
    }
}

} // namespace pointrt
