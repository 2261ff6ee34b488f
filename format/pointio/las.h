// SPDX-License-Identifier: Apache-2.0
// LAS files, 1.0 to 1.5: header and variable length records. LAZ files are LAS files with compressed points.
// After "LAS Specification 1.4 - R15", ASPRS 2019.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pointrt {

/// The public header block. Fields that the version of the file lacks are 0.
struct LasHeader {
    std::uint8_t version_major = 1, version_minor = 2;
    std::uint16_t header_bytes = 0;
    std::uint32_t point_offset = 0, vlr_count = 0;
    std::uint8_t point_format = 0; ///< 0 to 10
    bool packed = false;           ///< points are compressed (LAZ)
    std::uint16_t record_bytes = 0;
    std::uint64_t point_count = 0;
    std::array<double, 3> scale{}, offset{}; ///< coordinate = offset + scale * integer; finite, scale not 0
    std::uint16_t global_encoding = 0;
    std::uint64_t evlr_offset = 0;
    std::uint32_t evlr_count = 0;
};

/// A variable length record.
struct LasVlr {
    std::string user_id, description;
    std::uint16_t record_id = 0;
    bool extended = false; ///< after the points
    std::string_view data;
};

struct LasFile {
    std::string_view bytes; ///< of the file; data of VLRs are views of them
    LasHeader header;
    std::vector<LasVlr> vlrs;
    std::vector<std::string> notes; ///< for the user
    std::uint64_t promised = 0; ///< number of points that the header announces, if the file is salvaged and has fewer
};

/// Reads header and records. Throws Error (kBadInput, without the file's name) for an unknown version or point format,
/// invalid numbers in the header, and uncompressed points that do not fit in the file.
/// @param salvages accept uncompressed points that are fewer than announced
LasFile openLas(std::string_view bytes, bool salvages = false);

/// Reads the header without checking it against the rest of the file. Throws as openLas.
LasHeader readLasHeader(std::string_view bytes);

/// The first such VLR, or null.
const LasVlr* findVlr(const LasFile& file, std::string_view user_id, std::uint16_t record_id);

/// Bytes of a point before its extra bytes.
/// @param point_format 0 to 10
std::uint16_t lasRecordBytes(std::uint8_t point_format);

inline constexpr std::string_view kLasSpecUser = "LASF_Spec", kLasCrsUser = "LASF_Projection";
/// Record numbers under kLasCrsUser.
inline constexpr std::uint16_t kWktRecord = 2112, kGeoKeysRecord = 34735, kGeoDoublesRecord = 34736;
/// Bytes that describe one field of extra bytes.
inline constexpr std::size_t kDescriptorBytes = 192;
inline constexpr std::uint16_t kExtraBytesRecord = 4, kWaveformDataRecord = 65535;
inline constexpr std::string_view kLaszipUser = "laszip encoded";
inline constexpr std::uint16_t kLaszipRecord = 22204;
inline constexpr std::string_view kCopcUser = "copc";
inline constexpr std::uint16_t kCopcInfoRecord = 1, kCopcHierarchyRecord = 1000;

} // namespace pointrt
