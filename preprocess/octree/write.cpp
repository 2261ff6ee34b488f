// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/octree/write.h"

#include <filesystem>
#include <new>

#include "format/base/error.h"
#include "preprocess/octree/splat_attributes.h"

namespace pointrt {

namespace {

/// Base colour of scans without colours.
constexpr std::array<float, 3> kPlaster{0.72f, 0.69f, 0.64f};
constexpr float kSpecular = 0.15f;
constexpr float kShininess = 24.0f;

std::vector<std::uint32_t> leafWords(const std::vector<Leaf>& leaves) {
    std::vector<std::uint32_t> words;
    words.reserve(leaves.size() * PRO_LEAF_WORDS);
    for (const Leaf& leaf : leaves) {
        const std::uint32_t counts = leaf.member_count | leaf.ref_count << PRO_LEAF_REF_SHIFT;
        words.insert(words.end(), {leaf.first_member, leaf.first_ref, counts, 0u});
    }
    return words;
}

OctreeCounts countOctree(const ProSections& sections) {
    const pro_info& info = sections.info;
    OctreeCounts counts;
    counts.filled_leaves = info.leaf_count;
    counts.nodes = info.node_count - (PRO_GROUP_SIZE - 1); // the root's group is padded
    const std::uint64_t inner = info.node_count / PRO_GROUP_SIZE - 1;
    counts.empty_leaves = counts.nodes - inner - counts.filled_leaves;
    for (std::size_t word = PRO_LEAF_COUNTS; word < sections.leaves.size(); word += PRO_LEAF_WORDS)
        counts.border_leaves += (sections.leaves[word] & PRO_LEAF_MEMBER_MASK) == 0;
    counts.references = std::uint64_t{info.splat_count} + info.ref_count;
    counts.max_depth = info.max_depth;
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

pro_world makeWorld(const ProContent& content) {
    pro_world world{};
    for (int axis = 0; axis < 3; ++axis) world.up[axis] = static_cast<float>(content.world.up[axis]);
    world.metres_per_unit = content.world.metres_per_unit;
    world.sensor_count = static_cast<std::uint32_t>(content.sensors.size() / PRO_SENSOR_DOUBLES);
    world.sensors = content.sensors.empty() ? nullptr : content.sensors.data();
    return world;
}

} // namespace

MaterialRow scanMaterial(bool has_color, float reflectivity) {
    MaterialRow row{};
    for (std::size_t c = 0; c < 3; ++c) row[PRO_MAT_BASE_COLOR + c] = has_color ? 1.0f : kPlaster[c];
    row[PRO_MAT_REFLECTIVITY] = reflectivity;
    row[PRO_MAT_SPECULAR] = kSpecular;
    row[PRO_MAT_SHININESS] = kShininess;
    return row;
}

ProSections makeSections(const PackedSplats& splats, const Octree& octree, const ProContent& content) {
    ProSections sections;
    pro_info& info = sections.info;
    info = makeInfo(splats, octree, content);
    sections.nodes = encodeNodes(octree.leaves, info.max_depth);
    sections.leaves = leafWords(octree.leaves);
    info.node_count = static_cast<std::uint32_t>(sections.nodes.size());
    pro_view& view = sections.view;
    view.nodes = sections.nodes.data();
    view.leaves = sections.leaves.data();
    view.refs = octree.refs.data();
    view.splats = splats.words.front().data();
    view.materials = content.materials.front().data();
    view.order = splats.input_index.data();
    view.metadata = content.metadata.data();
    view.metadata_bytes = content.metadata.size();
    sections.world = makeWorld(content);
    sections.sampling = {splats.input_count, splats.filled, 0, splats.noise.empty() ? nullptr : splats.noise.data()};
    sections.attributes = attributeViews(content.attributes);
    return sections;
}

OctreeCounts writePro(const std::string& path, bool overwrite, const ProSections& sections, const pro_index* index,
                      const pro_gaussians* gaussians) {
    pro_message message{};
    const pro_content content{&sections.info,
                              &sections.view,
                              index,
                              &sections.world,
                              sections.attributes.data(),
                              static_cast<std::uint32_t>(sections.attributes.size()),
                              &sections.sampling};
    const int replace = overwrite ? 1 : 0;
    const pro_result result = gaussians ? pro_write_gaussians(path.c_str(), &content, gaussians, replace, &message)
                                        : pro_write_content(path.c_str(), &content, replace, &message);
    if (result == PRO_OUT_OF_MEMORY) throw std::bad_alloc();
    // the writer refuses scans that exceed the limits of the format
    const ExitCode code = result == PRO_CANNOT_WRITE ? ExitCode::kCannotWrite : ExitCode::kBadInput;
    if (result != PRO_OK) throw Error(code, path + ": " + message.text);
    OctreeCounts counts = countOctree(sections);
    counts.file_bytes = std::filesystem::file_size(path);
    return counts;
}

} // namespace pointrt
