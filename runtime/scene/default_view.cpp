// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/default_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "runtime/scene/camera.h"
#include "runtime/scene/cells.h"
#include "runtime/scene/visibility.h"
#include "runtime/util/degree.h"

namespace pointrt {
namespace {

/// A three-quarter view from above: it shows the plan of a site and still the height of buildings.
constexpr double kSiteElevation = 35 * kDegree, kSiteAzimuth = 30 * kDegree;
/// Elevation of the view over walls: over a wall 3 m high, it shows the floor from 2.5 m behind the wall.
constexpr double kWalledElevation = 50 * kDegree;
/// Another side replaces the front if it shows this many times as much.
constexpr double kMuchMore = 1.3;
/// A range image: this share of the splats is within this angle of the line of sight.
constexpr double kFrameCosine = 0.34; // 70 degrees: the angle for a range image
constexpr double kFrameShare = 0.99;
/// Field of view inside rooms.
constexpr double kRoomFov_deg = 80;
constexpr std::size_t kMostPlaces = 16;

struct Ground {
    Vec3 up, front, right;
};

Ground groundOf(Vec3 up) {
    const Vec3 front = frontSide(up);
    return {up, front, cross(up, front)};
}

Vec3 sideAt(const Ground& ground, double azimuth, double elevation) {
    const Vec3 level = std::cos(azimuth) * ground.front + std::sin(azimuth) * ground.right;
    return std::cos(elevation) * level + std::sin(elevation) * ground.up;
}

ViewBasis basisFrom(const Ground& ground, Vec3 side) {
    const bool steep = std::abs(dot(side, ground.up)) > 0.999;
    return basisOf(-1.0 * side, steep ? -1.0 * ground.front : ground.up);
}

Vec3 centroidOf(const SceneSample& sample) {
    Vec3 sum;
    for (const SampledSplat& splat : sample.splats) sum = sum + splat.position;
    return (1.0 / static_cast<double>(sample.splats.size())) * sum;
}

Extent alongAxis(const SceneSample& sample, Vec3 axis) {
    std::vector<double> values;
    for (const SampledSplat& splat : sample.splats) values.push_back(dot(splat.position, axis));
    return extentOfMost(values);
}

/// The sample's height over its width.
double flatness(const SceneSample& sample, const Ground& ground) {
    const double width = std::max(alongAxis(sample, ground.front).size(), alongAxis(sample, ground.right).size());
    return width > 0 ? alongAxis(sample, ground.up).size() / width : std::numeric_limits<double>::infinity();
}

/// The share of the ground plan whose lowest surface is horizontal.
double levelGround(const SceneSample& sample, const Ground& ground) {
    constexpr int kCells = 16;
    constexpr double kLevel = 0.85; // 32 degrees: allows for slopes and noisy normals
    const Extent x = alongAxis(sample, ground.right), y = alongAxis(sample, ground.front);
    const double edge = std::max({x.size(), y.size(), std::numeric_limits<double>::min()}) / kCells;
    struct Cell {
        double lowest = std::numeric_limits<double>::infinity(), level = 0, whole = 0;
    };
    std::array<Cell, (kCells + 1) * (kCells + 1)> cells;
    const auto cell_of = [&](const SampledSplat& splat) -> Cell* {
        const double column = (dot(splat.position, ground.right) - x.low) / edge;
        const double row = (dot(splat.position, ground.front) - y.low) / edge;
        if (!(column >= 0 && column <= kCells && row >= 0 && row <= kCells)) return nullptr;
        return &cells[static_cast<std::size_t>(row) * (kCells + 1) + static_cast<std::size_t>(column)];
    };
    for (const SampledSplat& splat : sample.splats)
        if (Cell* cell = cell_of(splat)) cell->lowest = std::min(cell->lowest, dot(splat.position, ground.up));
    for (const SampledSplat& splat : sample.splats) {
        Cell* cell = cell_of(splat);
        if (!cell || dot(splat.position, ground.up) > cell->lowest + edge / 2) continue;
        cell->whole += 1;
        cell->level += std::abs(dot(splat.normal, ground.up)) > kLevel ? 1 : 0;
    }
    double level = 0, filled = 0;
    for (const Cell& cell : cells)
        if (cell.whole > 0) level += cell.level / cell.whole, filled += 1;
    return filled > 0 ? level / filled : 0;
}

/// True for sites, which a horizontal front view would show edge-on.
bool isSite(const SceneSample& sample, const Ground& ground) {
    constexpr double kFlat = 0.25, kAsHighAsWide = 1, kGround = 0.7;
    const double flat = flatness(sample, ground);
    return flat < kFlat || (flat < kAsHighAsWide && levelGround(sample, ground) >= kGround);
}

/// The side, at one elevation, with the largest area of surfaces facing the eye; the first unless another shows
/// kMuchMore.
Vec3 fullestSide(const SceneSample& sample, const Ground& ground, double azimuth, double elevation) {
    const SampleBox box = boundsOf(sample);
    Vec3 best = sideAt(ground, azimuth, elevation);
    double most = visibleAlong(sample, box, basisFrom(ground, best)).facing * kMuchMore;
    for (int turn = 1; turn < 8; ++turn) {
        const Vec3 side = sideAt(ground, azimuth + turn * 45 * kDegree, elevation);
        const double facing = visibleAlong(sample, box, basisFrom(ground, side)).facing;
        if (facing > most) most = facing, best = side;
    }
    return best;
}

bool isWithin(const SampleBox& box, Vec3 point) {
    return point.x > box.low.x && point.y > box.low.y && point.z > box.low.z && point.x < box.high.x &&
           point.y < box.high.y && point.z < box.high.z;
}

/// True if there is room for an eye: almost no disc's sphere contains it.
bool isFree(const SceneSample& sample, Vec3 eye) {
    constexpr double kInTheWay = 0.001; // share of discs that may be too close: tolerates dust around a scanner
    double around = 0;
    for (const SampledSplat& splat : sample.splats) around += length(splat.position - eye) <= splat.radius ? 1 : 0;
    return around <= kInTheWay * static_cast<double>(sample.splats.size());
}

std::vector<Vec3> freeWithin(const SceneSample& sample, const SampleBox& box, const std::vector<Vec3>& places) {
    std::vector<Vec3> within;
    for (const Vec3 place : places)
        if (isWithin(box, place) && isFree(sample, place)) within.push_back(place);
    return within;
}

/// True if, seen from any side and from above, more of the visible surface faces away than towards the eye.
bool showsItsBack(const SceneSample& sample, const Ground& ground) {
    const SampleBox box = denseBox(sample);
    for (const double elevation : {5 * kDegree, kSiteElevation, 89 * kDegree})
        for (int turn = 0; turn < 8; ++turn) {
            const Visibility visible =
                visibleAlong(sample, box, basisFrom(ground, sideAt(ground, turn * 45 * kDegree, elevation)));
            if (visible.facing >= visible.covered / 2) return false;
        }
    return true;
}

/// The share of the sample that is occluded from all six sides.
double hiddenShare(const SceneSample& sample, const Ground& ground) {
    const SampleBox box = denseBox(sample);
    std::vector<bool> seen(sample.splats.size());
    for (const Vec3 side :
         {ground.up, -1.0 * ground.up, ground.front, -1.0 * ground.front, ground.right, -1.0 * ground.right})
        for (const std::uint32_t splat : visibleAlong(sample, box, basisFrom(ground, side)).seen) seen[splat] = true;
    return static_cast<double>(std::count(seen.begin(), seen.end(), false)) / static_cast<double>(seen.size());
}

/// The share of the surface seen from a side, above or below, that is horizontal and near that end.
double levelShare(const SceneSample& sample, const Ground& ground, Vec3 side) {
    constexpr double kLevel = 0.85, kDepth = 0.1; // 32 degrees; share of the height
    const Visibility visible = visibleAlong(sample, denseBox(sample), basisFrom(ground, side));
    const Extent heights = alongAxis(sample, side);
    double level = 0;
    for (const std::uint32_t i : visible.seen) {
        const SampledSplat& splat = sample.splats[i];
        const bool near = dot(splat.position, side) > heights.high - kDepth * heights.size();
        level += near && std::abs(dot(splat.normal, side)) > kLevel ? 1 : 0;
    }
    return visible.seen.empty() ? 0 : level / static_cast<double>(visible.seen.size());
}

/// Whether a sample in metres may show rooms, judged by its size.
bool isAsLargeAsARoom(const SceneSample& sample, const Ground& ground) {
    constexpr double kLowest = 1.8, kHighest = 8, kWidest = 100;
    const double height = alongAxis(sample, ground.up).size();
    const double width = std::max(alongAxis(sample, ground.front).size(), alongAxis(sample, ground.right).size());
    return height >= kLowest && height <= kHighest && width <= kWidest;
}

/// True for a closed box of the size of a room, in metres, with the uneven spacing of a scan from one place. It must
/// have been scanned from inside, since nobody scans the underside of a standing box. Evenly sampled boxes are models.
bool isScannedShell(const SceneSample& sample, const Ground& ground) {
    constexpr double kCeiling = 0.5, kUneven = 3;
    constexpr double kFloor = 0.3; // a scanner does not see the floor beneath itself
    if (!isAsLargeAsARoom(sample, ground)) return false;
    std::vector<double> radii;
    for (const SampledSplat& splat : sample.splats) radii.push_back(splat.radius);
    std::sort(radii.begin(), radii.end());
    const double small = radii[radii.size() / 10], large = radii[radii.size() * 9 / 10];
    return large >= kUneven * small && levelShare(sample, ground, ground.up) >= kCeiling &&
           levelShare(sample, ground, -1.0 * ground.up) >= kFloor;
}

/// True for interiors: either scanners were inside and saw nothing of the outside, or there are objects under a
/// ceiling, or it is a shell that can only have been scanned from within. An empty box has no hidden parts
/// (kFurniture), and the top of a statue is not level (kCeiling).
bool isRoom(const SceneSample& sample, const Ground& ground) {
    constexpr double kFurniture = 0.015, kCeiling = 0.5;
    const bool scanned_within = !freeWithin(sample, boundsOf(sample), sample.sensors).empty();
    if (sample.oriented && scanned_within && showsItsBack(sample, ground)) return true;
    if (isScannedShell(sample, ground)) return true;
    return hiddenShare(sample, ground) >= kFurniture && levelShare(sample, ground, ground.up) >= kCeiling;
}

/// The highest free space between level surfaces along a vertical line: between the floor (or a table) and the ceiling
/// of a room; in buildings with several storeys, one of them.
Extent storeyAt(const SceneSample& sample, const Ground& ground, double x, double y, double reach, const Extent& all) {
    constexpr double kLevel = 0.85; // 32 degrees
    std::vector<double> levels{all.low, all.high};
    for (const SampledSplat& splat : sample.splats) {
        const bool beside = std::abs(dot(splat.position, ground.right) - x) > reach ||
                            std::abs(dot(splat.position, ground.front) - y) > reach;
        if (!beside && std::abs(dot(splat.normal, ground.up)) > kLevel)
            levels.push_back(dot(splat.position, ground.up));
    }
    std::sort(levels.begin(), levels.end());
    Extent highest{all.low, all.low};
    for (std::size_t i = 1; i < levels.size(); ++i)
        if (levels[i] - levels[i - 1] > highest.size()) highest = {levels[i - 1], levels[i]};
    return highest;
}

/// Positions at eye level, from wall to wall: the half with the largest clearance.
std::vector<Vec3> placesWithin(const SceneSample& sample, const Ground& ground) {
    constexpr int kSteps = 5;
    const Extent x = alongAxis(sample, ground.right), y = alongAxis(sample, ground.front),
                 h = alongAxis(sample, ground.up);
    const double reach = std::max(x.size(), y.size()) / (4 * kSteps); // half of the way to the next position
    struct Place {
        Vec3 eye;
        double clearance;
    };
    std::vector<Place> places;
    for (int i = 0; i < kSteps * kSteps; ++i) {
        const double column = (i % kSteps + 0.5) / kSteps, row = (i / kSteps + 0.5) / kSteps;
        const double right = x.low + column * x.size(), front = y.low + row * y.size();
        const Extent storey = storeyAt(sample, ground, right, front, reach, h);
        const Vec3 eye = right * ground.right + front * ground.front +
                         (storey.low + 0.6 * storey.size()) * ground.up; // over tables, under lamps
        double clearance = std::numeric_limits<double>::infinity();
        for (const SampledSplat& splat : sample.splats)
            clearance = std::min(clearance, length(splat.position - eye) - splat.radius);
        places.push_back({eye, clearance});
    }
    std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.clearance > b.clearance; });
    std::vector<Vec3> roomiest;
    for (std::size_t i = 0; i < places.size() / 2; ++i) roomiest.push_back(places[i].eye);
    return roomiest;
}

