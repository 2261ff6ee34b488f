// SPDX-License-Identifier: GPL-3.0-or-later
// Checks a mesh's vertices as points: which belong to its surface, and whether they are dense enough for it.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <tuple>

#include "preprocess/cloud/keep_flagged.h"
#include "preprocess/ingest/notes.h"
#include "preprocess/input/mesh/mesh.h"

namespace pointrt {
namespace {

/// Discs around vertices with edges of length e have radii of 1.4 e / sqrt(3), a width of 1.6 e: with edges of this
/// share of the diagonal, a dozen discs span the mesh. Measured models of 50000 faces and more have 0.005 to 0.04,
/// those of a thousand and fewer 0.06 and up.
constexpr double kCoarseEdge = 0.05;

/// Radius of these discs over the edge length.
constexpr double kRadiusOverEdge = 0.8;

/// Largest mean distance of discs from the faces, over the diagonal: a pixel in a picture of 512 pixels, which shows
/// the diagonal 420 pixels long.
constexpr double kStandOff = 1 / 420.0;

/// Samples along a diagonal, three for every two such pixels, as far as the total number allows; one per pixel would
/// leave ragged edges.
constexpr double kSamplesAcross = 630;
constexpr double kLeastSamples = 100'000, kMostSamples = 1'000'000;
/// Fewer samples would lose detail of the vertices.
constexpr double kSamplesPerVertex = 2;

/// Faces that use fewer than one in this many vertices do not make a file a mesh.
constexpr std::size_t kFewFaces = 10;

/// Flags points that a face uses and, in meshes that are not sampled, corners of removed faces.
std::vector<bool> usedPoints(const Cloud& cloud, const std::vector<ScanRange>& scans,
                             const std::vector<std::uint32_t>& removed_corners, const std::vector<bool>& sampled) {
    std::vector<bool> used(cloud.positions.size());
    for (const auto& face : cloud.triangles)
        for (const std::uint32_t corner : face) used[corner] = true;
    for (const std::uint32_t point : removed_corners)
        if (!sampled[scanOf(scans, point)]) used[point] = true;
    return used;
}

/// Minor attributes whose values are all 0 are empty until all files are read, and stay so.
void keepFlaggedValues(Attribute& attribute, const std::vector<bool>& keep) {
    if (attribute.values.empty()) return;
    const std::size_t size = attribute.bytesEach();
    char* kept = attribute.values.data();
    for (std::size_t i = 0; i < keep.size(); ++i)
        if (keep[i]) kept = std::copy_n(attribute.values.data() + i * size, size, kept);
    attribute.values.resize(static_cast<std::size_t>(kept - attribute.values.data()));
}

/// Indices of the points that faces use, ascending.
std::vector<std::uint32_t> cornersOf(const Cloud& cloud) {
    std::vector<std::uint32_t> corners;
    for (const auto& face : cloud.triangles) corners.insert(corners.end(), face.begin(), face.end());
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    return corners;
}

/// [points] the first corner at the same position; the single disc there gets its normal: files with separate vertices
/// for each face have several corners at a position.
std::vector<std::uint32_t> firstsAtPositions(const Cloud& cloud) {
    std::vector<std::uint32_t> corners = cornersOf(cloud), firsts(cloud.positions.size());
    const auto key = [&](std::uint32_t point) {
        const Vec3f& p = cloud.positions[point];
        return std::tuple(p.x(), p.y(), p.z());
    };
    std::stable_sort(corners.begin(), corners.end(), [&](auto a, auto b) { return key(a) < key(b); });
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const bool again = i > 0 && key(corners[i - 1]) == key(corners[i]);
        firsts[corners[i]] = again ? firsts[corners[i - 1]] : corners[i];
    }
    return firsts;
}

/// Statistics of the faces of one mesh.
struct FaceSizes {
    std::size_t faces = 0, flat = 0, corners = 0;
    double area = 0, area_times_edge = 0, area_times_stand_off = 0; ///< edge: the longest of a face
    Eigen::AlignedBox3d box;

    void add(const Cloud& cloud, const std::array<std::uint32_t, 3>& face, const std::vector<std::uint32_t>& firsts) {
        std::array<Vec3d, 3> at;
        for (int i = 0; i < 3; ++i) box.extend(at[i] = cloud.positions[face[i]].cast<double>());
        const Vec3d u = at[1] - at[0], v = at[2] - at[0], cross = u.cross(v);
        const double longest = std::max({u.norm(), v.norm(), (v - u).norm()}), twice_area = cross.stableNorm();
        ++faces;
        flat += twice_area == 0;
        if (twice_area == 0) return;
        double sine = 0; // mean over the corners of the sine between face and disc
        for (const std::uint32_t corner : face) {
            const Vec3d normal = cloud.normals[firsts[corner]].cast<double>().stableNormalized();
            sine += normal.cross(cross / twice_area).norm() / 3;
        }
        area += twice_area / 2;
        area_times_edge += twice_area / 2 * longest;
        area_times_stand_off += twice_area / 2 * longest * kRadiusOverEdge * sine;
    }
    double diagonal() const { return box.isEmpty() ? 0 : box.diagonal().norm(); }
    /// Whether discs at the vertices would not represent the surface: too few, or too far from the faces.
    bool areCoarse() const {
        return area > 0 && (area_times_edge > kCoarseEdge * diagonal() * area ||
                            area_times_stand_off > kStandOff * diagonal() * area);
    }
};

std::vector<FaceSizes> faceSizes(const Cloud& cloud, const std::vector<ScanRange>& scans) {
    const std::vector<std::uint32_t> firsts = firstsAtPositions(cloud);
    std::vector<FaceSizes> sizes(scans.size());
    for (const auto& face : cloud.triangles) sizes[scanOf(scans, face[0])].add(cloud, face, firsts);
    for (const std::uint32_t corner : cornersOf(cloud)) ++sizes[scanOf(scans, corner)].corners;
    return sizes;
}

/// The number of samples that gives all of these meshes the same spacing, since one picture shows them all.
double samplesFor(const std::vector<FaceSizes>& sizes, const std::vector<bool>& sampled) {
    FaceSizes all;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        if (!sampled[i]) continue;
        all.area += sizes[i].area;
        all.corners += sizes[i].corners;
        all.box.extend(sizes[i].box);
    }
    const double across = kSamplesAcross / all.diagonal();
    const double enough = std::max(all.area * across * across, kSamplesPerVertex * double(all.corners));
    return std::clamp(std::round(enough), kLeastSamples, kMostSamples);
}

