// SPDX-License-Identifier: GPL-3.0-or-later
// Chunks compressed with LZ4 (frames), zstd or bzip2.
#pragma once

#include <string>
#include <string_view>

#include "preprocess/ingest/input_file.h"

namespace pointrt {

/// Unpacks a chunk to `size` bytes. Throws Error if the data is invalid or has another size, if that size exceeds the
/// limit for gzipped scans, or if the compression is not "lz4", "zstd" or "bz2".
std::string unpackChunk(const InputFile& input, std::string_view compression, std::string_view packed,
                        std::uint64_t size);

/// The unpacked size that a zstd frame in a file states. Throws Error if it states none.
std::uint64_t zstdSize(const InputFile& input);

} // namespace pointrt
