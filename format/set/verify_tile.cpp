// SPDX-License-Identifier: Apache-2.0
#include "format/set/verify_tile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "format/base/error.h"
#include "format/set/core_splats.h"
#include "format/set/open_tile.h"

namespace pointrt {

namespace {

using Code = std::array<std::int32_t, 3>;   ///< position steps in a tile's cube
using Offset = std::array<std::int32_t, 3>; ///< from cell to cell, -1 to 1

constexpr std::int32_t kCoreSteps = 1 << (PRO_POSITION_BITS - 1);
constexpr std::int32_t kCoreLow = kCoreSteps / 2, kCoreHigh = kCoreLow + kCoreSteps;
/// Margin in cube units within which rounding cannot move a point out of the core: floats around 0.5 are exact to
/// 2^-24, sums of some of them to a few times that.
constexpr float kSure = 4 * PRO_POSITION_STEP;

SplatWords wordsOf(const ProFile& file, std::size_t splat) {
    SplatWords words;
    std::copy_n(file.splats().data() + splat * PRO_SPLAT_WORDS, PRO_SPLAT_WORDS, words.begin());
    return words;
}

Code codeOf(const SplatWords& words) {
    return {static_cast<std::int32_t>(words[0] & PRO_POSITION_MASK),
            static_cast<std::int32_t>(words[0] >> PRO_POSITION_BITS | (words[1] << PRO_Y_LOW_BITS & PRO_POSITION_MASK)),
            static_cast<std::int32_t>(words[1] >> PRO_Y_HIGH_BITS & PRO_POSITION_MASK)};
}

/// The words with this position, which must be within the cube.
SplatWords withCode(SplatWords words, const Code& code) {
    const auto x = static_cast<std::uint32_t>(code[0]), y = static_cast<std::uint32_t>(code[1]);
    words[0] = x | y << PRO_POSITION_BITS;
    words[1] =
        (words[1] & PRO_SPLAT_BALL) | y >> PRO_Y_LOW_BITS | static_cast<std::uint32_t>(code[2]) << PRO_Y_HIGH_BITS;
    return words;
}

/// The cell of the position, relative to the tile's own.
Offset offsetOf(const Code& code) {
    Offset offset;
    for (std::size_t axis = 0; axis < 3; ++axis) offset[axis] = code[axis] < kCoreLow ? -1 : code[axis] >= kCoreHigh;
    return offset;
}

std::size_t slotOf(const Offset& offset) {
    return static_cast<std::size_t>((offset[2] + 1) * 9 + (offset[1] + 1) * 3 + offset[0] + 1);
}

constexpr std::size_t kSlots = 27;
constexpr std::size_t kOwnSlot = 13;

Offset offsetOfSlot(std::size_t slot) {
    const auto at = static_cast<std::int32_t>(slot);
    return {at % 3 - 1, at / 3 % 3 - 1, at / 9 - 1};
}

/// The neighbouring cell, or none beyond the range of cells.
std::optional<TileCell> cellBeside(const TileCell& cell, const Offset& offset) {
    TileCell beside;
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (__builtin_add_overflow(cell[axis], offset[axis], &beside[axis])) return std::nullopt;
    return beside;
}

/// Whether the cell is in an original tile of a coarser level.
bool isInOriginalTile(const TileSet& set, std::uint32_t level, TileCell cell) {
    while (++level < set.levels.size()) {
        cell = parentOf(cell);
        if (const auto found = findTile(set, level, cell)) return set.tiles[*found].isOriginal();
    }
    return false;
}

/// Whether one of the extreme points of the disc along the axes lies in the core; balls count as discs here.
/// @param splat in the cube of the tile
bool surelyCrossesCore(const pro_splat& splat) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const float slope = 1 - splat.normal[axis] * splat.normal[axis];
        if (slope < kSure) continue; // the normal is along this axis
        const float reach = splat.radius / std::sqrt(slope);
        for (const float side : {-reach, reach}) {
            bool inside = true;
            for (std::size_t k = 0; k < 3; ++k) {
                const float along = (k == axis ? 1.0f : 0.0f) - splat.normal[k] * splat.normal[axis];
                inside &= std::fabs(splat.position[k] + side * along - 0.5f) < 0.25f - kSure;
            }
            if (inside) return true;
        }
    }
    return false;
}

