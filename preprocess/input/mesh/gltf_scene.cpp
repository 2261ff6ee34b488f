// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/mesh/gltf_scene.h"

namespace pointrt {
namespace {

/// A few thousand in large models; more would take memory out of proportion to a file that shows one mesh many times.
constexpr std::size_t kMostParts = 1 << 20;

/// A matrix in column-major order.
Eigen::Affine3d matrixOf(const JsonValue& matrix) {
    Eigen::Affine3d transform = Eigen::Affine3d::Identity();
    for (Eigen::Index column = 0; column < 4; ++column)
        for (Eigen::Index row = 0; row < 3; ++row)
            transform.matrix()(row, column) = matrix.at(static_cast<std::size_t>(4 * column + row)).number();
    return transform;
}

Eigen::Vector3d vectorOf(const JsonValue& vector) {
    return {vector.at(0).number(), vector.at(1).number(), vector.at(2).number()};
}

/// x y z w
Eigen::Quaterniond rotationOf(const JsonValue& rotation) {
    const auto part = [&](std::size_t i) { return rotation.at(i).number(); };
    const Eigen::Quaterniond turn(part(3), part(0), part(1), part(2));
    if (!(turn.norm() > 0)) rotation.refuse("is not a rotation");
    return turn.normalized();
}

Eigen::Affine3d parentFromNode(const JsonValue& node) {
    if (const auto matrix = node.optionalMember("matrix")) return matrixOf(*matrix);
    Eigen::Affine3d transform = Eigen::Affine3d::Identity();
    if (const auto translation = node.optionalMember("translation")) transform.translate(vectorOf(*translation));
    if (const auto rotation = node.optionalMember("rotation")) transform.rotate(rotationOf(*rotation));
    if (const auto scale = node.optionalMember("scale")) transform.scale(vectorOf(*scale));
    return transform;
}

/// The nodes where a walk begins.
std::vector<std::uint64_t> rootNodes(const GltfFile& file, std::size_t node_count) {
    const JsonValue root = file.root();
    std::vector<std::uint64_t> roots;
    if (root.has("scenes") && root.member("scenes").size() > 0) {
        const JsonValue scene =
            root.has("scene") ? file.item("scenes", root.member("scene")) : root.member("scenes").at(0);
        const auto nodes = scene.optionalMember("nodes");
        for (std::size_t i = 0; nodes && i < nodes->size(); ++i) roots.push_back(nodes->at(i).integer());
        return roots;
    }
    std::vector<bool> has_parent(node_count);
    for (std::size_t i = 0; i < node_count; ++i) {
        const auto children = root.member("nodes").at(i).optionalMember("children");
        for (std::size_t k = 0; children && k < children->size(); ++k)
            has_parent[children->at(k).integer(node_count - 1)] = true;
    }
    for (std::size_t i = 0; i < node_count; ++i)
        if (!has_parent[i]) roots.push_back(i);
    return roots;
}

void addParts(const GltfFile& file, const JsonValue& node, const Eigen::Affine3d& input_from_node,
              std::vector<GltfPart>& parts) {
    const auto mesh = node.optionalMember("mesh");
    if (!mesh) return;
    const JsonValue primitives = file.item("meshes", *mesh).member("primitives");
    if (primitives.size() > kMostParts - parts.size())
        refuse(file.input(), fmt::format("has more than {} primitives in its scene", kMostParts));
    for (std::size_t i = 0; i < primitives.size(); ++i) parts.push_back({primitives.at(i), input_from_node});
}

} // namespace

std::optional<JsonValue> GltfPart::extension(const char* name) const {
    const auto extensions = primitive.optionalMember("extensions");
    return extensions ? extensions->optionalMember(name) : std::nullopt;
}

std::vector<GltfPart> gltfParts(const GltfFile& file) {
    std::vector<GltfPart> parts;
    const auto nodes = file.root().optionalMember("nodes");
    if (!nodes) return parts;
    struct Placed {
        std::uint64_t node;
        Eigen::Affine3d input_from_parent;
    };
    std::vector<Placed> open;
    std::vector<bool> visited(nodes->size());
    for (const std::uint64_t node : rootNodes(file, nodes->size())) open.push_back({node, Eigen::Affine3d::Identity()});
    while (!open.empty()) {
        const Placed placed = open.back();
        open.pop_back();
        const JsonValue node = nodes->at(placed.node);
        if (visited[placed.node]) node.refuse("has two parents, or is its own ancestor");
        visited[placed.node] = true;
        const Eigen::Affine3d input_from_node = placed.input_from_parent * parentFromNode(node);
        addParts(file, node, input_from_node, parts);
        const auto children = node.optionalMember("children");
        for (std::size_t i = 0; children && i < children->size(); ++i)
            open.push_back({children->at(i).integer(), input_from_node});
    }
    return parts;
}

} // namespace pointrt
