// SPDX-License-Identifier: Apache-2.0
// Headers of NumPy's .npy files (NEP 1, versions 1.0 to 3.0).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/rays/byte_input.h"

namespace pointrt {

extern const std::string kNpyMagic; ///< the first six bytes

struct NpyHeader {
    std::string descr; ///< "<f8"
    bool fortran_order = false;
    std::vector<std::uint64_t> shape;
};

/// Reads the header; input is at the first number afterwards. Throws Error kBadInput "NAME: reason".
NpyHeader readNpyHeader(ByteInput& input);
/// Parses the text of a header: the Python literal of a dict with these three keys. Throws std::invalid_argument with
/// the reason.
NpyHeader parseNpyHeader(std::string_view text);

/// The header of an array in C order.
/// @param descr as Python writes it, quotes and all: "'<f8'", or a list of fields
/// @param shape as "(3, 6)"
/// @param least minimum size in bytes, to leave room for a longer shape
std::string npyHeader(const std::string& descr, const std::string& shape, std::size_t least = 0);

} // namespace pointrt
