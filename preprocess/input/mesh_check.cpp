// SPDX-License-Identifier: GPL-3.0-or-later
// What a mesh's vertices are worth as points: which belong to its surface, and whether they are dense enough for it.
#include <Eigen/Geometry>
#include <algorithm>

#include "preprocess/cloud/keep_flagged.h"
#include "preprocess/input/mesh.h"

namespace pointrt {
namespace {

/// Discs around vertices an edge e apart have radii of 1.4 e / sqrt(3), 1.6 e across: with edges of this share of the
/// diagonal a dozen of them span the mesh. Models of 50000 faces and more that were measured have 0.005 to 0.04, those
/// of a thousand and fewer 0.06 and up.
constexpr double kCoarseEdge = 0.05;

/// Faces that use less than this share of the vertices are not what a file is about.
constexpr std::size_t kFewFaces = 10;

/// Which points a face uses.
std::vector<bool> usedPoints(const Cloud& cloud, const std::vector<std::uint32_t>& bereft) {
    std::vector<bool> used(cloud.positions.size());
    for (const auto& face : cloud.triangles)
        for (const std::uint32_t corner : face) used[corner] = true;
    for (const std::uint32_t point : bereft) used[point] = true;
    return used;
}

void keepFlaggedValues(Attribute& attribute, const std::vector<bool>& keep) {
    const std::size_t size = attribute.bytesEach();
    char* kept = attribute.values.data();
    for (std::size_t i = 0; i < keep.size(); ++i)
        if (keep[i]) kept = std::copy_n(attribute.values.data() + i * size, size, kept);
    attribute.values.resize(static_cast<std::size_t>(kept - attribute.values.data()));
}

void keepPoints(Cloud& cloud, const std::vector<bool>& keep) {
    std::vector<std::uint32_t> renumbered(keep.size());
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < keep.size(); ++i) renumbered[i] = keep[i] ? next++ : next;
    for (auto& face : cloud.triangles)
        for (std::uint32_t& corner : face) corner = renumbered[corner];
    for (Scan& scan : cloud.scans)
        scan.first_point = scan.first_point < keep.size() ? renumbered[scan.first_point] : next;
    for (RangeGrid& grid : cloud.grids)
        for (std::uint32_t& cell : grid.point_of_cell)
            if (cell < RangeGrid::kLeftOut) cell = keep[cell] ? renumbered[cell] : RangeGrid::kLeftOut;
    keepFlagged(cloud.positions, keep);
    keepFlagged(cloud.normals, keep);
    keepFlagged(cloud.colors, keep);
    keepFlagged(cloud.sensor_of_point, keep);
    keepFlagged(cloud.radii, keep);
    for (Attribute& attribute : cloud.attributes) keepFlaggedValues(attribute, keep);
}

/// Mean over the surface of the longest edge of the face there, over the diagonal of all faces.
struct FaceSizes {
    double area = 0, area_times_edge = 0;
    Eigen::AlignedBox3d box;

    void add(const Cloud& cloud, const std::array<std::uint32_t, 3>& face) {
        std::array<Vec3d, 3> corners;
        for (int i = 0; i < 3; ++i) box.extend(corners[i] = cloud.positions[face[i]].cast<double>());
        const Vec3d u = corners[1] - corners[0], v = corners[2] - corners[0];
        const double longest = std::max({u.norm(), v.norm(), (v - u).norm()});
        const double twice_area = u.cross(v).norm();
        area += twice_area;
        area_times_edge += twice_area * longest;
    }
    bool areCoarse() const { return area > 0 && area_times_edge > kCoarseEdge * area * box.diagonal().norm(); }
};

/// The scan that a point belongs to; scans lie one after the other.
std::size_t scanOf(const std::vector<ScanRange>& scans, std::size_t point) {
    const auto after =
        std::upper_bound(scans.begin(), scans.end(), point,
                         [](std::size_t index, const ScanRange& scan) { return index < scan.first_position; });
    return static_cast<std::size_t>(after - scans.begin()) - 1;
}

} // namespace

void dropUnused(Cloud& cloud, const std::vector<ScanRange>& scans, const std::vector<std::uint32_t>& bereft, bool dry) {
    if (cloud.triangles.empty()) return;
    std::vector<bool> keep = usedPoints(cloud, bereft);
    for (const ScanRange& scan : scans) {
        const auto first = keep.begin() + static_cast<std::ptrdiff_t>(scan.first_position);
        const auto last = first + static_cast<std::ptrdiff_t>(scan.position_count);
        const auto used = static_cast<std::size_t>(std::count(first, last, true));
        const bool few = kFewFaces * used < scan.position_count;
        if (scan.has_faces && few)
            addNote(cloud, scan.name,
                    fmt::format("its faces use {} of {} points only; {}", used, scan.position_count,
                                dry ? "the others are not sampled" : "the others stay, as points"));
        if (scan.has_faces && (dry || !few))
            cloud.points_unused += scan.position_count - used;
        else
            std::fill(first, last, true);
    }
    if (!dry && cloud.points_unused > 0) keepPoints(cloud, keep);
}

void noteCoarseMeshes(Cloud& cloud, const std::vector<ScanRange>& scans) {
    std::vector<FaceSizes> sizes(scans.size());
    for (const auto& face : cloud.triangles) sizes[scanOf(scans, face[0])].add(cloud, face);
    for (std::size_t i = 0; i < scans.size(); ++i)
        if (sizes[i].areCoarse())
            addNote(
                cloud, scans[i].name,
                "its faces are large: splats at its vertices alone are giant discs; --sample N spreads N points over "
                "the faces, say 500000");
}

} // namespace pointrt