/// [scans], true: a face has a texture.
std::vector<bool> texturedScans(const Cloud& cloud, const std::vector<ScanRange>& scans, const MeshPaint& paint) {
    std::vector<bool> textured(scans.size());
    for (std::size_t i = 0; i < paint.faces.size(); ++i)
        if (paint.faces[i].picture < FacePaint::kPlain) textured[scanOf(scans, cloud.triangles[i][0])] = true;
    return textured;
}

/// Selects the meshes whose vertices do not represent their surface, with a note for each.
MeshSampling chooseCoarse(Cloud& cloud, const std::vector<ScanRange>& scans, const MeshPaint& paint) {
    const std::vector<FaceSizes> sizes = faceSizes(cloud, scans);
    const std::vector<bool> textured = texturedScans(cloud, scans, paint);
    MeshSampling sampling{std::vector<bool>(scans.size())};
    for (std::size_t i = 0; i < scans.size(); ++i) {
        const bool few = kFewFaces * sizes[i].corners < scans[i].position_count;
        const bool coarse = sizes[i].areCoarse() || (textured[i] && sizes[i].area > 0);
        sampling.scans[i] = coarse && !few && kSamplesPerVertex * double(sizes[i].corners) < kMostSamples;
    }
    if (std::find(sampling.scans.begin(), sampling.scans.end(), true) == sampling.scans.end()) return sampling;
    sampling.points = std::uint64_t(samplesFor(sizes, sampling.scans));
    for (std::size_t i = 0; i < scans.size(); ++i) {
        if (!sampling.scans[i]) continue;
        const std::string flat = sizes[i].flat > 0 ? fmt::format(", but {} without area", sizes[i].flat) : "";
        addNote(cloud, scans[i].name,
                fmt::format("its {} vertices are too few for its {}: points are sampled over the faces{}; "
                            "--sample N samples N, --sample 0 uses the vertices",
                            sizes[i].corners, sizes[i].areCoarse() ? "faces" : "textures", flat));
    }
    return sampling;
}

} // namespace

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
            if (cell < RangeGrid::kFilteredOut) cell = keep[cell] ? renumbered[cell] : RangeGrid::kFilteredOut;
    keepFlagged(cloud.positions, keep);
    keepFlagged(cloud.normals, keep);
    keepFlagged(cloud.colors, keep);
    keepFlagged(cloud.sensor_of_point, keep);
    keepFlagged(cloud.radii, keep);
    for (Attribute& attribute : cloud.attributes) keepFlaggedValues(attribute, keep);
}

std::size_t scanOf(const std::vector<ScanRange>& scans, std::size_t point) {
    const auto after =
        std::upper_bound(scans.begin(), scans.end(), point,
                         [](std::size_t index, const ScanRange& scan) { return index < scan.first_position; });
    return static_cast<std::size_t>(after - scans.begin()) - 1;
}

MeshSampling chooseSampling(Cloud& cloud, const std::vector<ScanRange>& scans, std::optional<std::uint64_t> count,
                            const MeshPaint& paint) {
    if (!count && !cloud.triangles.empty()) return chooseCoarse(cloud, scans, paint);
    MeshSampling sampling{std::vector<bool>(scans.size()), count.value_or(0)};
    for (std::size_t i = 0; i < scans.size(); ++i) sampling.scans[i] = sampling.points > 0 && scans[i].has_faces;
    return sampling;
}

void dropUnused(Cloud& cloud, std::vector<ScanRange>& scans, const std::vector<std::uint32_t>& removed_corners,
                const std::vector<bool>& sampled) {
    if (cloud.triangles.empty()) return;
    std::vector<bool> keep = usedPoints(cloud, scans, removed_corners, sampled);
    std::size_t kept = 0;
    std::vector<ScanRange> left = scans;
    for (std::size_t i = 0; i < scans.size(); ++i) {
        const ScanRange& scan = scans[i];
        const auto first = keep.begin() + static_cast<std::ptrdiff_t>(scan.first_position);
        const auto last = first + static_cast<std::ptrdiff_t>(scan.position_count);
        const auto used = static_cast<std::size_t>(std::count(first, last, true));
        const bool few = kFewFaces * used < scan.position_count;
        if (scan.has_faces && few)
            addNote(cloud, scan.name,
                    fmt::format("its faces use only {} of {} points; {}", used, scan.position_count,
                                sampled[i] ? "the others are not sampled" : "the others are kept as points"));
        if (scan.has_faces && (sampled[i] || !few)) cloud.points_unused += scan.position_count - used;
        if (!scan.has_faces || sampled[i] || few) std::fill(first, last, true);
        left[i].first_position = kept;
        left[i].position_count = static_cast<std::size_t>(std::count(first, last, true));
        kept += left[i].position_count;
    }
    if (kept == cloud.positions.size()) return;
    keepPoints(cloud, keep);
    scans = std::move(left);
}

} // namespace pointrt
