// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/project.h"

#include <algorithm>
#include <cmath>

#include "preprocess/surface/quadric.h"

namespace pointrt::surface {
namespace {

/// Support radius in spacings, for a noise of one spacing. It grows with the root of the noise: the error that noise
/// leaves in a mean falls with the number of points, the bias from curvature grows with the radius squared. Factors of
/// 15 to 25 times sqrt(0.34) spacings, the Dragon's noise, give the same result to 1%; 10 is the least of those.
constexpr float kSupportRadius = 10;
/// Limits of the support radius: within 3 spacings are 28 neighbours, enough for the 6 terms of a quadric; within 6,
/// 113.
constexpr float kLeastSpacings = 3, kMostSpacings = 6;

constexpr int kRounds = 2; // a third changes nothing; with one, a sixth more pixels are off in depth

/// Neighbours further than this many sigma from the point's tangent plane, then from the first sphere, hardly count:
/// wide enough for a plane that is off, then for the noise itself. 2 to 4 for the second give the same result.
constexpr float kFirstScale = 7, kSecondScale = 3;

/// Limit of movement in sigma: registration errors are three or four.
constexpr float kMostMove = 8;

/// Least share of neighbours within kWithin sigma of the surface, on average around a point. For Gaussian noise it is
/// 0.86; nine in ten points of the noisiest surfaces have more than 0.65. The median of points scattered in space, such
/// as foliage, is 0.4: those stay where they are.
constexpr float kWithin = 1.5f, kLeastSupport = 0.48f;

/// Cosine of 32 degrees: a point is off the surface if the normals of its quadric and its sphere differ by more.
constexpr float kOffSurfaceCosine = 0.85f;

float supportRadius(float sigma, float spacing) {
    return std::clamp(kSupportRadius * std::sqrt(sigma * spacing), kLeastSpacings * spacing, kMostSpacings * spacing);
}

/// The support radius of each point; 0 for points without noise, which are not moved.
std::vector<float> supportRadii(const NeighborLists& lists, const std::vector<float>& sigma, float strength) {
    std::vector<float> radii(sigma.size(), 0);
    for (std::size_t i = 0; i < radii.size(); ++i)
        if (sigma[i] > 0) radii[i] = strength * supportRadius(sigma[i], lists.spacings[i]);
    return radii;
}

/// The sphere fitted around a point, starting from its tangent plane. Lengths in support radii.
AlgebraicSphere robustSphere(const Neighborhood& around, const Vec3f& normal, float sigma) {
    const AlgebraicSphere first = fitSphere(around, AlgebraicSphere::plane(normal), kFirstScale * sigma);
    return fitSphere(around, first, kSecondScale * sigma);
}

/// Limits the distance from start.
Vec3f bounded(const Vec3f& place, const Vec3f& start, float most) {
    const Vec3f move = place - start;
    const float length = move.norm();
    return length > most ? Vec3f(start + move * (most / length)) : place;
}

/// A projection in progress.
struct Projection {
    PointGraph& graph;
    const std::vector<Vec3f>& places; ///< positions before, over which graph.search was built
    std::vector<float> support_radii; ///< 0: the point stays
};

template <typename Body>
void forNeighborhoods(const Projection& job, const StageShare& share, const Body& body) {
    const PointSet& points = job.graph.points;
    forRanges(NeighborhoodGatherer::blockCount(points.size()), share, [&](std::size_t begin, std::size_t end) {
        NeighborhoodGatherer gatherer(points, job.places, *job.graph.search, job.support_radii);
        for (std::size_t block = begin; block < end; ++block) gatherer.forBlock(block, body);
    });
}

/// Moves each point onto the sphere around it.
/// @param support [points] or null: set to the share of the neighbourhood on that sphere, except for points that stay
void moveOnce(Projection& job, std::vector<float>* support, const StageShare& share) {
    PointSet& points = job.graph.points;
    std::vector<Vec3f> moved = points.positions, normals = points.normals;
    forNeighborhoods(job, share, [&](std::size_t i, const Neighborhood& around) {
        const float unit = job.support_radii[i], sigma = points.noise[i];
        const AlgebraicSphere sphere = robustSphere(around, points.normals[i], sigma / unit);
        if (support) (*support)[i] = supportOf(around, sphere, kWithin * sigma / unit);
        moved[i] = bounded(points.positions[i] + projectOrigin(sphere) * unit, job.places[i], kMostMove * sigma);
        const Vec3f normal = normalAtOrigin(sphere);
        normals[i] = normal.dot(points.normals[i]) > 0 ? normal : Vec3f(-normal);
    });
    points.positions = std::move(moved);
    points.normals = std::move(normals);
}

/// Moves points scattered in space back to where they were, with their normals: points whose support, averaged over
/// their neighbours, is low. A noisy point far from the surface has low support itself, but its neighbours do not.
/// Returns the average for points that have moved, 0 for others.
std::vector<float> putScatteredBack(Projection& job, const std::vector<float>& support,
                                    const std::vector<Vec3f>& normals) {
    const NeighborLists& lists = job.graph.lists;
    PointSet& points = job.graph.points;
    const StageProgress silent;
    std::vector<float> means(support.size());
    forEach(support.size(), {silent, ""}, [&](std::size_t i) {
        float sum = support[i];
        for (const std::uint32_t neighbor : lists.of(i)) sum += support[neighbor];
        means[i] = job.support_radii[i] > 0 ? sum / float(lists.k + 1) : 0;
        if (means[i] >= kLeastSupport) return;
        means[i] = 0;
        job.support_radii[i] = 0;
        points.positions[i] = job.places[i];
        points.normals[i] = normals[i];
    });
    return means;
}

/// Sets normals by quadrics, and noise to what these leave unexplained. Returns 1 for points off the surface.
std::vector<std::uint8_t> fitQuadrics(Projection& job, const StageShare& share) {
    PointSet& points = job.graph.points;
    std::vector<Vec3f> normals = points.normals;
    std::vector<std::uint8_t> off_surface(points.size(), 0);
    forNeighborhoods(job, share, [&](std::size_t i, const Neighborhood& around) {
        const Vec3f& normal = points.normals[i];
        const TangentFrame frame(normal);
        const float scale = kFirstScale * points.noise[i] / job.support_radii[i];
        const std::optional<QuadricFit> fit = fitQuadric(around, frame, AlgebraicSphere::plane(normal), scale);
        if (fit) points.noise[i] = std::sqrt(fit->variance) * job.support_radii[i];
        if (fit) normals[i] = normalOf(fit->terms, frame);
        off_surface[i] = normals[i].dot(normal) < kOffSurfaceCosine;
    });
    points.normals = std::move(normals);
    return off_surface;
}

} // namespace

ProjectionReport projectPoints(PointGraph& graph, float strength, const StageShare& share) {
    PointSet& points = graph.points;
    // the search keeps using the memory that it was built over
    const std::vector<Vec3f> places = std::move(points.positions);
    points.positions = places;

    Projection job{graph, places, supportRadii(graph.lists, points.noise, strength)};
    const double step = (share.to - share.from) / (kRounds + 1);
    const auto part = [&](int number) {
        return StageShare{share.progress, share.stage, share.from + step * number, share.from + step * (number + 1)};
    };
    const std::vector<Vec3f> normals = points.normals;
    std::vector<float> support(points.size(), 1);
    moveOnce(job, &support, part(0));
    points.support = putScatteredBack(job, support, normals);
    for (int round = 1; round < kRounds; ++round) moveOnce(job, nullptr, part(round));
    ProjectionReport report;
    report.off_surface = fitQuadrics(job, part(kRounds));
    for (std::size_t i = 0; i < points.size(); ++i) report.moved += places[i] != points.positions[i];
    graph.search.reset(); // its memory goes with places
    return report;
}

} // namespace pointrt::surface
