// SPDX-License-Identifier: GPL-3.0-or-later
// glTF 2.0 and GLB: points, meshes and Gaussians where the nodes of the default scene place them.
#include <algorithm>

#include "preprocess/ingest/formats.h"
#include "preprocess/input/mesh/gltf_gaussians.h"
#include "preprocess/input/mesh/gltf_meshes.h"

namespace pointrt {
namespace {

/// Extensions without which the geometry cannot be read, if the file requires them.
constexpr const char* kUnreadExtensions[] = {"KHR_draco_mesh_compression", "EXT_meshopt_compression",
                                             "KHR_meshopt_compression", "EXT_mesh_gpu_instancing"};

void checkExtensions(const GltfFile& file) {
    const auto required = file.root().optionalMember("extensionsRequired");
    for (std::size_t i = 0; required && i < required->size(); ++i)
        for (const char* const name : kUnreadExtensions)
            if (required->at(i).text() == name)
                refuse(file.input(),
                       fmt::format("requires the glTF extension {}, which this build does not read", name));
}

/// The parts of a file, sorted by their contents.
struct SortedParts {
    std::vector<GltfPart> gaussians, points, meshes;
    std::size_t lines = 0;

    explicit SortedParts(const GltfFile& file) {
        for (const GltfPart& part : gltfParts(file)) {
            const GltfShape shape = gltfShape(part);
            if (areGaussians(part))
                gaussians.push_back(part);
            else if (shape == GltfShape::kLines)
                ++lines;
            else
                (shape == GltfShape::kPoints ? points : meshes).push_back(part);
        }
    }

    std::size_t scans() const { return !gaussians.empty() + !points.empty() + std::size_t{!meshes.empty()}; }
};

/// Notes what is not read.
void noteUnread(const GltfFile& file, const SortedParts& parts, Sink& sink) {
    if (parts.lines > 0)
        sink.note(file.input(), fmt::format("has {} primitives of lines, which are not read", parts.lines));
    const bool moves = file.root().has("animations") || file.root().has("skins");
    if (moves) sink.note(file.input(), "has animations or skins: its meshes are read as they are at rest");
}

/// Drops points and meshes beside Gaussians, since these are baked separately.
void dropSurfaces(const GltfFile& file, SortedParts& parts, Sink& sink) {
    if (parts.gaussians.empty() || sink.gaussians_as_discs || parts.points.size() + parts.meshes.size() == 0) return;
    sink.note(file.input(),
              fmt::format("has Gaussians and {} primitives of points or triangles; the primitives are left out",
                          parts.points.size() + parts.meshes.size()));
    parts.points.clear();
    parts.meshes.clear();
}

void readGltf(const InputFile& input, Sink& sink) {
    const GltfFile file(input);
    checkExtensions(file);
    SortedParts parts(file);
    noteUnread(file, parts, sink);
    dropSurfaces(file, parts, sink);
    if (parts.scans() == 0) refuse(input, "holds no points");
    const auto title = [&](const char* of_several) { return parts.scans() > 1 ? of_several : ""; };
    if (!parts.gaussians.empty()) readGltfGaussians(file, parts.gaussians, title("Gaussians"), sink);
    if (!parts.points.empty()) readGltfParts(file, parts.points, title("points"), sink);
    if (!parts.meshes.empty()) readGltfParts(file, parts.meshes, title("meshes"), sink);
    WorldFrame frame;
    frame.up = Vec3d::UnitY();
    frame.metres_per_unit = 1;
    sink.setWorldFrame(input, frame);
}

} // namespace

const FormatReader readers::kGltf{.isStart = isGltf, .read = readGltf};

} // namespace pointrt
