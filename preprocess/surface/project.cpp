// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/project.h"

#include <algorithm>
#include <cmath>

#include "preprocess/surface/quadric.h"

namespace pointrt::surface {
namespace {

/// Reach of smoothing in spacings, for a noise of one spacing: it grows with the root of the noise, as what noise
/// leaves of a mean falls with the number of points while what curvature takes grows with the reach squared. Between 15
/// and 25 times sqrt(0.34) spacings, the Dragon's, the result is the same to 1%; 10 is the least of those.
constexpr float kReach = 10;
/// 28 neighbours, for the 6 terms of a quadric, and 113.
constexpr float kLeastSpacings = 3, kMostSpacings = 6;

constexpr int kRounds = 2; // a third changes nothing, one leaves a sixth more pixels off in depth

/// Neighbours further than this many sigma from the point's own tangent plane, and from the first sphere, have hardly
/// any say: wide enough for a plane that is off, then for the noise itself. 2 to 4 for the second give the same.
constexpr float kFirstScale = 7, kSecondScale = 3;

/// Nobody moves further than this many sigma: registration errors are three or four.
constexpr float kMostMove = 8;

/// Least share of the neighbours within so many sigma of the surface, in the mean over a point's surroundings. Of
/// Gaussian noise that is 0.86; of the noisiest surfaces nine in ten have more than 0.65, and of points strewn through
/// space, as leaves are, the median is 0.4: those stay where they are.
constexpr float kWithin = 1.5f, kLeastSupport = 0.48f;

/// Cosine of 32 degrees: a point whose quadric's normal is off its sphere's by more is on no surface.
constexpr float kLostCosine = 0.85f;

float reachOf(float sigma, float spacing) {
    return std::clamp(kReach * std::sqrt(sigma * spacing), kLeastSpacings * spacing, kMostSpacings * spacing);
}

std::vector<float> reachesOf(const NeighborLists& lists, const std::vector<float>& sigma, float strength) {
    std::vector<float> reaches(sigma.size(), 0);
    for (std::size_t i = 0; i < reaches.size(); ++i)
        if (sigma[i] > 0) reaches[i] = strength * reachOf(sigma[i], lists.spacings[i]);
    return reaches;
}

/// The sphere around a point, from its own tangent plane on. Lengths in the point's reach.
AlgebraicSphere robustSphere(const Surroundings& around, const Vec3f& normal, float sigma) {
    const AlgebraicSphere first = fitSphere(around, AlgebraicSphere::plane(normal), kFirstScale * sigma);
    return fitSphere(around, first, kSecondScale * sigma);
}

/// Back towards where the point was read.
Vec3f bounded(const Vec3f& place, const Vec3f& start, float most) {
    const Vec3f move = place - start;
    const float length = move.norm();
    return length > most ? Vec3f(start + move * (most / length)) : place;
}

template <typename Body>
void forSurroundings(const Points& points, const std::vector<Vec3f>& places, const NearestSearch& search,
                     const std::vector<float>& reaches, const StageShare& share, const Body& body) {
    forRanges(Gatherer::blockCount(points.size()), share, [&](std::size_t begin, std::size_t end) {
        Gatherer gatherer(points, places, search, reaches);
        for (std::size_t block = begin; block < end; ++block) gatherer.forBlock(block, body);
    });
}

/// Points on the way to the surface.
struct Projection {
    Points& points;
    const std::vector<float>& sigma;
    std::vector<float> reaches;       ///< 0: stays
    const std::vector<Vec3f>& places; ///< where they were read
    std::vector<float> support;       ///< [points], share of the surroundings on the surface; 1 of those that stay
};

/// judge: whether support is asked for, once.
void moveOnce(Projection& job, const NearestSearch& search, bool judge, const StageShare& share) {
    const Points& points = job.points;
    std::vector<Vec3f> moved = points.positions, normals = points.normals;
    forSurroundings(points, job.places, search, job.reaches, share, [&](std::size_t i, const Surroundings& around) {
        const float unit = job.reaches[i];
        const AlgebraicSphere sphere = robustSphere(around, points.normals[i], job.sigma[i] / unit);
        if (judge) job.support[i] = supportOf(around, sphere, kWithin * job.sigma[i] / unit);
        moved[i] = bounded(points.positions[i] + projectOrigin(sphere) * unit, job.places[i], kMostMove * job.sigma[i]);
        const Vec3f normal = normalAtOrigin(sphere);
        normals[i] = normal.dot(points.normals[i]) > 0 ? normal : Vec3f(-normal);
    });
    job.points.positions = std::move(moved);
    job.points.normals = std::move(normals);
}

/// Puts back what has moved though it is scattered in space. Not by its own support: what lies off a surface has little
/// of it too, and belongs there. Returns the mean support around those that moved, 0 of the others.
std::vector<float> leaveScattered(Projection& job, const NeighborLists& lists, const std::vector<Vec3f>& normals) {
    const StageProgress silent;
    std::vector<float> means(job.support.size());
    forEach(job.support.size(), {silent, ""}, [&](std::size_t i) {
        float sum = job.support[i];
        for (const std::uint32_t neighbor : lists.of(i)) sum += job.support[neighbor];
        means[i] = job.reaches[i] > 0 ? sum / float(lists.k + 1) : 0;
        if (means[i] >= kLeastSupport) return;
        means[i] = 0;
        job.reaches[i] = 0;
        job.points.positions[i] = job.places[i];
        job.points.normals[i] = normals[i];
    });
    return means;
}

/// Normals, and what is left of the noise.
void refit(Projection& job, const NearestSearch& search, const StageShare& share, ProjectionReport& report) {
    const Points& points = job.points;
    std::vector<Vec3f> normals = points.normals;
    forSurroundings(points, job.places, search, job.reaches, share, [&](std::size_t i, const Surroundings& around) {
        const Vec3f& normal = points.normals[i];
        const TangentFrame frame(normal);
        const float scale = kFirstScale * job.sigma[i] / job.reaches[i];
        const std::optional<QuadricFit> fit = fitQuadric(around, frame, AlgebraicSphere::plane(normal), scale);
        report.sigma[i] = fit ? std::sqrt(fit->variance) * job.reaches[i] : job.sigma[i];
        if (fit) normals[i] = normalOf(fit->terms, frame);
        report.lost[i] = normals[i].dot(normal) < kLostCosine;
    });
    job.points.normals = std::move(normals);
}

} // namespace

ProjectionReport projectPoints(Points& points, const NeighborLists& lists, const NearestSearch& search,
                               const std::vector<float>& sigma, float strength, const StageShare& share) {
    const std::size_t count = points.size();
    // search goes on in the memory that it was made over
    const std::vector<Vec3f> places = std::move(points.positions);
    points.positions = places;

    Projection job{points, sigma, reachesOf(lists, sigma, strength), places, std::vector<float>(count, 1)};
    const double step = (share.to - share.from) / (kRounds + 1);
    const auto part = [&](int number) {
        return StageShare{share.progress, share.stage, share.from + step * number, share.from + step * (number + 1)};
    };
    const std::vector<Vec3f> normals = points.normals;
    moveOnce(job, search, true, part(0));
    ProjectionReport report;
    report.support = leaveScattered(job, lists, normals);
    for (int round = 1; round < kRounds; ++round) moveOnce(job, search, false, part(round));
    report.lost.assign(count, 0);
    report.sigma = sigma;
    refit(job, search, part(kRounds), report);
    for (std::size_t i = 0; i < count; ++i) report.moved += places[i] != points.positions[i];
    return report;
}

} // namespace pointrt::surface
