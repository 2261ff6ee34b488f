// SPDX-License-Identifier: Apache-2.0
#include "format/set/core_splats.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <optional>

#include "format/base/error.h"
#include "format/set/open_tile.h"
#include "pointrt/pro_layout.h"

namespace pointrt {

namespace {

using Header = std::array<char, PRO_HEADER_BYTES>;

template <typename T>
T load(const Header& header, std::size_t offset) {
    T value;
    std::memcpy(&value, header.data() + offset, sizeof value);
    return value;
}

/// The offset of the section of splats, if it has this many.
std::optional<std::uint64_t> placeOfSplats(const Header& header, std::uint64_t splats) {
    const std::size_t sections =
        std::min<std::size_t>(load<std::uint32_t>(header, PRO_OFF_SECTION_COUNT), PRO_SECTION_MAX);
    for (std::size_t i = 0; i < sections; ++i) {
        const std::size_t record = PRO_TABLE_OFFSET + i * PRO_SECTION_BYTES;
        const bool holds = load<std::uint32_t>(header, record + PRO_SEC_OFF_KIND) == PRO_KIND_SPLT &&
                           load<std::uint32_t>(header, record + PRO_SEC_OFF_STRIDE) == sizeof(SplatWords) &&
                           load<std::uint64_t>(header, record + PRO_SEC_OFF_COUNT) == splats;
        if (holds) return load<std::uint64_t>(header, record + PRO_SEC_OFF_OFFSET);
    }
    return std::nullopt;
}

bool read(std::ifstream& file, std::uint64_t offset, char* to, std::size_t bytes) {
    file.seekg(static_cast<std::streamoff>(offset));
    return static_cast<bool>(file.read(to, static_cast<std::streamsize>(bytes)));
}

} // namespace

bool isInCore(const pro_splat& splat) {
    return std::all_of(std::begin(splat.position), std::end(splat.position),
                       [](float at) { return at >= 0.25f && at < 0.75f; });
}

std::vector<pro_splat> coreSplats(const TileSet& set, const SetTile& tile, const std::string& folder,
                                  std::uint64_t first, std::uint64_t step) {
    requireTile(set, tile, folder);
    const std::string path = tilePath(folder, tile);
    std::ifstream file;
    file.rdbuf()->pubsetbuf(nullptr, 0); // splats are far apart, so reading ahead would be wasted
    file.open(path, std::ios::binary);
    Header header;
    const auto place = read(file, 0, header.data(), header.size()) ? placeOfSplats(header, tile.stored) : std::nullopt;
    if (!place) throw Error(ExitCode::kBadInput, path + ": cannot read its splats");
    const SetLevel& level = set.levels[tile.level];
    std::vector<pro_splat> splats;
    for (std::uint64_t i = first; i < tile.stored; i += step) {
        SplatWords words;
        if (!read(file, *place + i * sizeof words, reinterpret_cast<char*>(words.data()), sizeof words))
            throw Error(ExitCode::kBadInput, path + ": cannot read its splats");
        pro_splat splat;
        pro_splat_decode(words.data(), static_cast<float>(level.radius_max), static_cast<float>(level.radius_step),
                         &splat);
        if (pro_splat_is_ball(words.data())) std::fill(std::begin(splat.normal), std::end(splat.normal), 0.0f);
        if (isInCore(splat)) splats.push_back(splat);
    }
    return splats;
}

} // namespace pointrt
