// SPDX-License-Identifier: Apache-2.0
// In place of laz.cpp where there is no Rust.
#include "format/scanfile/absent.h"
#include "format/scanfile/laz.h"

namespace pointrt {

bool hasLaz() { return false; }
LazLayout lazLayout(const LasFile&) { refuseWithoutRust("LAZ"); }
LazStream::LazStream(const LazLayout& layout, std::string_view, const LazChunk&) : layout_(layout), chunk_points_(0) {
    refuseWithoutRust("LAZ");
}
LazStream::~LazStream() = default;
void LazStream::read(char*, std::size_t) { refuseWithoutRust("LAZ"); }

} // namespace pointrt
