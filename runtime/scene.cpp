// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene.h"

#include <cstdio>

#include "pointrt/tool.hpp"
#include "runtime/bricks.h"
#include "runtime/cell_skips.h"
#include "runtime/entry_grid.h"

namespace pointrt {

namespace {

ExitCode exitCodeFor(pro_result result) {
    return result == PRO_OUT_OF_MEMORY ? ExitCode::kCannotRun : ExitCode::kBadInput;
}

void mapFile(Scene& scene) {
    pro_message message{};
    const pro_result result = pro_open(scene.path.c_str(), 0, &scene.file, &message);
    if (result != PRO_OK) throw Error(exitCodeFor(result), scene.path + ": " + message.text);
    pro_get_info(scene.file, &scene.info);
    pro_get_view(scene.file, &scene.view);
}

/// Bytes (some) as a texel buffer: where device and host share memory the host's own pages, which must stay, else a
/// copy.
Buffer texelBuffer(Device& device, Scene& scene, const char* what, const void* data, std::uint64_t bytes,
                   VkFormat format) {
    Buffer buffer;
    if (device.unified_memory) buffer = importHostBuffer(device, data, bytes, VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    if (!buffer.handle)
        buffer = createFilledBuffer(device, what, data, bytes, VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    createTexelView(device, what, buffer, format);
    scene.device_bytes += bytes;
    return buffer;
}

/// The same for words; a copy's original is let go.
Buffer wordBuffer(Device& device, Scene& scene, const char* what, Words& words, VkFormat format) {
    Buffer buffer = texelBuffer(device, scene, what, words.data(), words.size() * sizeof words[0], format);
    if (!buffer.imported) Words().swap(words); // {} would keep the memory
    return buffer;
}

void uploadSections(Device& device, Scene& scene) {
    const pro_info& info = scene.info;
    const pro_view& view = scene.view;
    const std::uint64_t bytes = std::uint64_t{info.splat_count} * PRO_SPLAT_WORDS * sizeof(std::uint32_t);
    scene.splats = texelBuffer(device, scene, "splat buffer", view.splats, bytes, VK_FORMAT_R32G32B32A32_UINT);
}

void uploadTraversal(Device& device, Scene& scene) {
    EntryGrid& grid = scene.grid_frame;
    Bricks& bricks = scene.bricks;
    grid = frameEntryGrid(scene.info, scene.view);
    bricks = buildBricks(scene.info, scene.view, grid);
    fillEntryGrid(grid, bricks.corners);
    fillCellSkips(grid, bricks.corners.size(), bricks.words);
    std::vector<Corner>().swap(bricks.corners);
    scene.grid_words = wordBuffer(device, scene, "grid buffer", grid.words, VK_FORMAT_R32_UINT);
    scene.brick_words = wordBuffer(device, scene, "brick buffer", bricks.words, VK_FORMAT_R32_UINT);
    scene.cells = wordBuffer(device, scene, "cell buffer", bricks.cells, VK_FORMAT_R32G32_UINT);
    scene.slabs = wordBuffer(device, scene, "slab buffer", bricks.slabs, VK_FORMAT_R32_UINT);
    scene.near = wordBuffer(device, scene, "near splat buffer", bricks.near, VK_FORMAT_R32G32B32A32_UINT);
    scene.lists = wordBuffer(device, scene, "list buffer", bricks.lists, VK_FORMAT_R32G32B32A32_UINT);
    scene.blend_ranges = wordBuffer(device, scene, "blend range buffer", bricks.blend_ranges, VK_FORMAT_R32G32_UINT);
}

} // namespace

Scene loadScene(Device& device, const std::string& path, bool verbose) {
    Scene scene;
    scene.path = path;
    try {
        mapFile(scene);
        uploadSections(device, scene);
        uploadTraversal(device, scene);
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

Scene blankScene(Device& device) {
    Scene scene;
    const std::uint32_t zeros[4] = {};
    const auto blank = [&](Buffer& buffer, VkFormat format) {
        buffer =
            createFilledBuffer(device, "blank buffer", zeros, sizeof zeros, VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
        createTexelView(device, "blank buffer", buffer, format);
    };
    for (Buffer* buffer : {&scene.grid_words, &scene.brick_words, &scene.slabs}) blank(*buffer, VK_FORMAT_R32_UINT);
    for (Buffer* buffer : {&scene.cells, &scene.blend_ranges}) blank(*buffer, VK_FORMAT_R32G32_UINT);
    for (Buffer* buffer : {&scene.splats, &scene.near, &scene.lists}) blank(*buffer, VK_FORMAT_R32G32B32A32_UINT);
    return scene;
}

std::vector<BufferBinding> sceneBindings(const Scene& scene) {
    return {{1, &scene.brick_words}, {2, &scene.lists}, {3, &scene.splats}, {4, &scene.grid_words},
            {14, &scene.cells},      {15, &scene.near}, {21, &scene.slabs}, {16, &scene.blend_ranges}};
}

void destroyScene(Device& device, Scene& scene) {
    for (Buffer* buffer : {&scene.splats, &scene.brick_words, &scene.cells, &scene.slabs, &scene.near, &scene.lists,
                           &scene.blend_ranges, &scene.grid_words})
        destroyBuffer(device, *buffer);
    scene.bricks = {};
    scene.grid_frame = {};
    if (scene.file) pro_close(scene.file);
    scene.file = nullptr;
}

} // namespace pointrt