std::vector<Vec3> someOf(const std::vector<Vec3>& places) {
    std::vector<Vec3> some;
    const std::size_t step = std::max<std::size_t>(1, (places.size() + kMostPlaces - 1) / kMostPlaces);
    for (std::size_t i = 0; i < places.size(); i += step) some.push_back(places[i]);
    return some;
}

/// The share of a sample that is visible from eye when looking in all directions.
double seenAround(const SceneSample& sample, const std::vector<double>& weights, const Ground& ground, Vec3 eye) {
    double seen = 0;
    for (const Vec3 side :
         {ground.up, -1.0 * ground.up, ground.front, -1.0 * ground.front, ground.right, -1.0 * ground.right})
        seen += visibleWeight(sample, weights, eye, basisFrom(ground, side), 90);
    return seen;
}

/// The scanners' positions in a room. If none is known, the position that sees most, since the scanner saw everything:
/// either the origin of a file's coordinates, or a position with clearance around it.
std::vector<Vec3> eyesInRoom(const SceneSample& sample, const Ground& ground) {
    const std::vector<Vec3> known = someOf(freeWithin(sample, boundsOf(sample), sample.sensors));
    if (!known.empty()) return known;
    std::vector<Vec3> places = someOf(freeWithin(sample, denseBox(sample), sample.zeros));
    const std::vector<Vec3> roomiest = placesWithin(sample, ground);
    places.insert(places.end(), roomiest.begin(), roomiest.end());
    const std::vector<double> weights = evenWeights(sample);
    std::vector<double> seen;
    for (const Vec3 place : places) seen.push_back(seenAround(sample, weights, ground, place));
    return {places[static_cast<std::size_t>(std::max_element(seen.begin(), seen.end()) - seen.begin())]};
}

