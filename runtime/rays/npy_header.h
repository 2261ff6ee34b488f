// SPDX-License-Identifier: Apache-2.0
// Reads headers of NumPy's .npy files from streams, and makes headers for files to write.
#pragma once

#include <string>

#include "format/pointio/npy_header.h"
#include "runtime/rays/byte_input.h"

namespace pointrt {

/// Reads the header and leaves input at the first number. Throws Error kBadInput "NAME: reason".
NpyHeader readNpyHeader(ByteInput& input);

/// The header of an array in C order.
/// @param descr as Python writes it, quotes and all: "'<f8'", or a list of fields
/// @param shape as "(3, 6)"
/// @param least minimum size of the header in bytes, to leave room for a longer shape
std::string npyHeader(const std::string& descr, const std::string& shape, std::size_t least = 0);

} // namespace pointrt
