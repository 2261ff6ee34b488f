// SPDX-License-Identifier: GPL-3.0-or-later
// A TIFF image in memory, decoded by libtiff.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <tiffio.h>

#include "preprocess/ingest/input_file.h"

namespace pointrt {

class TiffFile {
public:
    /// Opens the first image of the file. Throws Error if the file has no image. The input must outlive the TiffFile.
    explicit TiffFile(const InputFile& input);
    TiffFile(const TiffFile&) = delete;
    TiffFile& operator=(const TiffFile&) = delete;

    /// The value of a tag, or its default.
    std::uint32_t number(std::uint32_t tag) const;
    /// The values of a tag that libtiff does not know; empty if absent.
    std::vector<double> doubles(std::uint32_t tag) const;
    std::vector<std::uint16_t> shorts(std::uint32_t tag) const;
    std::string text(std::uint32_t tag) const;

    TIFF* get() const { return tiff_.get(); }
    /// Throws Error with the reason that libtiff gave last.
    [[noreturn]] void fail(const std::string& place) const;

private:
    /// The state that libtiff's callbacks use.
    struct Stream {
        std::string_view bytes;
        std::uint64_t at = 0;
        std::string error;
    };
    struct Close {
        void operator()(TIFF* tiff) const { TIFFClose(tiff); }
    };
    static tmsize_t readBytes(thandle_t handle, void* into, tmsize_t size);
    static toff_t seek(thandle_t handle, toff_t offset, int whence);
    static int keepError(TIFF* tiff, void* stream, const char* module, const char* format, va_list values);

    const InputFile& input_;
    std::unique_ptr<Stream> stream_;
    std::unique_ptr<TIFF, Close> tiff_;
};

} // namespace pointrt
