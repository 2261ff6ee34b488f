// SPDX-License-Identifier: GPL-3.0-or-later
// Values of arrays in XML files of VTK: raw or in base64, with or without compression.
#pragma once

#include <string>
#include <string_view>

#include "preprocess/ingest/input_file.h"

namespace pointrt {

/// How the file's arrays are stored.
struct VtpEncoding {
    std::string compressor;    ///< "" for none
    bool long_lengths = false; ///< lengths have 64 bits, not 32
};

/// Decodes the start of `stored` to `size` bytes. Throws Error if there are fewer or they are invalid.
/// @param base64 whether the bytes are in base64
std::string decodeVtpData(const InputFile& input, const VtpEncoding& encoding, std::string_view stored, bool base64,
                          std::uint64_t size);

} // namespace pointrt
