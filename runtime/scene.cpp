// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene.h"

#include <array>
#include <cstdio>
#include <iterator>
#include <span>

#include "pointrt/pro_index_layout.h"
#include "pointrt/tool.hpp"

namespace pointrt {

namespace {

ExitCode exitCodeFor(pro_result result) {
    return result == PRO_OUT_OF_MEMORY ? ExitCode::kCannotRun : ExitCode::kBadInput;
}

void mapFile(Scene& scene) {
    pro_message message{};
    const pro_result result = pro_open(scene.path.c_str(), PRO_OPEN_TRACE, &scene.file, &message);
    if (result != PRO_OK) throw Error(exitCodeFor(result), scene.path + ": " + message.text);
    pro_get_info(scene.file, &scene.info);
    pro_get_view(scene.file, &scene.view);
}

void uploadSections(Device& device, Scene& scene) {
    const pro_info& info = scene.info;
    const pro_view& view = scene.view;
    const std::uint64_t bytes = std::uint64_t{info.splat_count} * PRO_SPLAT_WORDS * sizeof(std::uint32_t);
    scene.splats = createPagedBuffer(device, "splat buffer", view.splats, bytes, VK_FORMAT_R32G32B32A32_UINT);
    scene.device_bytes += bytes;
}

struct IndexBuffer {
    PagedBuffer Scene::*buffer;
    const char* what;
    VkFormat format;
};
constexpr IndexBuffer kIndexBuffers[] = {{&Scene::brick_words, "brick buffer", VK_FORMAT_R32_UINT},
                                         {&Scene::cells, "cell buffer", VK_FORMAT_R32G32_UINT},
                                         {&Scene::slabs, "slab buffer", VK_FORMAT_R32_UINT},
                                         {&Scene::near, "near splat buffer", VK_FORMAT_R32G32B32A32_UINT},
                                         {&Scene::lists, "list buffer", VK_FORMAT_R32G32B32A32_UINT},
                                         {&Scene::blend_ranges, "blend range buffer", VK_FORMAT_R32G32_UINT}};

/// In the order of kIndexBuffers.
std::array<std::span<const std::uint32_t>, std::size(kIndexBuffers)> wordsOf(const pro_index& index) {
    const auto words = [](const std::uint32_t* data, std::uint64_t count, std::uint32_t each) {
        return std::span(data, static_cast<std::size_t>(count * each));
    };
    const std::uint64_t brick_words = std::uint64_t{index.brick_count} * PRO_BRICK_WORDS;
    return {words(index.bricks, brick_words + std::uint64_t{index.group_count} * PRO_GROUP_WORDS, 1),
            words(index.cells, index.cell_count, PRO_CELL_WORDS),
            words(index.slabs, index.cell_count, 1),
            words(index.near_splats, index.near_count, PRO_NEAR_WORDS),
            words(index.lists, index.list_count, 1),
            words(index.blend_ranges, index.cell_count, PRO_BLEND_RANGE_WORDS)};
}

void uploadIndex(Device& device, Scene& scene) {
    const pro_index& index = scene.index;
    const std::uint64_t grid_bytes =
        std::uint64_t{index.size[0]} * index.size[1] * index.size[2] * sizeof(std::uint32_t);
    scene.grid_words = createTexelBuffer(device, "grid buffer", index.grid, grid_bytes, VK_FORMAT_R32_UINT);
    scene.device_bytes += grid_bytes;
    const auto words = wordsOf(index);
    for (std::size_t k = 0; k < words.size(); ++k) {
        const IndexBuffer& each = kIndexBuffers[k];
        scene.*each.buffer = createPagedBuffer(device, each.what, words[k].data(), words[k].size_bytes(), each.format);
        scene.device_bytes += words[k].size_bytes();
    }
}

/// Of a file without an index; what was copied to the device is let go.
void buildAndUploadIndex(Device& device, Scene& scene) {
    scene.built = buildTracingIndex(scene.info, scene.view);
    scene.index = indexView(scene.built);
    uploadIndex(device, scene);
    Bricks& bricks = scene.built.bricks;
    Words* const words[] = {&bricks.words, &bricks.cells, &bricks.slabs,
                            &bricks.near,  &bricks.lists, &bricks.blend_ranges};
    for (std::size_t k = 0; k < std::size(words); ++k)
        if (!isImported(scene.*kIndexBuffers[k].buffer)) Words().swap(*words[k]); // {} would keep the memory
    if (!scene.grid_words.imported) Words().swap(scene.built.grid.words);
}

/// All that the device reads. Errors name the file.
void upload(Device& device, Scene& scene) {
    try {
        uploadSections(device, scene);
        if (pro_get_index(scene.file, &scene.index))
            uploadIndex(device, scene);
        else
            buildAndUploadIndex(device, scene);
    } catch (const Error& error) {
        throw Error(error.code, scene.path + ": " + error.what());
    }
    scene.pages = pageCounts(device, pagedBuffers(scene));
}

} // namespace

Scene loadScene(Device& device, const std::string& path, bool verbose) {
    Scene scene;
    scene.path = path;
    try {
        mapFile(scene);
        upload(device, scene);
    } catch (...) {
        destroyScene(device, scene);
        throw;
    }
    if (verbose)
        std::fprintf(stderr, "%s: %u splats, %s%s, tracing index %s, entry grid of %u x %u x %u cells\n", path.c_str(),
                     scene.info.splat_count, isImported(scene.splats) ? "mapped pages imported" : "sections uploaded",
                     isPaged(scene.pages) ? ", in pages" : "",
                     scene.built.grid.size[0] == 0 ? "from the file" : "built", scene.index.size[0],
                     scene.index.size[1], scene.index.size[2]);
    return scene;
}

Scene blankScene(Device& device) {
    Scene scene;
    static constexpr std::uint32_t kZeros[4] = {}; // it may become device memory as it is
    const auto blank = [&](VkFormat format) {
        return createTexelBuffer(device, "blank buffer", kZeros, sizeof kZeros, format);
    };
    scene.grid_words = blank(VK_FORMAT_R32_UINT);
    for (PagedBuffer* buffer : {&scene.brick_words, &scene.slabs}) buffer->pages = {blank(VK_FORMAT_R32_UINT)};
    for (PagedBuffer* buffer : {&scene.cells, &scene.blend_ranges}) buffer->pages = {blank(VK_FORMAT_R32G32_UINT)};
    for (PagedBuffer* buffer : {&scene.splats, &scene.near, &scene.lists})
        buffer->pages = {blank(VK_FORMAT_R32G32B32A32_UINT)};
    return scene;
}

std::vector<BufferBinding> sceneBindings(const Scene& scene) {
    return {{1, &scene.brick_words.pages[0]}, {2, &scene.lists.pages[0]},        {3, &scene.splats.pages[0]},
            {4, &scene.grid_words},           {14, &scene.cells.pages[0]},       {15, &scene.near.pages[0]},
            {21, &scene.slabs.pages[0]},      {16, &scene.blend_ranges.pages[0]}};
}

PagedBuffers pagedBuffers(const Scene& scene) {
    return {&scene.brick_words, &scene.cells,        &scene.slabs, &scene.near,
            &scene.lists,       &scene.blend_ranges, &scene.splats};
}

void destroyScene(Device& device, Scene& scene) {
    for (PagedBuffer* buffer : {&scene.splats, &scene.brick_words, &scene.cells, &scene.slabs, &scene.near,
                                &scene.lists, &scene.blend_ranges})
        destroyPagedBuffer(device, *buffer);
    destroyBuffer(device, scene.grid_words);
    scene.built = {};
    scene.index = {};
    if (scene.file) pro_close(scene.file);
    scene.file = nullptr;
}

} // namespace pointrt
