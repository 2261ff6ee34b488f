// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene.h"

#include <cstdio>

#include "pointrt/tool.hpp"
#include "runtime/bricks.h"
#include "runtime/entry_grid.h"

namespace pointrt {

namespace {

/// Leaf indices share a word of the entry grid with 5 bits of marking, and there are fewer leaves than nodes.
constexpr std::uint32_t kNodeCountMax = 1u << 27;

ExitCode exitCodeFor(pro_result result) {
    return result == PRO_OUT_OF_MEMORY ? ExitCode::kCannotRun : ExitCode::kBadInput;
}

void mapFile(Scene& scene) {
    pro_message message{};
    const pro_result result = pro_open(scene.path.c_str(), 0, &scene.file, &message);
    if (result != PRO_OK) throw Error(exitCodeFor(result), scene.path + ": " + message.text);
    pro_get_info(scene.file, &scene.info);
    pro_get_view(scene.file, &scene.view);
    if (scene.info.node_count >= kNodeCountMax)
        throw Error(ExitCode::kCannotRun, scene.path + ": more than 2^27 nodes, too many for this viewer");
}

/// A section (never empty) as a texel buffer: the mapped pages themselves where device and host share memory, else a
/// copy.
Buffer sectionBuffer(Device& device, Scene& scene, const char* what, const void* data, std::uint64_t bytes,
                     VkFormat format) {
    Buffer buffer;
    if (device.unified_memory) buffer = importHostBuffer(device, data, bytes, VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    if (!buffer.handle)
        buffer = createFilledBuffer(device, what, data, bytes, VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    createTexelView(device, what, buffer, format);
    scene.device_bytes += bytes;
    return buffer;
}

Buffer wordBuffer(Device& device, Scene& scene, const char* what, const std::vector<std::uint32_t>& words,
                  VkFormat format) {
    const std::uint64_t bytes = words.size() * sizeof(std::uint32_t);
    Buffer buffer = createFilledBuffer(device, what, words.data(), bytes, VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    createTexelView(device, what, buffer, format);
    scene.device_bytes += bytes;
    return buffer;
}

void uploadSections(Device& device, Scene& scene) {
    const pro_info& info = scene.info;
    const pro_view& view = scene.view;
    const auto words = [](std::uint32_t count, std::uint32_t per_row) {
        return std::uint64_t{count} * per_row * sizeof(std::uint32_t);
    };
    scene.nodes =
        sectionBuffer(device, scene, "node buffer", view.nodes, words(info.node_count, 1), VK_FORMAT_R32_UINT);
    scene.splats = sectionBuffer(device, scene, "splat buffer", view.splats, words(info.splat_count, PRO_SPLAT_WORDS),
                                 VK_FORMAT_R32G32B32A32_UINT);
    scene.materials = sectionBuffer(device, scene, "material buffer", view.materials,
                                    words(info.material_count, PRO_MATERIAL_FLOATS), VK_FORMAT_R32G32B32A32_SFLOAT);
}

void uploadBricks(Device& device, Scene& scene) {
    const Bricks bricks = buildBricks(scene.info, scene.view);
    scene.bricks = wordBuffer(device, scene, "brick buffer", bricks.bricks, VK_FORMAT_R32G32B32A32_UINT);
    scene.cells = wordBuffer(device, scene, "cell buffer", bricks.cells, VK_FORMAT_R32G32B32A32_UINT);
    scene.lists = wordBuffer(device, scene, "list buffer", bricks.lists, VK_FORMAT_R32G32B32A32_UINT);
}

void uploadGrid(Device& device, Scene& scene) {
    EntryGrid grid = buildEntryGrid({scene.view.nodes, scene.info.node_count}, scene.info.leaf_count);
    scene.grid = wordBuffer(device, scene, "grid buffer", grid.words, VK_FORMAT_R32_UINT);
    grid.words.clear();
    scene.grid_frame = std::move(grid);
}

} // namespace

Scene loadScene(Device& device, const std::string& path, bool verbose) {
    Scene scene;
    scene.path = path;
    try {
        mapFile(scene);
        uploadSections(device, scene);
        uploadBricks(device, scene);
        uploadGrid(device, scene);
    } catch (...) {
        destroyScene(device, scene);
        throw;
    }
    if (verbose)
        std::fprintf(stderr, "%s: %u splats, %s, entry grid of %u x %u x %u cells\n", path.c_str(),
                     scene.info.splat_count, scene.splats.imported ? "mapped pages imported" : "sections uploaded",
                     scene.grid_frame.size[0], scene.grid_frame.size[1], scene.grid_frame.size[2]);
    return scene;
}

std::vector<BufferBinding> sceneBindings(const Scene& scene) {
    return {{0, &scene.nodes}, {1, &scene.bricks},    {2, &scene.lists}, {3, &scene.splats},
            {4, &scene.grid},  {5, &scene.materials}, {14, &scene.cells}};
}

void destroyScene(Device& device, Scene& scene) {
    for (Buffer* buffer :
         {&scene.nodes, &scene.splats, &scene.materials, &scene.bricks, &scene.cells, &scene.lists, &scene.grid})
        destroyBuffer(device, *buffer);
    if (scene.file) pro_close(scene.file);
    scene.file = nullptr;
}

} // namespace pointrt
