// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/octree/write.h"

#include <algorithm>
#include <filesystem>
#include <new>

#include "pointrt/tool.hpp"

namespace pointrt {

namespace {

std::vector<std::uint32_t> leafWords(const std::vector<Leaf>& leaves) {
    std::vector<std::uint32_t> words;
    words.reserve(leaves.size() * PRO_LEAF_WORDS);
    for (const Leaf& leaf : leaves) {
        const std::uint32_t counts = leaf.member_count | leaf.ref_count << PRO_LEAF_REF_SHIFT;
        words.insert(words.end(), {leaf.first_member, leaf.first_ref, counts, 0u});
    }
    return words;
}

OctreeCounts countOctree(const PackedSplats& splats, const Octree& octree, std::uint64_t node_words) {
    OctreeCounts counts;
    counts.filled_leaves = octree.leaves.size();
    counts.nodes = node_words - (PRO_GROUP_SIZE - 1); // the root's group is padded
    const std::uint64_t inner = node_words / PRO_GROUP_SIZE - 1;
    counts.empty_leaves = counts.nodes - inner - counts.filled_leaves;
    counts.border_leaves = static_cast<std::uint64_t>(std::count_if(
        octree.leaves.begin(), octree.leaves.end(), [](const Leaf& leaf) { return leaf.member_count == 0; }));
    counts.references = splats.words.size() + octree.refs.size();
    return counts;
}

pro_info makeInfo(const PackedSplats& splats, const Octree& octree, const ProContent& content) {
    pro_info info = splats.frame;
    info.flags |= content.pruned ? PRO_FLAG_PRUNED : 0u;
    info.splat_count = static_cast<std::uint32_t>(splats.words.size());
    info.leaf_count = static_cast<std::uint32_t>(octree.leaves.size());
    info.ref_count = static_cast<std::uint32_t>(octree.refs.size());
    info.material_count = static_cast<std::uint32_t>(content.materials.size());
    return info;
}

} // namespace

OctreeCounts writePro(const std::string& path, const PackedSplats& splats, const Octree& octree,
                      const ProContent& content) {
    pro_info info = makeInfo(splats, octree, content);
    const auto nodes = encodeNodes(octree.leaves, info.max_depth);
    info.node_count = static_cast<std::uint32_t>(nodes.size());
    const auto leaves = leafWords(octree.leaves);
    pro_view view{};
    view.nodes = nodes.data();
    view.leaves = leaves.data();
    view.refs = octree.refs.data();
    view.splats = splats.words.front().data();
    view.materials = content.materials.front().data();
    view.order = splats.input_index.data();
    view.metadata = content.metadata.data();
    view.metadata_bytes = content.metadata.size();

    pro_message message{};
    const pro_result result = pro_write(path.c_str(), &info, &view, &message);
    if (result == PRO_OUT_OF_MEMORY) throw std::bad_alloc();
    // what the writer refuses to write is a scan that no .pro can hold
    const ExitCode code = result == PRO_CANNOT_WRITE ? ExitCode::kCannotWrite : ExitCode::kBadInput;
    if (result != PRO_OK) throw Error(code, path + ": " + message.text);
    OctreeCounts counts = countOctree(splats, octree, nodes.size());
    counts.max_depth = info.max_depth;
    counts.file_bytes = std::filesystem::file_size(path);
    return counts;
}

} // namespace pointrt
