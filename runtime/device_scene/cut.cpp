// SPDX-License-Identifier: Apache-2.0
#include "runtime/device_scene/cut.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <queue>

#include "runtime/scene/camera.h"

namespace pointrt {
namespace {

bool marked(const std::vector<bool>& marks, std::uint32_t tile) { return !marks.empty() && marks[tile]; }

double distanceTo(const TileBox& box, Vec3 point) {
    const double at[3] = {point.x, point.y, point.z};
    double squared = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double outside = std::max({box.low[axis] - at[axis], at[axis] - box.high[axis], 0.0});
        squared += outside * outside;
    }
    return std::sqrt(squared);
}

/// The largest distance along a normal from a point to any corner of the box.
double farthestAlong(const TileBox& box, Vec3 from, Vec3 normal) {
    const auto along = [](double n, double low, double high) { return n * (n < 0 ? low : high); };
    return along(normal.x, box.low[0] - from.x, box.high[0] - from.x) +
           along(normal.y, box.low[1] - from.y, box.high[1] - from.y) +
           along(normal.z, box.low[2] - from.z, box.high[2] - from.z);
}

/// The edge of a pixel at a distance from the eye.
double pixelAt(const CutView& view, double distance) {
    const Camera& camera = view.camera;
    if (camera.panorama) return 2 * std::numbers::pi * distance / (view.aspect * view.height);
    const double height =
        camera.ortho_height > 0 ? camera.ortho_height : 2 * std::tan(verticalHalfAngle(camera.fov_deg)) * distance;
    return height / view.height;
}

/// The dual basis of the camera's axes, which need not be orthogonal: a point's dot products with these are its
/// coordinates along the axes.
struct PlaneNormals {
    Vec3 right, up, forward;
};

PlaneNormals normalsOf(const Camera& camera) {
    const Vec3 &right = camera.right, &up = camera.up, &forward = camera.forward;
    const Vec3 across = cross(up, forward);
    const double share = 1 / dot(right, across);
    return {share * across, share * cross(forward, right), share * cross(right, up)};
}

double unseenFactor(const TileBox& core, const CutView& view) {
    return isInPicture(core, view) ? 1 : kUnseenPixelScale;
}

/// Whether clips remove all hits of a tile. Its discs may extend beyond the core by less than half an edge.
bool isCutAway(const TileBox& core, const std::vector<HalfSpace>& kept) {
    constexpr double reach = 0.5;
    TileBox around = core;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double edge = core.high[axis] - core.low[axis];
        around.low[axis] -= reach * edge;
        around.high[axis] += reach * edge;
    }
    return std::any_of(kept.begin(), kept.end(),
                       [&](const HalfSpace& each) { return farthestAlong(around, each.point, each.normal) < 0; });
}

class CutRefiner {
public:
    CutRefiner(const TileSet& set, const std::vector<std::vector<std::uint32_t>>& children, const CutRequest& request)
        : set_(set), children_(children), request_(request), in_cut_(set.tiles.size(), false) {}

    TileCut run() {
        add(0);
        while (!queue_.empty()) {
            const Candidate next = queue_.top();
            queue_.pop();
            if (in_cut_[next.tile] && !refine(next.tile)) cut_.fits = false;
        }
        for (std::uint32_t tile = 0; tile < in_cut_.size(); ++tile)
            if (in_cut_[tile]) cut_.tiles.push_back(tile);
        return cut_;
    }

private:
    struct Candidate {
        double pixels;
        std::uint32_t tile;
        bool operator<(const Candidate& other) const {
            return pixels != other.pixels ? pixels < other.pixels : tile > other.tile;
        }
    };

    std::uint64_t bytesOf(std::uint32_t tile) const { return bytesInCut(set_.tiles[tile], request_); }

    double pixelsOf(std::uint32_t tile) const {
        const TileBox core = coreOf(set_, set_.tiles[tile]);
        if (isCutAway(core, request_.kept)) return 0;
        double most = 0;
        for (const CutView& view : request_.views) {
            const double factor = marked(request_.hit_unseen, tile) ? 1 : unseenFactor(core, view);
            most = std::max(most, screenSpaceError(set_, set_.tiles[tile], view) / factor);
        }
        return most;
    }

    void add(std::uint32_t tile) {
        in_cut_[tile] = true;
        cut_.bytes += bytesOf(tile);
        const double pixels = pixelsOf(tile);
        if (!isFine(pixels) && mayRefine(tile)) queue_.push({pixels, tile});
    }

