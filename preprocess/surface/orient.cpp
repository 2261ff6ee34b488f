// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/orient.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <tbb/parallel_for.h>

#include "format/base/error.h"
#include "preprocess/cloud/per_thread.h"
#include "preprocess/surface/components.h"
#include "preprocess/surface/orient_tree.h"

namespace pointrt::surface {
namespace {

using Flags = std::vector<std::uint8_t>;

/// CGAL's tree takes 7 us (13 us at 1 M points) and 1.5 KB per point, on one core. Up to this many points, that is less
/// than a second and 150 MB; above, Kruskal's algorithm finds the same tree over our own neighbours six times faster.
constexpr std::size_t kCgalPoints = 100'000;

void requireSensors(const PointSet& points) {
    std::size_t missing = 0;
    for (std::size_t i = 0; i < points.size(); ++i) missing += points.sensorOf(i) == nullptr;
    if (missing == 0) return;
    throw Error{ExitCode::kBadInput,
                std::to_string(missing) + " of " + std::to_string(points.size()) + " points have no sensor position"};
}

/// +Z if unknown, as in scanner coordinates.
Vec3f upOf(const PointSet& points) { return points.up.isZero() ? Vec3f(Vec3f::UnitZ()) : points.up; }

/// Turns a normal towards a direction. Returns whether its side is certain: not at a grazing angle, where the error of
/// the normal itself (rarely above 11 degrees, sine 0.2) may decide.
bool faceTowards(PointSet& points, std::size_t i, const Vec3f& direction) {
    constexpr float kGrazing = 0.2f;
    const float cosine = points.normals[i].dot(direction);
    if (cosine < 0) points.normals[i] = -points.normals[i];
    return std::abs(cosine) > kGrazing;
}

/// As faceTowards, for the point's sensor; false if there is none.
bool faceSensor(PointSet& points, std::size_t i) {
    const Vec3f* sensor = points.sensorOf(i);
    return sensor != nullptr && faceTowards(points, i, (*sensor - points.positions[i]).stableNormalized());
}

/// Turns the other normals to their sensors. Returns flags of known sides.
Flags faceSensors(PointSet& points, const Flags& given) {
    Flags known = given;
    for (std::size_t i = 0; i < known.size(); ++i)
        if (!known[i]) known[i] = faceSensor(points, i);
    return known;
}

Flags faceUp(PointSet& points, const Flags& given) {
    const Vec3f up = upOf(points);
    Flags known = given;
    for (std::size_t i = 0; i < known.size(); ++i)
        if (!known[i]) known[i] = faceTowards(points, i, up);
    return known;
}

/// Turns all normals whose side the mode decides without neighbours. Returns flags of known sides.
Flags turnKnown(PointSet& points, OrientMode mode) {
    const Flags& given = points.side_known;
    const Flags nothing(points.size(), 0);
    if (mode == OrientMode::kMst) return nothing;
    if (mode == OrientMode::kUp) return faceUp(points, nothing);
    const bool above = points.sensors.empty() && points.from_above;
    if (mode == OrientMode::kAuto && above) return faceUp(points, given);
    return faceSensors(points, mode == OrientMode::kAuto ? given : nothing);
}

/// Sums over a component that decide which side is out.
struct Component {
    bool has_known_side = false;
    std::uint32_t top = 0; ///< the highest point
    double area = 0;
    Vec3d centroid = Vec3d::Zero(); ///< times area until finished
    double outward = 0;             ///< integral of normal . (position - centroid)
    double outward_limit = 0;       ///< the same if every normal pointed away from the centroid
    double upward = 0;              ///< integral of normal . up
};

/// Connected components of the graph.
struct Components {
    std::vector<std::uint32_t> of_point;
    std::vector<Component> all;
};

Components findComponents(const NeighborLists& lists, std::size_t count) {
    SharedSets sets(count);
    tbb::parallel_for(std::size_t(0), count, [&](std::size_t i) {
        for (const std::uint32_t neighbor : lists.of(i)) sets.join(std::uint32_t(i), neighbor);
    });
    Components components;
    components.of_point.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t lowest = sets.find(i);
        if (lowest == i) components.all.emplace_back().top = i;
        components.of_point[i] = lowest == i ? std::uint32_t(components.all.size() - 1) : components.of_point[lowest];
    }
    return components;
}

double areaOf(const NeighborLists& lists, std::size_t point) {
    return double(lists.spacings[point]) * double(lists.spacings[point]);
}

void placeComponents(Components& components, const PointSet& points, const NeighborLists& lists, const Flags& known) {
    const Vec3f up = upOf(points);
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        Component& component = components.all[components.of_point[i]];
        component.has_known_side |= known[i] != 0;
        if (points.positions[i].dot(up) > points.positions[component.top].dot(up)) component.top = i;
        const double area = areaOf(lists, i);
        component.area += area;
        component.centroid += area * points.positions[i].cast<double>();
    }
    for (Component& component : components.all) component.centroid /= component.area;
}