/// True for walls of the size of rooms around a place, with little of a ceiling over it: maps made with mobile scanners
/// contain the walls of rooms, but not always their ceilings.
bool isWalled(const SceneSample& sample, const Ground& ground) {
    // In rooms, 0.74 and 0.77 of all level directions meet a wall, in streets at most 0.24. A sample has a ceiling if
    // it is closed above the walls, but bodies scanned from outside are closed there as well.
    constexpr double kWalls = 0.6, kCeiling = 0.6;
    if (!isAsLargeAsARoom(sample, ground)) return false;
    const std::vector<Vec3> places = placesWithin(sample, ground);
    return std::any_of(places.begin(), places.end(), [&](Vec3 place) {
        const Surrounding around = surroundingOf(sample, place, ground.up);
        return around.level >= kWalls && around.above < kCeiling * around.level;
    });
}

/// The side, seen from above, that shows most of the low parts, so that walls and ceilings do not hide the floor.
Vec3 sideOverWalls(const SceneSample& sample, const Ground& ground) {
    const SampleBox box = boundsOf(sample);
    const double middle = alongAxis(sample, ground.up).middle();
    const std::vector<double> weights = evenWeights(sample);
    Vec3 best = ground.front;
    double most = -1;
    for (int turn = 0; turn < 8; ++turn) {
        const Vec3 side = sideAt(ground, kSiteAzimuth + turn * 45 * kDegree, kWalledElevation);
        double low = 0;
        for (const std::uint32_t splat : visibleAlong(sample, box, basisFrom(ground, side)).seen)
            low += dot(sample.splats[splat].position, ground.up) < middle ? weights[splat] : 0;
        if (low > most) most = low, best = side;
    }
    return best;
}