struct Tile {
    const TileSet& set;
    const std::string& folder;
    const SetTile& tile;
    std::vector<TileFinding> findings;

    void add(std::string text) { findings.push_back({0, std::move(text)}); }
};

/// The splats of the file by cell, sorted.
using BySlot = std::array<std::vector<SplatWords>, kSlots>;

BySlot splatsBySlot(const ProFile& file) {
    BySlot slots;
    for (std::size_t i = 0; i < file.info().splat_count; ++i) {
        const SplatWords words = wordsOf(file, i);
        const std::size_t slot = slotOf(offsetOf(codeOf(words)));
        if (slot != kOwnSlot) slots[slot].push_back(words);
    }
    for (auto& slot : slots) std::sort(slot.begin(), slot.end());
    return slots;
}

/// Calls visit(words, splat) for splats that the neighbour owns near the core, encoded as in the tile.
template <typename Visit>
void forEachNear(const ProFile& neighbour, const Offset& offset, const Visit& visit) {
    const auto reach = static_cast<std::int32_t>(std::ceil(double{neighbour.info().radius_max} * PRO_POSITION_STEPS));
    for (std::size_t i = 0; i < neighbour.info().splat_count; ++i) {
        const SplatWords words = wordsOf(neighbour, i);
        Code code = codeOf(words);
        if (offsetOf(code) != Offset{}) continue;
        bool near = true;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            code[axis] += offset[axis] * kCoreSteps;
            near &= code[axis] >= 0 && code[axis] < 2 * kCoreSteps;
        }
        if (!near) continue;
        visit(withCode(words, code), [&] {
            pro_splat splat = neighbour.splat(i);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if (code[axis] < kCoreLow - reach || code[axis] > kCoreHigh + reach) splat.radius = 0; // too far away
                splat.position[axis] = (static_cast<float>(code[axis]) + 0.5f) * PRO_POSITION_STEP;
            }
            return splat;
        });
    }
}

/// @param repeats copies from the neighbour, sorted
void compareWith(Tile& tile, const SetTile& owner, const Offset& offset, const std::vector<SplatWords>& repeats) {
    std::optional<ProFile> file;
    try {
        file = openTile(tile.set, owner, tile.folder, PRO_OPEN_SKIP_CHECKSUMS);
    } catch (const Error&) {
        return; // the neighbour gets its own finding
    }
    std::vector<bool> owned(repeats.size());
    // cleaning can move points across borders, where the merged tile's own splats represent them
    const bool alike = tile.tile.isOriginal() == owner.isOriginal();
    std::size_t missing = 0;
    forEachNear(*file, offset, [&](const SplatWords& words, const auto& splat) {
        const auto [first, last] = std::equal_range(repeats.begin(), repeats.end(), words);
        for (auto each = first; each != last; ++each) owned[static_cast<std::size_t>(each - repeats.begin())] = true;
        if (alike && first == last && surelyCrossesCore(splat())) ++missing;
    });
    const auto strange = std::count(owned.begin(), owned.end(), false);
    if (strange > 0)
        tile.add(std::to_string(strange) + " of its splats lie in the core of " + owner.file +
                 " but are not among that tile's splats");
    if (missing > 0) tile.add("lacks " + std::to_string(missing) + " splats of " + owner.file + " that cross its core");
}

