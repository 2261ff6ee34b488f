// SPDX-License-Identifier: GPL-3.0-or-later
// Members of zip archives: PKWARE's APPNOTE, without encryption, several volumes or zip64.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "preprocess/ingest/input_file.h"

namespace pointrt {

struct ZipMember {
    std::string_view name;
    std::string_view header; ///< from the local header to the end of the archive
    std::uint64_t packed_size = 0, size = 0;
    std::uint32_t method = 0; ///< 0: stored, 8: deflated
    bool encrypted = false;
};

bool isZip(std::string_view bytes);

/// The members that the archive's directory lists; nullopt if it has no valid directory, such as when truncated.
std::optional<std::vector<ZipMember>> zipMembers(std::string_view bytes);

/// The name of the first member, which a truncated archive has too; "" if that is not there.
std::string_view firstZipMember(std::string_view bytes);

/// Unpacks a member. Throws Error if its data is encrypted, invalid or truncated, or if it expands to more than a
/// gzipped scan may (unpackGzip).
InputFile openZipMember(const InputFile& archive, const ZipMember& member);

} // namespace pointrt