/// The position and near-horizontal direction that show most.
ViewChoice fullestPlace(const SceneSample& sample, const Ground& ground, const std::vector<Vec3>& places) {
    const std::vector<double> weights = evenWeights(sample);
    ViewChoice best;
    double most = -1;
    for (const Vec3 place : places)
        for (int turn = 0; turn < 8; ++turn) {
            const Vec3 side = sideAt(ground, turn * 45 * kDegree, 5 * kDegree); // slightly down, towards the floor
            const double seen = visibleWeight(sample, weights, place, basisFrom(ground, side), kRoomFov_deg);
            if (seen > most) most = seen, best = {side, place};
        }
    return best;
}

/// True if a scanner at eye explains the sample: discs, as wide as the spacing, grow with their distance, which varies,
/// and face the eye.
bool looksScannedFrom(const SceneSample& sample, Vec3 eye) {
    // The spacing of a range image is proportional to the distance on surfaces of one slope. In seven range images,
    // growth is 0.6 to 1.2 and correlation 0.32 to 0.92. In seven of 50 other scans, the range of distances, growth and
    // correlation are as large, measured from the origin; those scans surround the origin, face away from it, or have
    // a known scanner.
    constexpr double kLeastGrowth = 0.4, kLeastCorrelation = 0.3, kLeastRange = 1.7, kFacing = 0.6;
    std::vector<double> distances;
    double xx = 0, xy = 0, yy = 0, x = 0, y = 0, facing = 0, discs = 0;
    for (const SampledSplat& splat : sample.splats) {
        const Vec3 to = splat.position - eye;
        const double distance = length(to);
        if (!(distance > 0) || !(splat.radius > 0) || splat.normal == Vec3{}) continue;
        const double far = std::log(distance), wide = std::log(splat.radius);
        distances.push_back(distance);
        x += far, y += wide, xx += far * far, xy += far * wide, yy += wide * wide;
        facing += dot(splat.normal, to) < 0 ? 1 : 0, discs += 1;
    }
    if (discs < double{kEachCounts} || facing < kFacing * discs) return false;
    const double spread = xx - x * x / discs, joint = xy - x * y / discs, wide_spread = yy - y * y / discs;
    std::sort(distances.begin(), distances.end());
    const double near = distances[distances.size() / 20], far = distances[distances.size() * 19 / 20];
    return far >= kLeastRange * near && joint >= kLeastGrowth * spread &&
           joint * joint >= kLeastCorrelation * kLeastCorrelation * spread * wide_spread;
}