void checkRepeats(Tile& tile, const ProFile& file) {
    const BySlot slots = splatsBySlot(file);
    std::uint64_t own = file.info().splat_count;
    for (std::size_t slot = 0; slot < kSlots; ++slot) {
        if (slot == kOwnSlot) continue;
        own -= slots[slot].size();
        const Offset offset = offsetOfSlot(slot);
        const auto cell = cellBeside(tile.tile.cell, offset);
        const auto owner = cell ? findTile(tile.set, tile.tile.level, *cell) : std::nullopt;
        if (owner && tile.tile.isOriginal() && !tile.set.tiles[*owner].isOriginal())
            continue; // copies from there are re-encoded original splats of finer levels
        if (owner) {
            compareWith(tile, tile.set.tiles[*owner], offset, slots[slot]);
        } else if (!slots[slot].empty() && !(cell && isInOriginalTile(tile.set, tile.tile.level, *cell))) {
            tile.add(std::to_string(slots[slot].size()) + " of its splats are in cells without a tile");
        }
    }
    if (own != tile.tile.splats)
        tile.add("its core holds " + std::to_string(own) + " splats, not " + std::to_string(tile.tile.splats));
}

/// Each Gaussian is in one tile: there are no copies.
void checkGaussians(Tile& tile, const ProFile& file) {
    std::uint64_t own = 0;
    for (std::size_t i = 0; i < file.info().splat_count; ++i) own += offsetOf(codeOf(wordsOf(file, i))) == Offset{};
    if (own != file.info().splat_count)
        tile.add(std::to_string(file.info().splat_count - own) + " of its Gaussians lie outside its core");
    if (own != tile.tile.splats)
        tile.add("its core holds " + std::to_string(own) + " Gaussians, not " + std::to_string(tile.tile.splats));
}

/// Ranges in set.json, which hold for merged splats, too, as these are means of original ones.
void checkRanges(Tile& tile, const ProFile& file) {
    for (std::size_t i = 0; i < file.attributes().size(); ++i) {
        const pro_attribute& is = file.attributes()[i];
        const SetAttribute& all = tile.set.attributes[i];
        const bool has_none = is.low == 0 && is.high == 0; // or the values are zeros
        if (!has_none && (is.low < all.low || is.high > all.high))
            tile.add("attribute " + all.name + " exceeds the range in set.json");
    }
    const double step = file.info().scale / double{PRO_POSITION_STEPS};
    for (std::size_t i = 0; i < file.info().splat_count; ++i) {
        if (offsetOf(codeOf(wordsOf(file, i))) != Offset{}) continue;
        const std::array<double, 3> place = file.position(file.splat(i));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double at = place[axis];
            if (at >= tile.set.bounds_min[axis] - step && at <= tile.set.bounds_max[axis] + step) continue;
            return tile.add("its splats exceed the bounds in set.json");
        }
    }
}

void addFinding(const pro_message* message, void* findings) {
    static_cast<std::vector<TileFinding>*>(findings)->push_back({message->finding, message->text});
}

/// An error line without the file's name, which callers add.
std::string reasonOf(const std::string& line, const std::string& path) {
    return line.starts_with(path + ": ") ? line.substr(path.size() + 2) : line;
}

} // namespace

std::vector<TileFinding> verifyTile(const TileSet& set, const std::string& folder, std::size_t number) {
    Tile tile{set, folder, set.tiles[number], {}};
    const std::string path = tilePath(folder, tile.tile);
    std::size_t count = 0;
    try {
        requireTile(set, tile.tile, folder);
        pro_message message{};
        checkPro(pro_verify(path.c_str(), addFinding, &tile.findings, &count, &message), path, message);
        if (count == 0) {
            const ProFile file = openTile(set, tile.tile, folder, PRO_OPEN_SKIP_CHECKSUMS);
            if (set.gaussians)
                checkGaussians(tile, file);
            else
                checkRepeats(tile, file);
            checkRanges(tile, file);
        }
    } catch (const Error& error) {
        tile.add(reasonOf(error.what(), path));
    } catch (const ProError& error) {
        tile.add(reasonOf(error.what(), path));
    }
    return std::move(tile.findings);
}

} // namespace pointrt
