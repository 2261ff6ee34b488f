// SPDX-License-Identifier: Apache-2.0
#include "format/index/gaussian_tree.h"

#include <algorithm>
#include <cmath>

#include "format/base/parallel.h"

namespace pointrt {
namespace {

using Vec = std::array<double, 3>;

/// Cells are grown for tests by this share of their edge, and by at least this length: the tracer's floats may place a
/// peak on the other side of a cell's face.
constexpr double kCellGrowth = 1e-4, kLeastGrowth = 2.0 * PRO_POSITION_STEP;

/// Coordinate descent towards the point of a cell nearest to the centre in standard deviations; any result is safe.
constexpr int kDescentSweeps = 6;

double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

struct CellBox {
    Vec low, high;
};

/// An ellipsoid for box tests: |x|^2 = sum over its axes of (u . (x - center))^2 / length^2 is at most 1 inside.
class EllipsoidTest {
public:
    explicit EllipsoidTest(const GaussianEllipsoid& ellipsoid) : center_(ellipsoid.center) {
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::size_t i = 0; i < 3; ++i) axes_[k][i] = ellipsoid.half_axes[k][i];
            const double squared = std::max(dot(axes_[k], axes_[k]), 1e-60);
            for (std::size_t i = 0; i < 3; ++i) {
                reach_[i] += axes_[k][i] * axes_[k][i];
                for (std::size_t j = 0; j < 3; ++j) form_[i][j] += axes_[k][i] * axes_[k][j] / (squared * squared);
            }
        }
        for (double& each : reach_) each = std::sqrt(each);
    }

    /// Diameter of the disc with the area of the two longest axes; 0 if the ellipsoid is empty.
    double diameter() const {
        Vec lengths{std::sqrt(dot(axes_[0], axes_[0])), std::sqrt(dot(axes_[1], axes_[1])),
                    std::sqrt(dot(axes_[2], axes_[2]))};
        std::sort(lengths.begin(), lengths.end());
        return 2 * std::sqrt(lengths[1] * lengths[2]);
    }

    /// Half extents of the bounding box.
    const Vec& reach() const { return reach_; }
    const Vec& center() const { return center_; }

    /// False only if a plane separates the box from the ellipsoid.
    bool meets(const CellBox& box) const {
        for (std::size_t i = 0; i < 3; ++i)
            if (center_[i] - reach_[i] > box.high[i] || center_[i] + reach_[i] < box.low[i]) return false;
        const Vec nearest = descend(box), gradient = times(nearest);
        if (dot(nearest, gradient) <= 1) return true;
        double reach = 0, least = 0;
        for (const Vec& axis : axes_) reach += dot(axis, gradient) * dot(axis, gradient);
        for (std::size_t i = 0; i < 3; ++i)
            least += std::min(gradient[i] * (box.low[i] - center_[i]), gradient[i] * (box.high[i] - center_[i]));
        return least <= std::sqrt(reach);
    }

private:
    Vec times(const Vec& x) const { return {dot(form_[0], x), dot(form_[1], x), dot(form_[2], x)}; }

    /// A point of the box, relative to the centre, where |x|^2 is small.
    Vec descend(const CellBox& box) const {
        Vec x;
        for (std::size_t i = 0; i < 3; ++i) x[i] = std::clamp(0.0, box.low[i] - center_[i], box.high[i] - center_[i]);
        for (int sweep = 0; sweep < kDescentSweeps; ++sweep)
            for (std::size_t i = 0; i < 3; ++i) {
                const double others = dot(form_[i], x) - form_[i][i] * x[i];
                x[i] = std::clamp(-others / form_[i][i], box.low[i] - center_[i], box.high[i] - center_[i]);
            }
        return x;
    }

    Vec center_, reach_{};
    std::array<Vec, 3> axes_{}, form_{};
};

/// A Gaussian in the list of a cell of some depth. Cells are ordered by Morton code.
struct Entry {
    std::uint64_t code = 0;
    std::uint32_t gaussian = 0;

    bool operator<(const Entry& other) const {
        return code != other.code ? code < other.code : gaussian < other.gaussian;
    }
};

using Levels = std::array<std::vector<Entry>, PRO_MAX_DEPTH + 1>;

std::uint64_t mortonCode(const std::array<std::uint32_t, 3>& cell) {
    std::uint64_t code = 0;
    for (std::uint32_t bit = 0; bit < PRO_MAX_DEPTH; ++bit)
        for (std::uint32_t axis = 0; axis < 3; ++axis)
            code |= std::uint64_t{cell[axis] >> bit & 1u} << (3 * bit + axis);
    return code;
}