/// The scanner of a range image: the only known one, or one at the origin of the file's coordinates.
std::optional<Vec3> scannerOfFrame(const SceneSample& sample) {
    if (sample.sensors.size() == 1) return sample.sensors[0];
    const bool is_at_origin = sample.sensors.empty() && sample.zeros.size() == 1 && sample.oriented &&
                              looksScannedFrom(sample, sample.zeros[0]);
    return is_at_origin ? std::optional(sample.zeros[0]) : std::nullopt;
}

/// The view of a single scanner that saw everything in front of it.
std::optional<ViewChoice> viewOfFrame(const SceneSample& sample) {
    const std::optional<Vec3> scanner = scannerOfFrame(sample);
    if (!scanner) return {};
    const Vec3 eye = *scanner, ahead = centroidOf(sample) - eye;
    if (!(length(ahead) > 0) || !isFree(sample, eye)) return {};
    const Vec3 forward = normalize(ahead);
    double within = 0;
    for (const SampledSplat& splat : sample.splats) {
        const Vec3 to = splat.position - eye;
        within += dot(to, forward) > kFrameCosine * length(to) ? 1 : 0;
    }
    if (within < kFrameShare * static_cast<double>(sample.splats.size())) return {};
    return ViewChoice{-1.0 * forward, eye};
}

} // namespace

Vec3 sideOf(StandardView view, Vec3 up) {
    const auto [above, front, right] = groundOf(up);
    switch (view) {
    case StandardView::kBack:
        return -1.0 * front;
    case StandardView::kLeft:
        return -1.0 * right;
    case StandardView::kRight:
        return right;
    case StandardView::kTop:
        return above;
    case StandardView::kBottom:
        return -1.0 * above;
    case StandardView::kIso:
        return normalize(front + right + above);
    default:
        return front;
    }
}

Vec3 upIn(StandardView view, Vec3 up) {
    if (view == StandardView::kTop) return -1.0 * frontSide(up);
    if (view == StandardView::kBottom) return frontSide(up);
    return up;
}

std::optional<ViewChoice> viewOfSensor(const SceneSample& sample, Vec3 up) {
    if (sample.sensors.empty()) return {};
    if (const auto frame = viewOfFrame(sample)) return frame;
    return fullestPlace(sample, groundOf(up), someOf(sample.sensors));
}

PlaceKind placeKind(const SceneSample& sample, Vec3 up, bool is_surveyed) {
    constexpr double kLow = 0.34, kLowWithTrees = 0.5, kGround = 0.5; // vehicles are half as high as they are long
    const Ground ground = groundOf(up);
    if (isRoom(sample, ground)) return PlaceKind::kRoom;
    const double height = flatness(sample, ground);
    const bool is_site = is_surveyed ? height < kLowWithTrees : height < kLow && levelGround(sample, ground) >= kGround;
    return is_site ? PlaceKind::kSite : PlaceKind::kObject;
}

ViewChoice chooseView(const SceneSample& sample, Vec3 up) {
    const Ground ground = groundOf(up);
    if (const auto frame = viewOfFrame(sample)) return *frame;
    if (isRoom(sample, ground)) return fullestPlace(sample, ground, eyesInRoom(sample, ground));
    if (isWalled(sample, ground)) return {sideOverWalls(sample, ground), {}, true};
    if (isSite(sample, ground)) return {fullestSide(sample, ground, kSiteAzimuth, kSiteElevation), {}, true};
    return {fullestSide(sample, ground, 0, 0), {}};
}

} // namespace pointrt
