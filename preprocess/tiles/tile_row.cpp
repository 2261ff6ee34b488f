// SPDX-License-Identifier: GPL-3.0-or-later
// A tile's row of set.json from its file alone: from the checksum in its header, and META.
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "format/base/json_integer.h"
#include "pointrt/pro_layout.h"
#include "preprocess/tiles/build_tile.h"

namespace pointrt {

namespace {

using Json = nlohmann::json;
using Header = std::array<char, PRO_HEADER_BYTES>;

template <typename Number>
Number load(const Header& header, std::size_t offset) {
    Number number;
    std::memcpy(&number, header.data() + offset, sizeof number);
    return number;
}

/// The contents of META; "" if there is none.
std::string metadataOf(std::ifstream& file, const Header& header, std::uint64_t file_bytes) {
    for (std::size_t at = PRO_TABLE_OFFSET; at + PRO_SECTION_BYTES <= header.size(); at += PRO_SECTION_BYTES) {
        if (load<std::uint32_t>(header, at + PRO_SEC_OFF_KIND) != PRO_KIND_META) continue;
        const auto offset = load<std::uint64_t>(header, at + PRO_SEC_OFF_OFFSET);
        const auto length = load<std::uint64_t>(header, at + PRO_SEC_OFF_LENGTH);
        if (offset > file_bytes || length > file_bytes - offset) return "";
        std::string text(length, ' ');
        file.seekg(static_cast<std::streamoff>(offset));
        file.read(text.data(), static_cast<std::streamsize>(length));
        return file ? text : "";
    }
    return "";
}

} // namespace

std::optional<SetTile> findTileRow(const SetFolders& folders, const TileKey& tile) {
    SetTile row;
    row.level = tile.level;
    row.cell = tile.cell;
    row.file = tileFileName(tile.level, tile.cell);
    std::ifstream file(folders.set + "/" + row.file, std::ios::binary | std::ios::ate);
    if (!file) return std::nullopt;
    row.bytes = static_cast<std::uint64_t>(file.tellg());
    Header header;
    file.seekg(0);
    if (!file.read(header.data(), header.size())) return std::nullopt;
    if (load<std::uint64_t>(header, PRO_OFF_FILE_BYTES) != row.bytes) return std::nullopt;
    row.stored = load<std::uint32_t>(header, PRO_OFF_SPLAT_COUNT);
    row.checksum = load<std::uint64_t>(header, PRO_OFF_HEADER_XXH3);
    try {
        const Json said = Json::parse(metadataOf(file, header, row.bytes)).at("tile");
        if (said.at("level") != row.level || said.at("cell") != row.cell) return std::nullopt;
        row.splats = jsonInteger<decltype(row.splats)>(said.at("splats"));
        row.error = said.at("error");
        row.spacing = said.at("spacing");
    } catch (const Json::exception&) {
        return std::nullopt; // a file of another program
    }
    return row;
}

} // namespace pointrt