bool isInCube(const Vec& center, const Vec& reach) {
    for (std::size_t i = 0; i < 3; ++i)
        if (!(center[i] - reach[i] >= 0 && center[i] + reach[i] < 1)) return false;
    return true;
}

/// The depth of the smallest cells that are at least as long as the diameter, plus fineness.
std::uint32_t depthFor(double diameter, int fineness) {
    int exponent = 0;
    std::frexp(diameter, &exponent); // diameter <= 2^exponent
    return static_cast<std::uint32_t>(std::clamp(fineness - exponent, 0, static_cast<int>(PRO_MAX_DEPTH)));
}

CellBox grownBox(const std::array<std::uint32_t, 3>& cell, double edge) {
    const double growth = std::max(kCellGrowth * edge, kLeastGrowth);
    CellBox box;
    for (std::size_t i = 0; i < 3; ++i) {
        box.low[i] = cell[i] * edge - growth;
        box.high[i] = (cell[i] + 1) * edge + growth;
    }
    return box;
}

struct TreeCell {
    std::array<std::uint32_t, 3> at{};
    std::uint32_t depth = 0;
};

double edgeAt(std::uint32_t depth) { return std::ldexp(1.0, -static_cast<int>(depth)); }

/// Lists a Gaussian in the cells of a depth that it overlaps, at or below a cell: a needle overlaps few of the cells in
/// its box.
void enterBelow(const EllipsoidTest& test, std::uint32_t gaussian, const TreeCell& cell, std::uint32_t depth,
                std::vector<Entry>& level) {
    if (!test.meets(grownBox(cell.at, edgeAt(cell.depth)))) return;
    if (cell.depth == depth) return level.push_back({mortonCode(cell.at), gaussian});
    for (std::uint32_t slot = 0; slot < PRO_GROUP_SIZE; ++slot) {
        TreeCell child{{}, cell.depth + 1};
        for (std::uint32_t i = 0; i < 3; ++i) child.at[i] = 2 * cell.at[i] + (slot >> i & 1);
        enterBelow(test, gaussian, child, depth, level);
    }
}

/// Lists one Gaussian, starting from the cells that are as long as its box, of which it overlaps at most 8.
void enter(const GaussianEllipsoid& ellipsoid, std::uint32_t gaussian, int fineness, Levels& levels) {
    const EllipsoidTest test(ellipsoid);
    const Vec& reach = test.reach();
    const double diameter = test.diameter();
    if (!(diameter > 0)) return;
    if (!isInCube(test.center(), reach)) return levels[0].push_back({0, gaussian});
    const std::uint32_t depth = depthFor(diameter, fineness);
    const std::uint32_t from = std::min(depth, depthFor(2 * *std::max_element(reach.begin(), reach.end()), 0));
    const double edge = edgeAt(from), growth = std::max(kCellGrowth * edge, kLeastGrowth);
    std::array<std::uint32_t, 3> first{}, last{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double low = (test.center()[i] - reach[i] - growth) / edge, most = 1 / edge - 1;
        const double high = (test.center()[i] + reach[i] + growth) / edge;
        first[i] = static_cast<std::uint32_t>(std::clamp(std::floor(low), 0.0, most));
        last[i] = static_cast<std::uint32_t>(std::clamp(std::floor(high), 0.0, most));
    }
    TreeCell cell{{}, from};
    for (cell.at[2] = first[2]; cell.at[2] <= last[2]; ++cell.at[2])
        for (cell.at[1] = first[1]; cell.at[1] <= last[1]; ++cell.at[1])
            for (cell.at[0] = first[0]; cell.at[0] <= last[0]; ++cell.at[0])
                enterBelow(test, gaussian, cell, depth, levels[depth]);
}

/// The entries of all Gaussians by depth, each sorted.
Levels enterAll(std::span<const GaussianEllipsoid> gaussians, int fineness, std::size_t threads) {
    constexpr std::size_t kEach = 1 << 14; // Gaussians per task, which takes some milliseconds
    std::vector<Levels> parts((gaussians.size() + kEach - 1) / kEach);
    forAll(
        parts.size(),
        [&](std::size_t k) {
            for (std::size_t g = k * kEach; g < std::min(gaussians.size(), (k + 1) * kEach); ++g)
                enter(gaussians[g], static_cast<std::uint32_t>(g), fineness, parts[k]);
        },
        threads);
    Levels levels;
    forAll(
        levels.size(),
        [&](std::size_t depth) {
            for (Levels& part : parts) {
                levels[depth].insert(levels[depth].end(), part[depth].begin(), part[depth].end());
                part[depth] = {};
            }
            std::sort(levels[depth].begin(), levels[depth].end());
        },
        threads);
    return levels;
}

