// SPDX-License-Identifier: Apache-2.0
// Replaces laz.cpp in builds without Rust.
#include "format/pointio/absent.h"
#include "format/pointio/laz.h"

namespace pointrt {

bool hasLaz() { return false; }
LazLayout lazLayout(const LasFile&, bool) { refuseWithoutRust("LAZ"); }
LazStream::LazStream(const LazLayout& layout, std::string_view, const LazChunk&) : layout_(layout), chunk_points_(0) {
    refuseWithoutRust("LAZ");
}
LazStream::~LazStream() = default;
void LazStream::read(char*, std::size_t) { refuseWithoutRust("LAZ"); }

std::string lazRecord(std::uint8_t, std::uint16_t, std::uint32_t) { refuseWithoutRust("LAZ"); }
std::string packChunk(std::string_view, std::string_view) { refuseWithoutRust("LAZ"); }
std::string packTable(std::string_view, const std::vector<std::uint64_t>&, const std::vector<std::uint64_t>&) {
    refuseWithoutRust("LAZ");
}

} // namespace pointrt