/// Adds a source for each component without a known side: its highest point, facing up, as CGAL does.
Flags addSources(const Components& components, PointSet& points, Flags known) {
    const Vec3f up = upOf(points);
    for (const Component& component : components.all) {
        if (component.has_known_side) continue;
        known[component.top] = 1;
        Vec3f& normal = points.normals[component.top];
        if (normal.dot(up) < 0) normal = -normal;
    }
    return known;
}

void measureSides(Components& components, const PointSet& points, const NeighborLists& lists) {
    const Vec3d up = upOf(points).cast<double>();
    for (std::size_t i = 0; i < points.size(); ++i) {
        Component& component = components.all[components.of_point[i]];
        const Vec3d offset = points.positions[i].cast<double>() - component.centroid;
        const Vec3d normal = points.normals[i].cast<double>() * areaOf(lists, i);
        component.outward += normal.dot(offset);
        component.outward_limit += areaOf(lists, i) * offset.norm();
        component.upward += normal.dot(up);
    }
}

/// For a closed surface, the outward integral is three times its volume and the upward one vanishes (Gauss); for open
/// ground it is the other way round. The one nearer to its limit decides.
bool facesInwards(const Component& component) {
    const double outward = component.outward / component.outward_limit, upward = component.upward / component.area;
    return std::abs(outward) > std::abs(upward) ? outward < 0 : upward < 0;
}

void turnComponents(Components& components, PointSet& points, const NeighborLists& lists) {
    measureSides(components, points, lists);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Component& component = components.all[components.of_point[i]];
        if (!component.has_known_side && facesInwards(component)) points.normals[i] = -points.normals[i];
    }
}

/// Votes for pairs of components: above 0 they agree on the outside, below 0 one has to be flipped.
using SheetVotes = std::map<std::pair<std::uint32_t, std::uint32_t>, int>;

/// Votes of a point that has another component a few spacings away along its normal.
void voteAt(std::uint32_t point, const Components& components, const PointSet& points, const NearestSearch& search,
            SheetVotes& votes) {
    constexpr std::size_t kAround = 64; // up to 4.5 spacings away
    std::array<std::uint32_t, kAround> found;
    std::array<float, kAround> squared;
    const std::uint32_t own = components.of_point[point];
    const std::size_t count = search.nearest(points.positions[point], found, squared);
    for (std::size_t k = 0; k < count; ++k) {
        const std::uint32_t other = components.of_point[found[k]];
        if (other == own) continue;
        const Agreement agreement = agreementOf(points, point, found[k]);
        if (agreement.sheets) votes[std::minmax(own, other)] += agreement.opposite ? -1 : 1;
    }
}

/// Votes of sampled points. Skips the points of the component with the largest area: the other one of each pair votes.
SheetVotes voteOnSheets(const Components& components, const PointSet& points, const NearestSearch& search) {
    constexpr std::size_t kStep = 16; // samples one point in this many
    const auto by_area = [](const Component& a, const Component& b) { return a.area < b.area; };
    const auto largest =
        std::uint32_t(std::max_element(components.all.begin(), components.all.end(), by_area) - components.all.begin());
    tbb::enumerable_thread_specific<SheetVotes> votes_of_threads;
    tbb::parallel_for(std::size_t(0), (points.size() + kStep - 1) / kStep, [&](std::size_t sample) {
        const auto point = std::uint32_t(sample * kStep);
        if (components.of_point[point] != largest) voteAt(point, components, points, search, votes_of_threads.local());
    });
    SheetVotes votes;
    for (const SheetVotes& some : votes_of_threads)
        for (const auto& [pair, vote] : some) votes[pair] += vote;
    return votes;
}