/// The codes of the cells of each depth that hold entries or lead to cells that do, sorted.
std::array<std::vector<std::uint64_t>, PRO_MAX_DEPTH + 1> usedCells(const Levels& levels) {
    std::array<std::vector<std::uint64_t>, PRO_MAX_DEPTH + 1> used;
    for (std::size_t depth = levels.size(); depth-- > 0;) {
        std::vector<std::uint64_t>& codes = used[depth];
        for (const Entry& entry : levels[depth])
            if (codes.empty() || codes.back() != entry.code) codes.push_back(entry.code);
        if (depth == PRO_MAX_DEPTH) continue;
        const auto own = static_cast<std::ptrdiff_t>(codes.size());
        for (const std::uint64_t child : used[depth + 1])
            if (static_cast<std::ptrdiff_t>(codes.size()) == own || codes.back() != child >> 3)
                codes.push_back(child >> 3);
        std::inplace_merge(codes.begin(), codes.begin() + own, codes.end());
        codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
    }
    return used;
}

/// Appends nodes in array order, with their lists.
class TreeWriter {
public:
    explicit TreeWriter(const Levels& levels) : levels_(levels) {}

    /// The node of a cell. leads: it has children.
    void add(std::size_t depth, std::uint64_t code, bool leads) {
        tree.nodes.push_back(leads ? ++groups_ : 0u);
        tree.nodes.push_back(static_cast<std::uint32_t>(tree.lists.size()));
        const std::vector<Entry>& entries = levels_[depth];
        if (depth != depth_) next_ = 0;
        depth_ = depth;
        for (; next_ < entries.size() && entries[next_].code == code; ++next_)
            tree.lists.push_back(entries[next_].gaussian);
    }

    /// Appends nodes that no cell uses.
    void pad(std::size_t count) {
        for (std::size_t k = 0; k < count; ++k) {
            tree.nodes.push_back(0);
            tree.nodes.push_back(static_cast<std::uint32_t>(tree.lists.size()));
        }
    }

    GaussianTree tree;

private:
    const Levels& levels_;
    std::size_t depth_ = 0, next_ = 0; ///< index of the next entry of the current depth
    std::uint32_t groups_ = 0;
};

} // namespace

float countedDeviations(float opacity) {
    const double ratio = double{opacity} / PRO_GAUSSIAN_OPACITY_MIN;
    return ratio > 1 ? static_cast<float>(std::sqrt(2 * std::log(ratio))) : 0.0f;
}

GaussianEllipsoid ellipsoidOf(const pro_gaussian& gaussian) {
    GaussianEllipsoid ellipsoid;
    std::copy_n(gaussian.mean, 3, ellipsoid.center.begin());
    const float reach = countedDeviations(gaussian.opacity);
    const float w = gaussian.rotation[0], x = gaussian.rotation[1], y = gaussian.rotation[2], z = gaussian.rotation[3];
    const std::array<std::array<float, 3>, 3> axes{
        {{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
         {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
         {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}}};
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < 3; ++i) ellipsoid.half_axes[k][i] = reach * gaussian.deviation[k] * axes[k][i];
    return ellipsoid;
}

GaussianTree buildGaussianTree(std::span<const GaussianEllipsoid> gaussians, int fineness, std::size_t threads) {
    const Levels levels = enterAll(gaussians, fineness, threads);
    const auto used = usedCells(levels);
    TreeWriter writer(levels);
    writer.add(0, 0, !used[1].empty());
    writer.pad(PRO_GROUP_SIZE - 1);
    for (std::size_t depth = 1; depth < used.size() && !used[depth].empty(); ++depth) {
        const std::vector<std::uint64_t>& codes = used[depth];
        static const std::vector<std::uint64_t> kNone;
        const std::vector<std::uint64_t>& below = depth < PRO_MAX_DEPTH ? used[depth + 1] : kNone;
        std::size_t child = 0;
        for (std::size_t k = 0; k < codes.size();) {
            const std::uint64_t parent = codes[k] >> 3;
            for (std::uint64_t slot = 0; slot < PRO_GROUP_SIZE; ++slot) {
                const std::uint64_t code = parent << 3 | slot;
                if (k == codes.size() || codes[k] != code) {
                    writer.pad(1);
                    continue;
                }
                const bool leads = child < below.size() && below[child] >> 3 == code;
                while (child < below.size() && below[child] >> 3 == code) ++child;
                writer.add(depth, code, leads);
                ++k;
            }
        }
    }
    return std::move(writer.tree);
}

} // namespace pointrt
