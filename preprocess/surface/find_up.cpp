// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/find_up.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>

#include "preprocess/surface/footprint.h"
#include "preprocess/surface/surface_sample.h"

namespace pointrt {
namespace upright {
namespace {

/// A direction that may be up, with measures of the surface for it.
struct Candidate {
    Vec3d up;
    Footprint below, above; ///< upright, and upside down
    double along = 0, across = 0;
    bool is_axis = false;
};

struct Evidence {
    const Splats& splats;
    SurfaceSample sample;
    std::vector<Vec3d> sensors; ///< distinct, relative to the splats' origin
    std::vector<Candidate> candidates;
};

using Answer = std::optional<Vec3d>;

bool isParallel(const Vec3d& a, const Vec3d& b) { return std::abs(a.dot(b)) > 0.87; } // 30 degrees

/// The maximum of a measure over candidates not parallel to up.
template <typename Measure>
double mostAcross(const Evidence& evidence, const Vec3d& up, const Measure& measure) {
    double most = 0;
    for (const Candidate& each : evidence.candidates)
        if (!isParallel(each.up, up)) most = std::max(most, measure(each));
    return most;
}

const Candidate& along(const Evidence& evidence, const Vec3d& axis) {
    return *std::find_if(evidence.candidates.begin(), evidence.candidates.end(),
                         [&](const Candidate& each) { return each.up == axis; });
}

/// Files of depth cameras are in the camera's frame: x to the right, y down and z ahead or, as in OpenGL, y up and z
/// behind.
Answer fromCamera(const Evidence& evidence) {
    if (evidence.sensors.size() != 1) return {};
    const Vec3d camera = evidence.sensors[0], ahead = evidence.sample.centroid - camera;
    const Vec3d in_input = camera + evidence.splats.origin;
    const double distance = ahead.norm();
    if (!(distance > 0) || in_input.head<2>().norm() > 0.1 * distance) return {};
    const double side = ahead.z() / distance;
    if (std::abs(side) < std::cos(0.6)) return {}; // 35 degrees: half of the frame may be empty
    double outside = 0;
    for (std::size_t i = 0; i < evidence.sample.positions.size(); ++i) {
        const Vec3d to = evidence.sample.positions[i] - camera;
        // 60 degrees: no depth camera has a wider field of view
        if (to.z() * (side > 0 ? 1 : -1) < 0.5 * to.norm()) outside += evidence.sample.areas[i];
    }
    if (outside > 0.01) return {};
    return side > 0 ? Vec3d(-Vec3d::UnitY()) : Vec3d(Vec3d::UnitY());
}

/// The axis within 8 degrees, otherwise the direction itself; on the positive side of the axis.
Vec3d snappedToAxis(Vec3d direction) {
    int axis = 0;
    const double along = direction.cwiseAbs().maxCoeff(&axis);
    if (direction[axis] < 0) direction = -direction;
    return along > 0.99 ? Vec3d(Vec3d::Unit(axis)) : direction;
}

/// Tripods are on level ground; turntables rotate about the vertical.
Answer fromStations(const Evidence& evidence) {
    if (evidence.sensors.size() < 4) return {};
    Vec3d mean = Vec3d::Zero();
    for (const Vec3d& sensor : evidence.sensors) mean += sensor / double(evidence.sensors.size());
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Vec3d& sensor : evidence.sensors) spread += (sensor - mean) * (sensor - mean).transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
    const Vec3d width = axes.eigenvalues().cwiseMax(0).cwiseSqrt();
    // as flat as level ground; not in a row, which is in many planes
    if (!(width[0] < 0.05 * width[1] && width[1] > 0.3 * width[2])) return {};
    return snappedToAxis(axes.eigenvectors().col(0));
}

/// Too flat for its sides to differ.
bool isSheet(const Candidate& each) { return each.below.height < 0.02; }

/// Never x: walls scanned alone would qualify.
bool mayBeGround(const Candidate& each) { return !(each.is_axis && std::abs(each.up.x()) > 0.5); }

/// Has a floor on one side and a ceiling on the other.
bool isRoom(const Candidate& each) { return each.below.floor >= 0.3 && each.above.floor >= 0.3; }

/// Rooms are not decided here: in a scan from inside, the ceiling may be more complete than the floor.
Answer fromGround(const Evidence& evidence) {
    for (const Candidate& each : evidence.candidates) {
        const Footprint &below = each.below, &above = each.above;
        const bool one_sided = below.level - above.level >= 0.25 || below.floor - above.floor >= 0.3;
        // a tower may be flat on top, but is not ground
        const bool flat = below.height < 0.5 || (below.height < 1 && below.floor >= 0.3);
        if (!mayBeGround(each) || isRoom(each) || !(below.level >= 0.6) || !one_sided || !flat || isSheet(each))
            continue;
        if (mostAcross(evidence, each.up, [](const Candidate& other) { return other.below.level; }) > below.level - 0.2)
            continue;
        return each.up;
    }
    return {};
}

/// Most of the contents of a room are on its floor.
Answer fromRoom(const Evidence& evidence) {
    constexpr double kShelves = 0.03, kMoreLevel = 1.4, kAsMuch = 0.02;
    for (const Candidate& each : evidence.candidates) {
        if (!isRoom(each) || each.below.shelves < kShelves) continue;
        if (mostAcross(evidence, each.up, [](const Candidate& other) { return other.along; }) * kMoreLevel > each.along)
            continue;
        const bool turned = each.below.middle > 0.5 + kAsMuch;
        const bool undecided = !turned && each.below.middle > 0.5 - kAsMuch;
        if (turned || (undecided && each.up != Vec3d::UnitZ() && each.up != Vec3d::UnitY())) continue;
        return each.up;
    }
    return {};
}

Answer fromLevels(const Evidence& evidence) {
    const Candidate& z = along(evidence, Vec3d::UnitZ());
    const bool open = z.above.floor < 0.2 || z.below.floor < 0.2 || z.below.shelves > 0.03;
    const double others = mostAcross(evidence, z.up, [](const Candidate& each) { return each.along; });
    if (!(z.along >= 0.3 && z.along >= 2 * others && z.across >= 0.15 && open)) return {};
    return z.up;
}

/// Map projections, and site coordinates in metres from a local origin.
Answer fromMap(const Evidence& evidence) {
    const Vec3d centre = evidence.splats.origin + evidence.sample.centroid;
    const double away = centre.head<2>().norm();
    if (!(away > 3 * evidence.sample.extent.maxCoeff() && std::abs(centre.z()) < away / 3)) return {};
    return Vec3d::UnitZ();
}

Answer fromTerrain(const Evidence& evidence) {
    constexpr double kWide = 50; // metres or feet: reliefs are not as wide
    const Candidate& z = along(evidence, Vec3d::UnitZ());
    const double others = mostAcross(evidence, z.up, [](const Candidate& each) { return each.below.level; });
    const double wide = evidence.sample.extent.head<2>().maxCoeff();
    if (!(std::min(z.below.level, z.above.level) >= 0.65 && others < 0.4 && z.below.height < 0.34 && wide > kWide))
        return {};
    return z.up;
}

/// Floors and ceilings of a building whose y is up. Facades and corridors, whose walls may have most of their surface,
/// are shallow along y, or have nothing between the walls.
Answer fromStoreys(const Evidence& evidence) {
    constexpr double kMost = 0.3, kWalls = 0.3, kBetween = 0.2, kLevel = 0.5, kDeep = 0.15, kTower = 1;
    const Candidate& y = along(evidence, Vec3d::UnitY());
    const double others = mostAcross(evidence, y.up, [](const Candidate& each) { return each.along; });
    const bool is_layered = y.below.shelves >= kBetween && std::min(y.below.level, y.above.level) >= kLevel;
    const bool is_deep = y.below.height >= kDeep && y.below.height < kTower;
    if (!(y.along >= kMost && y.along >= 2 * others && y.across >= kWalls && is_layered && is_deep)) return {};
    return y.up;
}

/// The candidate on which the object stands best.
struct Base {
    const Candidate *best = nullptr, *opposite = nullptr;
    double support = 0, across = 0, beneath = 0; ///< support of the best, of those across it, of its opposite
};

Base bestBase(const Evidence& evidence, bool axes_only) {
    Base base;
    std::vector<std::pair<const Candidate*, double>> supports;
    for (const Candidate& each : evidence.candidates)
        if (!isSheet(each) && (each.is_axis || !axes_only))
            supports.emplace_back(&each, supportOf(evidence.sample, each.up));
    for (const auto& [candidate, support] : supports)
        if (!base.best || support > base.support) base.best = candidate, base.support = support;
    for (const auto& [candidate, support] : supports) {
        if (!isParallel(candidate->up, base.best->up)) base.across = std::max(base.across, support);
        if (candidate->up == -base.best->up) base.opposite = candidate, base.beneath = support;
    }
    return base;
}

/// No program puts up along x or -z; pieces of terrain and trees may still stand best on such a side.
Answer ifCustomary(const Vec3d& up) { return std::abs(up.x()) == 1 || up.z() == -1 ? Answer() : Answer(up); }

Answer fromBase(const Evidence& evidence) {
    constexpr double kLeast = 0.25, kClear = 1.6, kTwice = 2;
    Base base = bestBase(evidence, true);
    if (base.support < kLeast) base = bestBase(evidence, false);
    if (!base.best || base.support < kLeast || base.support < kClear * base.across) return {};
    if (base.support >= kTwice * base.beneath) return ifCustomary(base.best->up);
    // stands on both ends: a flat base beats three tips
    const bool turned = base.opposite->below.level > base.best->below.level;
    const Candidate &flatter = turned ? *base.opposite : *base.best, &other = turned ? *base.best : *base.opposite;
    if (flatter.below.level < kLeast || flatter.below.level < kTwice * other.below.level) return {};
    return ifCustomary(flatter.up);
}

Answer fromPole(const Evidence& evidence) {
    const Candidate& z = along(evidence, Vec3d::UnitZ());
    const double others = mostAcross(evidence, z.up, [](const Candidate& each) { return each.across; });
    if (!(z.across >= 0.6 && others <= 0.5 * z.across && z.below.height > 2)) return {};
    return z.up;
}

void addCandidates(Evidence& evidence) {
    std::vector<Vec3d> directions{Vec3d::UnitZ(), Vec3d::UnitY(), Vec3d::UnitX()};
    for (const Vec3d& plane : slantedPlanes(evidence.sample)) directions.push_back(plane);
    for (const Vec3d& direction : directions) {
        const bool is_axis = direction.cwiseAbs().maxCoeff() == 1;
        const Footprint below = footprintOf(evidence.sample, direction);
        const Footprint above = footprintOf(evidence.sample, -direction);
        const double along = shareAlong(evidence.sample, direction), across = shareAcross(evidence.sample, direction);
        evidence.candidates.push_back({direction, below, above, along, across, is_axis});
        evidence.candidates.push_back({-direction, above, below, along, across, is_axis});
    }
}

std::vector<Vec3d> distinctSensors(const std::vector<Scan>& scans, const Vec3d& origin) {
    std::vector<Vec3d> sensors;
    for (const Scan& scan : scans) {
        if (!scan.sensor) continue;
        const Vec3d place = *scan.sensor - origin;
        if (std::find(sensors.begin(), sensors.end(), place) == sensors.end()) sensors.push_back(place);
    }
    return sensors;
}

constexpr struct {
    Answer (*infer)(const Evidence&);
    const char* reason;
} kRules[] = {
    {fromCamera, "camera frame"},    {fromStations, "scanner positions"},  {fromGround, "ground"},
    {fromRoom, "floor and ceiling"}, {fromLevels, "level surfaces"},       {fromMap, "map coordinates"},
    {fromTerrain, "terrain"},        {fromStoreys, "floors and ceilings"}, {fromBase, "stable base"},
    {fromPole, "vertical pole"},
};

/// Flat, and level on both sides.
bool liesFlat(const Candidate& each) {
    constexpr double kFlat = 0.25, kLevel = 0.6; // the front of a face is twice as deep, and less level
    return each.below.height < kFlat && std::min(each.below.level, each.above.level) >= kLevel;
}

/// The front of an object as cameras that look along z see it: none of its surface is upright for z, much of it is for
/// y, and it is too deep for ground.
bool facesAlong(const Candidate& z, const Candidate& y) {
    constexpr double kUpright = 0.3, kHardly = 0.1, kLevel = 0.15, kDeep = 0.4;
    return y.across >= kUpright && z.across <= kHardly && z.along <= kLevel && z.below.height >= kDeep;
}

FoundUp guess(const Evidence& evidence, bool is_mesh) {
    const Candidate &z = along(evidence, Vec3d::UnitZ()), &y = along(evidence, Vec3d::UnitY());
    if (!is_mesh && facesAlong(z, y)) return {Vec3d::UnitY(), UpBasis::kGuess, "as it faces along z"};
    if (!is_mesh) return {Vec3d::UnitZ(), UpBasis::kGuess, "as in most point clouds"};
    if (liesFlat(z) && !liesFlat(y)) return {Vec3d::UnitZ(), UpBasis::kGuess, "it lies flat"};
    return {Vec3d::UnitY(), UpBasis::kGuess, "as in most meshes"};
}

} // namespace
} // namespace upright

const char* nameOf(UpBasis basis) {
    switch (basis) {
    case UpBasis::kData:
        return "data";
    case UpBasis::kCustom:
        return "format";
    default:
        return "guess";
    }
}

FoundUp findUp(const Splats& splats, const std::vector<Scan>& scans, const UpPrior& prior) {
    using namespace upright;
    Evidence evidence{splats, sampleSurface(splats), distinctSensors(scans, splats.origin), {}};
    const FoundUp custom{prior.custom, UpBasis::kCustom, "as usual in this format"};
    const bool has_custom = !prior.custom.isZero();
    if (evidence.sample.positions.empty()) return has_custom ? custom : FoundUp{};
    addCandidates(evidence);
    if (has_custom && fromMap(evidence) == prior.custom) return custom;
    for (const auto& rule : kRules)
        if (const Answer up = rule.infer(evidence))
            return {*up + Vec3d::Zero(), UpBasis::kData, rule.reason}; // turns -0 into 0
    return has_custom ? custom : guess(evidence, prior.is_mesh);
}

} // namespace pointrt
