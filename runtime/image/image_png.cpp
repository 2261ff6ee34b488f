// SPDX-License-Identifier: Apache-2.0
#include "runtime/image/image_png.h"

#include <png.h>

#include <bit>
#include <csetjmp>
#include <exception>
#include <new>
#include <stdexcept>

namespace pointrt {

struct PngWriter::State {
    State(const std::string& path, Writing writing) : file(path, writing) {}
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() { png_destroy_write_struct(&png, &info); }

    OutputFile file;
    std::vector<std::uint8_t> gathered; ///< output buffer: libpng writes in small pieces
    std::exception_ptr failure;         ///< an exception of file
    png_structp png = nullptr;
    png_infop info = nullptr;
    std::size_t row_bytes = 0;
};

namespace {

constexpr std::size_t kGatheredBytes = std::size_t{1} << 20; ///< large enough to hide the cost of a system call

template <typename State>
void writeGathered(State& state) {
    state.file.append(state.gathered);
    state.gathered.clear();
}

template <typename State>
void appendBytes(png_structp png, png_bytep data, std::size_t count) {
    auto& state = *static_cast<State*>(png_get_io_ptr(png));
    // exceptions must not pass through libpng, and longjmp must not leave a handler
    try {
        state.gathered.insert(state.gathered.end(), data, data + count);
        if (state.gathered.size() >= kGatheredBytes) writeGathered(state);
    } catch (...) {
        state.failure = std::current_exception();
    }
    if (state.failure) png_error(png, "cannot write");
}

void flushNothing(png_structp) {}
void ignoreMessage(png_structp, png_const_charp) {}
void jumpOut(png_structp png, png_const_charp) { png_longjmp(png, 1); }

void setXmp(png_structp png, png_infop info, const std::string& xmp) {
    if (xmp.empty()) return;
    char keyword[] = "XML:com.adobe.xmp", none[] = "";
    png_text text{};
    text.compression = PNG_ITXT_COMPRESSION_NONE; // uncompressed, since viewers search the file for it
    text.key = keyword;
    text.text = const_cast<char*>(xmp.c_str()); // libpng copies it
    text.lang = text.lang_key = none;
    png_set_text(png, info, &text, 1);
}

void setHeader(png_structp png, png_infop info, PngSize size, const std::string& xmp) {
    const int color = size.channels == 1   ? PNG_COLOR_TYPE_GRAY
                      : size.channels == 4 ? PNG_COLOR_TYPE_RGB_ALPHA
                                           : PNG_COLOR_TYPE_RGB;
    png_set_IHDR(png, info, size.width, size.height, static_cast<int>(size.bits), color, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (size.is_color) png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_RELATIVE);
    char keyword[] = "Software", writer[] = "pointrt-view " POINTRT_VERSION;
    png_text text{};
    text.compression = PNG_TEXT_COMPRESSION_NONE;
    text.key = keyword;
    text.text = writer;
    png_set_text(png, info, &text, 1);
    setXmp(png, info, xmp);
}

// False if libpng failed. No local variable may need a destructor: libpng uses longjmp.

bool writeHeader(png_structp png, png_infop info, PngSize size, const std::string& xmp) {
    if (setjmp(png_jmpbuf(png))) return false;
    setHeader(png, info, size, xmp);
    png_write_info(png, info);
    if (size.bits == 16 && std::endian::native == std::endian::little) png_set_swap(png);
    return true;
}

bool writeRows(png_structp png, const std::uint8_t* rows, std::size_t row_bytes, std::size_t count) {
    if (setjmp(png_jmpbuf(png))) return false;
    for (std::size_t row = 0; row < count; ++row) png_write_row(png, rows + row * row_bytes);
    return true;
}

bool writeEnd(png_structp png, png_infop info) {
    if (setjmp(png_jmpbuf(png))) return false;
    png_write_end(png, info);
    return true;
}

/// The arguments are valid: only the file and memory allocation can fail.
template <typename State>
void require(bool done, const State& state) {
    if (done) return;
    if (state.failure) std::rethrow_exception(state.failure);
    throw std::bad_alloc();
}

} // namespace

PngWriter::PngWriter(const std::string& path, PngSize size, Writing writing, const std::string& xmp)
    : state_(std::make_unique<State>(path, writing)) {
    State& state = *state_;
    state.row_bytes = std::size_t{size.width} * size.channels * (size.bits / 8);
    state.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, jumpOut, ignoreMessage);
    if (state.png) state.info = png_create_info_struct(state.png);
    require(state.info != nullptr, state);
    png_set_write_fn(state.png, &state, appendBytes<State>, flushNothing);
    require(writeHeader(state.png, state.info, size, xmp), state);
}

PngWriter::~PngWriter() = default;

void PngWriter::addRows(std::span<const std::uint8_t> rows) {
    State& state = *state_;
    if (rows.size() % state.row_bytes != 0) throw std::logic_error("PngWriter: not whole rows");
    require(writeRows(state.png, rows.data(), state.row_bytes, rows.size() / state.row_bytes), state);
}

void PngWriter::finish() {
    State& state = *state_;
    require(writeEnd(state.png, state.info), state);
    writeGathered(state);
    state.file.commit();
}

void writePng(const std::string& path, const Image8& image) {
    if (image.pixels.size() != std::size_t{image.width} * image.height * image.channels)
        throw std::logic_error("writePng: the pixel count does not match the size");
    PngWriter writer(path, {image.width, image.height, image.channels});
    writer.addRows(image.pixels);
    writer.finish();
}

void writePng16(const std::string& path, std::uint32_t width, std::span<const std::uint16_t> numbers) {
    if (width == 0 || numbers.size() % width != 0) throw std::logic_error("writePng16: not whole rows");
    PngWriter writer(path, {width, static_cast<std::uint32_t>(numbers.size() / width), 1, 16, false});
    writer.addRows({reinterpret_cast<const std::uint8_t*>(numbers.data()), numbers.size_bytes()});
    writer.finish();
}

} // namespace pointrt
