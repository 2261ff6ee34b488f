// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/points/tiff_file.h"
#include "preprocess/ingest/unpack_limit.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstring>

namespace pointrt {
namespace {

tmsize_t writeNothing(thandle_t, void*, tmsize_t) { return 0; }
int closeNothing(thandle_t) { return 0; }
int ignoreWarning(TIFF*, void*, const char*, const char*, va_list) { return 1; }

} // namespace

tmsize_t TiffFile::readBytes(thandle_t handle, void* into, tmsize_t size) {
    Stream& stream = *static_cast<Stream*>(handle);
    const std::uint64_t left = stream.bytes.size() - std::min<std::uint64_t>(stream.at, stream.bytes.size());
    const std::uint64_t taken = std::min<std::uint64_t>(left, static_cast<std::uint64_t>(std::max<tmsize_t>(size, 0)));
    if (taken > 0) std::memcpy(into, stream.bytes.data() + stream.at, taken);
    stream.at += taken;
    return static_cast<tmsize_t>(taken);
}

toff_t TiffFile::seek(thandle_t handle, toff_t offset, int whence) {
    Stream& stream = *static_cast<Stream*>(handle);
    const std::uint64_t from = whence == SEEK_CUR ? stream.at : whence == SEEK_END ? stream.bytes.size() : 0;
    return stream.at = from + offset;
}

int TiffFile::keepError(TIFF*, void* stream, const char*, const char* format, va_list values) {
    char text[200]; // more than a line shows
    std::vsnprintf(text, sizeof text, format, values);
    static_cast<Stream*>(stream)->error = text;
    return 1;
}

TiffFile::TiffFile(const InputFile& input)
    : input_(input), stream_(std::make_unique<Stream>(Stream{input.bytes, 0, {}})) {
    const std::uint64_t largest = mostUnpacked(input.bytes.size()); // a strip or tile, or a list of their places
    const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(TIFFOpenOptionsAlloc(),
                                                                                   TIFFOpenOptionsFree);
    TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), static_cast<tmsize_t>(largest));
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keepError, stream_.get());
    TIFFOpenOptionsSetWarningHandlerExtR(options.get(), ignoreWarning, stream_.get());
    const auto size = [](thandle_t handle) -> toff_t { return static_cast<Stream*>(handle)->bytes.size(); };
    // 'm': not mapped, so that all reading goes through readBytes
    tiff_.reset(TIFFClientOpenExt("", "rm", stream_.get(), readBytes, writeNothing, seek, closeNothing, size, nullptr,
                                  nullptr, options.get()));
    if (!tiff_) fail("its directory");
}

void TiffFile::fail(const std::string& place) const {
    refuse(input_, fmt::format("{} cannot be decoded: {}", place,
                               stream_->error.empty() ? "libtiff gives no reason" : inQuotes(stream_->error)));
}

std::uint32_t TiffFile::number(std::uint32_t tag) const {
    const TIFFField* const field = TIFFFindField(tiff_.get(), tag, TIFF_ANY);
    if (field && TIFFFieldDataType(field) == TIFF_SHORT) {
        std::uint16_t value = 0;
        return TIFFGetFieldDefaulted(tiff_.get(), tag, &value) == 1 ? value : 0;
    }
    std::uint32_t value = 0;
    return TIFFGetFieldDefaulted(tiff_.get(), tag, &value) == 1 ? value : 0;
}

namespace {

/// The values of a tag of this type: libtiff returns unknown tags with a count of 32 bits.
template <typename Value>
std::vector<Value> valuesOf(TIFF* tiff, std::uint32_t tag, TIFFDataType type) {
    const TIFFField* const field = TIFFFindField(tiff, tag, TIFF_ANY);
    if (!field || TIFFFieldDataType(field) != type || TIFFFieldPassCount(field) == 0 ||
        TIFFFieldReadCount(field) != TIFF_VARIABLE2)
        return {};
    std::uint32_t count = 0;
    const Value* values = nullptr;
    if (TIFFGetField(tiff, tag, &count, &values) != 1 || !values) return {};
    return {values, values + count};
}

} // namespace

std::vector<double> TiffFile::doubles(std::uint32_t tag) const {
    return valuesOf<double>(tiff_.get(), tag, TIFF_DOUBLE);
}

std::vector<std::uint16_t> TiffFile::shorts(std::uint32_t tag) const {
    return valuesOf<std::uint16_t>(tiff_.get(), tag, TIFF_SHORT);
}

std::string TiffFile::text(std::uint32_t tag) const {
    const std::vector<char> letters = valuesOf<char>(tiff_.get(), tag, TIFF_ASCII);
    return {letters.begin(), std::find(letters.begin(), letters.end(), '\0')};
}

} // namespace pointrt
