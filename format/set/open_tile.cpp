// SPDX-License-Identifier: Apache-2.0
#include "format/set/open_tile.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "format/base/error.h"
#include "format/os/descriptor.h"
#include "format/set/set_words.h"

namespace pointrt {

namespace {

/// The header fields that identify a tile.
struct TileHeader {
    std::uint64_t bytes = 0, checksum = 0;
    std::uint32_t splats = 0;
    TileCube cube;
    float radius_max = 0, radius_step = 0;
    std::array<double, 3> bounds_min{}, bounds_max{};
};

[[noreturn]] void refuse(const std::string& path, const std::string& reason) {
    throw Error(ExitCode::kBadInput, path + ": " + reason);
}

template <typename T>
T load(const std::byte* header, std::size_t offset) {
    T value;
    std::memcpy(&value, header + offset, sizeof value);
    return value;
}

TileHeader loadHeader(const std::byte* header, std::uint64_t bytes) {
    return {bytes,
            load<std::uint64_t>(header, PRO_OFF_HEADER_XXH3),
            load<std::uint32_t>(header, PRO_OFF_SPLAT_COUNT),
            {load<std::array<double, 3>>(header, PRO_OFF_ORIGIN), load<double>(header, PRO_OFF_SCALE)},
            load<float>(header, PRO_OFF_RADIUS_MAX),
            load<float>(header, PRO_OFF_RADIUS_STEP),
            load<std::array<double, 3>>(header, PRO_OFF_BOUNDS_MIN),
            load<std::array<double, 3>>(header, PRO_OFF_BOUNDS_MAX)};
}

TileHeader readHeader(const std::string& path) {
    // a named pipe is refused rather than waited for
    const Descriptor file(openFile(path, Opening::kReadNoWait));
    const auto status = file.isOpen() ? statusOf(file.number()) : std::nullopt;
    if (!status) refuse(path, std::generic_category().message(errno));
    if (status->kind != FileKind::kRegular) refuse(path, "not a regular file");
    std::array<std::byte, PRO_FIELDS_END> header{};
    const std::ptrdiff_t read = readAt(file.number(), header.data(), header.size(), 0);
    if (read < 0) refuse(path, std::generic_category().message(errno));
    if (static_cast<std::size_t>(read) < header.size() || status->bytes < PRO_HEADER_BYTES)
        refuse(path, "has " + std::to_string(status->bytes) + " bytes, fewer than the header of a .pro file");
    if (load<std::uint32_t>(header.data(), PRO_OFF_MAGIC) != PRO_MAGIC_WORD0) refuse(path, "is not a .pro file");
    return loadHeader(header.data(), status->bytes);
}

/// How the file differs from its description in set.json; "" if it does not.
std::string differenceOf(const TileSet& set, const SetTile& tile, const TileHeader& header) {
    const auto both = [](const auto& is, const auto& wanted, const char* what) {
        return std::to_string(is) + what + ", not " + std::to_string(wanted);
    };
    if (header.bytes != tile.bytes) return both(header.bytes, tile.bytes, " bytes");
    if (header.checksum != tile.checksum)
        return "checksum " + checksumWord(header.checksum) + ", not " + checksumWord(tile.checksum);
    if (header.splats != tile.stored) return both(header.splats, tile.stored, " splats");
    const TileCube cube = cubeOf(set, tile);
    if (header.cube.scale != cube.scale) return "its cube is not two cores wide";
    if (header.cube.origin != cube.origin) return "its cube is not around its core";
    const SetLevel& level = set.levels[tile.level];
    if (header.radius_max != static_cast<float>(level.radius_max)) return "its radius_max differs from its level's";
    if (header.radius_step != static_cast<float>(level.radius_step)) return "its radius_step differs from its level's";
    return {};
}

void requireSame(const TileSet& set, const SetTile& tile, const TileHeader& header, const std::string& path) {
    if (const std::string difference = differenceOf(set, tile, header); !difference.empty())
        refuse(path, "is not the tile that set.json names (" + difference + ")");
}

bool hasAttributesOf(const TileSet& set, const ProFile& file) {
    if (file.attributes().size() != set.attributes.size()) return false;
    for (std::size_t i = 0; i < set.attributes.size(); ++i) {
        const pro_attribute& is = file.attributes()[i];
        const SetAttribute& wanted = set.attributes[i];
        if (wanted.name != is.name || wanted.type != is.type || wanted.components != is.components) return false;
    }
    return true;
}

void requireContent(const TileSet& set, const ProFile& file, const std::string& path) {
    const auto is = [&](std::uint32_t flag) { return (file.info().flags & flag) != 0; };
    if (is(PRO_FLAG_COLOR) != set.colors || is(PRO_FLAG_ORIENTED) != set.oriented)
        refuse(path, "belongs to another set (colours or orientation differ from set.json)");
    if ((file.gaussians() != nullptr) != set.gaussians)
        refuse(path, "belongs to another set (the tile or the set holds Gaussians, but not both)");
    if (!hasAttributesOf(set, file)) refuse(path, "belongs to another set (attributes differ from set.json)");
}

} // namespace

std::string tilePath(const std::string& folder, const SetTile& tile) {
    return folder + (folder.ends_with('/') ? "" : "/") + tile.file;
}

void describeTile(const std::string& folder, SetTile& tile) {
    const TileHeader header = readHeader(tilePath(folder, tile));
    tile.stored = header.splats;
    tile.bytes = header.bytes;
    tile.checksum = header.checksum;
}

void requireTile(const TileSet& set, const SetTile& tile, const std::string& folder) {
    const std::string path = tilePath(folder, tile);
    requireSame(set, tile, readHeader(path), path);
}

TileBox discBoundsOf(const TileSet& set, const SetTile& tile, const std::string& folder) {
    const std::string path = tilePath(folder, tile);
    const TileHeader header = readHeader(path);
    requireSame(set, tile, header, path);
    const double radius = static_cast<double>(header.radius_max) * header.cube.scale;
    TileBox box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box.low[axis] = header.bounds_min[axis] - radius;
        box.high[axis] = header.bounds_max[axis] + radius;
    }
    return box;
}

ProFile openTile(const TileSet& set, const SetTile& tile, const std::string& folder, std::uint32_t open_flags) {
    const std::string path = tilePath(folder, tile);
    requireSame(set, tile, readHeader(path), path);
    try {
        ProFile file(path, open_flags);
        // checked again: another file may have replaced it since
        requireSame(set, tile, loadHeader(file.bytes().data(), file.bytes().size()), path);
        requireContent(set, file, path);
        return file;
    } catch (const ProError& error) {
        throw Error(exitCodeOf(error.result), error.what());
    }
}

} // namespace pointrt