/// Sets of components back to back. Element components.all.size() represents known sides.
ParitySets setsOfSheets(const Components& components, const SheetVotes& votes) {
    std::vector<std::pair<int, std::pair<std::uint32_t, std::uint32_t>>> clearest;
    for (const auto& [pair, vote] : votes)
        if (vote != 0) clearest.push_back({-std::abs(vote), pair});
    std::sort(clearest.begin(), clearest.end());
    const auto known = std::uint32_t(components.all.size());
    ParitySets sets(known + 1);
    for (std::uint32_t i = 0; i < known; ++i)
        if (components.all[i].has_known_side) sets.join(known, i, false);
    for (const auto& [weight, pair] : clearest) sets.join(pair.first, pair.second, votes.at(pair) < 0);
    return sets;
}

/// Merges one component into another.
void absorb(Component& into, const Component& from) {
    const double area = into.area + from.area;
    into.centroid = (into.centroid * into.area + from.centroid * from.area) / area;
    into.area = area;
    into.has_known_side |= from.has_known_side;
}

/// Merges components back to back, and flips those that disagree.
void joinSheets(Components& components, PointSet& points, const NearestSearch& search) {
    if (components.all.size() < 2) return;
    const SheetVotes votes = voteOnSheets(components, points, search);
    if (votes.empty()) return;
    ParitySets sets = setsOfSheets(components, votes);
    const auto known = std::uint32_t(components.all.size());
    const auto [known_root, known_flipped] = sets.find(known);
    std::vector<std::uint8_t> flipped(known);
    std::vector<std::uint32_t> body(known), first(known + 1, known);
    for (std::uint32_t i = 0; i < known; ++i) {
        const auto [root, is_flipped] = sets.find(i);
        flipped[i] = is_flipped != (root == known_root && known_flipped);
        components.all[i].has_known_side |= root == known_root;
        if (first[root] == known)
            first[root] = i;
        else
            absorb(components.all[first[root]], components.all[i]);
        body[i] = first[root];
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        std::uint32_t& component = components.of_point[i];
        if (flipped[component]) points.normals[i] = -points.normals[i];
        component = body[component];
    }
}

/// Orients all normals without a known side.
void propagateSides(PointGraph& graph, const Flags& known, const StageShare& share) {
    PointSet& points = graph.points;
    const NeighborLists& lists = graph.lists;
    Components components = findComponents(lists, points.size());
    placeComponents(components, points, lists, known);
    const Flags sources = addSources(components, points, known);
    share.report(0.2); // of the time, as measured
    // CGAL does not handle edges between sheets
    const EdgeKinds kinds = edgeKinds(points, lists);
    if (points.size() <= kCgalPoints && !kinds.sheets)
        orientByCgal(points, lists, sources);
    else
        orientByKruskal(points, lists, kinds, sources);
    joinSheets(components, points, *graph.search);
    turnComponents(components, points, lists);
}

std::size_t countFlipped(const std::vector<Vec3f>& before, const std::vector<Vec3f>& after) {
    std::size_t flipped = 0;
    for (std::size_t i = 0; i < after.size(); ++i) flipped += before[i].dot(after[i]) < 0;
    return flipped;
}

} // namespace

OrientReport orientNormals(PointGraph& graph, OrientMode mode, const StageProgress& progress) {
    const StageShare share{progress, "orientation"};
    PointSet& points = graph.points;
    const auto all = [](const Flags& flags) { return std::find(flags.begin(), flags.end(), 0) == flags.end(); };
    if (mode == OrientMode::kNone) return {all(points.side_known), 0};
    if (mode == OrientMode::kSensor) requireSensors(points);

    const std::vector<Vec3f> before = points.normals;
    const Flags known = turnKnown(points, mode);
    if (mode != OrientMode::kSensor && !all(known)) propagateSides(graph, known, share);
    share.report(1);
    return {true, countFlipped(before, points.normals)};
}

} // namespace pointrt::surface