    bool isFine(double pixels) const { return std::min<double>(pixels, kMaxPixelSide) <= request_.detail; }

    bool mayRefine(std::uint32_t tile) const {
        const auto isMissing = [&](std::uint32_t child) { return marked(request_.missing, child); };
        const std::vector<std::uint32_t>& children = children_[tile];
        return !children.empty() && std::none_of(children.begin(), children.end(), isMissing);
    }

    /// Refines coarser neighbours first. False if the memory limit does not allow it.
    bool refine(std::uint32_t tile) {
        while (const auto coarser = coarserNeighbor(tile))
            if (!refine(*coarser)) return false;
        std::uint64_t after = cut_.bytes - bytesOf(tile);
        for (const std::uint32_t child : children_[tile]) after += bytesOf(child);
        if (after > request_.memory) return false;
        in_cut_[tile] = false;
        cut_.bytes -= bytesOf(tile);
        for (const std::uint32_t child : children_[tile]) add(child);
        return true;
    }

    /// A coarser tile of the cut that touches this one and may be refined; nullopt if no tile does.
    std::optional<std::uint32_t> coarserNeighbor(std::uint32_t number) const {
        const SetTile& tile = set_.tiles[number];
        for (int place = 0; place < 27; ++place) {
            const TileCell beside = cellBeside(tile.cell, {place % 3 - 1, place / 3 % 3 - 1, place / 9 - 1});
            const auto above = coarserTileAt(tile.level, beside);
            if (above && mayRefine(*above)) return above;
        }
        return std::nullopt;
    }

    /// The tile of the cut at a higher level that contains the cell.
    std::optional<std::uint32_t> coarserTileAt(std::uint32_t level, TileCell cell) const {
        while (++level < set_.levels.size()) {
            cell = parentOf(cell);
            const auto tile = findTile(set_, level, cell);
            if (tile && in_cut_[*tile]) return tile;
        }
        return std::nullopt;
    }

    const TileSet& set_;
    const std::vector<std::vector<std::uint32_t>>& children_;
    const CutRequest& request_;
    std::vector<bool> in_cut_;
    std::priority_queue<Candidate> queue_;
    TileCut cut_;
};

} // namespace

TileCell cellBeside(const TileCell& cell, const TileCell& steps) {
    TileCell beside;
    for (std::size_t axis = 0; axis < 3; ++axis) // unsigned arithmetic wraps
        beside[axis] =
            static_cast<std::int32_t>(static_cast<std::uint32_t>(cell[axis]) + static_cast<std::uint32_t>(steps[axis]));
    return beside;
}

bool isInPicture(const TileBox& box, const CutView& view) {
    const Camera& camera = view.camera;
    if (camera.panorama) return true;
    const bool parallel = camera.ortho_height > 0;
    const double up = parallel ? camera.ortho_height / 2 : std::tan(verticalHalfAngle(camera.fov_deg));
    const double right = up * view.aspect;
    const PlaneNormals normals = normalsOf(camera);
    if (farthestAlong(box, camera.eye, normals.forward) < 0) return false;
    // the side planes of a perspective camera pass through the eye, those of a parallel projection lie beside it
    const auto within = [&](Vec3 side, double reach) {
        if (parallel) return farthestAlong(box, camera.eye, side) + reach >= 0;
        return farthestAlong(box, camera.eye, reach * normals.forward + side) >= 0;
    };
    return within(normals.right, right) && within(-1.0 * normals.right, right) && within(normals.up, up) &&
           within(-1.0 * normals.up, up);
}

std::uint64_t bytesInCut(const SetTile& tile, const CutRequest& request) {
    return tile.bytes + tile.stored * request.splat_bytes;
}

double screenSpaceError(const TileSet& set, const SetTile& tile, const CutView& view) {
    if (tile.isOriginal()) return 0;
    const double pixel = pixelAt(view, distanceTo(coreOf(set, tile), view.camera.eye));
    return pixel > 0 ? std::max(tile.error, tile.spacing) / pixel : std::numeric_limits<double>::infinity();
}

TileCut chooseCut(const TileSet& set, const std::vector<std::vector<std::uint32_t>>& children,
                  const CutRequest& request) {
    return CutRefiner(set, children, request).run();
}

} // namespace pointrt
