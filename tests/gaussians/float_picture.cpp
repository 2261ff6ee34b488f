// SPDX-License-Identifier: Apache-2.0
#include "tests/gaussians/float_picture.h"

#include <bit>
#include <fstream>
#include <stdexcept>

namespace pointrt::test {

namespace {

static_assert(std::endian::native == std::endian::little, "values are read and written as they lie in memory");

constexpr std::uint32_t kLargestSide = 1 << 16;

/// Calls use with the values of each row in the order of files.
template <typename Picture, typename Use>
void forRowsUpwards(Picture& picture, const Use& use) {
    const std::size_t row_values = std::size_t{picture.width} * picture.channels;
    for (std::size_t row = picture.height; row-- > 0;)
        use(picture.values.data() + row * row_values, static_cast<std::streamsize>(row_values * sizeof(float)));
}

} // namespace

void writePfm(const std::string& path, const FloatPicture& picture) {
    std::ofstream file(path, std::ios::binary);
    file << (picture.channels == 3 ? "PF\n" : "Pf\n") << picture.width << ' ' << picture.height << "\n-1.0\n";
    forRowsUpwards(picture, [&](const float* row, std::streamsize bytes) {
        file.write(reinterpret_cast<const char*>(row), bytes);
    });
    if (!file.flush()) throw std::runtime_error(path + ": cannot be written");
}

FloatPicture readPfm(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::string kind;
    double byte_order = 0;
    FloatPicture picture;
    file >> kind >> picture.width >> picture.height >> byte_order;
    file.get(); // the line feed
    if (!file || (kind != "PF" && kind != "Pf") || byte_order >= 0 || picture.width > kLargestSide ||
        picture.height > kLargestSide)
        throw std::runtime_error(path + ": not a little-endian PFM");
    picture.channels = kind == "PF" ? 3 : 1;
    picture.values.resize(std::size_t{picture.width} * picture.height * picture.channels);
    forRowsUpwards(picture, [&](float* row, std::streamsize bytes) { file.read(reinterpret_cast<char*>(row), bytes); });
    if (!file) throw std::runtime_error(path + ": ends too early");
    return picture;
}

} // namespace pointrt::test
