// SPDX-License-Identifier: Apache-2.0
// The header and the section table: bytes to structs and back.
#pragma once

#include <cstddef>
#include <cstdint>

#include "pointrt/pro.h"

namespace pointrt::format {

/// One record of the section table.
struct Section {
    std::uint32_t kind = 0, stride = 0;
    std::uint64_t count = 0, offset = 0, length = 0, xxh3 = 0;
    std::uint32_t flags = 0;
};

/// Header bytes (PRO_HEADER_BYTES) to structs and back, without checks.
pro_info loadInfo(const std::byte* header);
void storeInfo(std::byte* header, const pro_info& info);
/// The frame of the entry grid: the index without pointers and without the counts that its sections have.
pro_index loadFrame(const std::byte* header);
void storeFrame(std::byte* header, const pro_index& index);
/// The header's part of the world; sensors are null.
pro_world loadWorld(const std::byte* header);
void storeWorld(std::byte* header, const pro_world& world);
/// The header's part of the sampling; noise is null.
pro_sampling loadSampling(const std::byte* header);
void storeSampling(std::byte* header, const pro_sampling& sampling);
/// The coding of the Gaussians: without pointers and without the counts that their sections have.
pro_gaussians loadGaussianCoding(const std::byte* header);
void storeGaussianCoding(std::byte* header, const pro_gaussians& gaussians);
Section loadSection(const std::byte* header, std::uint32_t index);
void storeSection(std::byte* header, std::uint32_t index, const Section& section);
std::uint32_t loadU32(const std::byte* bytes, std::size_t offset);
void storeU32(std::byte* bytes, std::size_t offset, std::uint32_t value);
std::uint64_t loadU64(const std::byte* bytes, std::size_t offset);
void storeU64(std::byte* bytes, std::size_t offset, std::uint64_t value);

/// XXH3-64 of a buffer, and of the bytes of a header that PRO_OFF_HEADER_XXH3 covers.
std::uint64_t checksum(const void* data, std::size_t bytes);
std::uint64_t headerChecksum(const std::byte* header);

} // namespace pointrt::format
