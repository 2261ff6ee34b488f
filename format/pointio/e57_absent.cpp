// SPDX-License-Identifier: Apache-2.0
// Replaces e57.cpp in builds without Rust.
#include "format/pointio/absent.h"
#include "format/pointio/e57.h"

namespace pointrt {

bool hasE57() { return false; }
void CloseE57::operator()(scan_e57*) const {}
void CloseE57::operator()(scan_e57_points*) const {}
E57File openE57(std::string_view) { refuseWithoutRust("E57"); }
E57Points e57Points(const E57File&, std::size_t) { refuseWithoutRust("E57"); }
std::size_t readE57Points(E57Points&, std::size_t, void* const*) { refuseWithoutRust("E57"); }
std::uint64_t e57Position(const E57Points&) { refuseWithoutRust("E57"); }

} // namespace pointrt
