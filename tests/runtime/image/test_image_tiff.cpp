// SPDX-License-Identifier: Apache-2.0
// TIFF files parsed by the rules of the specifications: TIFF 6.0 and GeoTIFF 1.1.
#include "runtime/image/image_tiff.h"

#include <gtest/gtest.h>

#include <zlib.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <map>

#include "tests/support/temporary_folder.h"

namespace pointrt {
namespace {

using TiffBytes = std::vector<std::uint8_t>;

template <typename Number>
Number wordAt(const TiffBytes& bytes, std::size_t offset) {
    Number number{};
    std::memcpy(&number, bytes.data() + offset, sizeof number);
    return number;
}

/// The values of each tag, as doubles.
std::map<int, std::vector<double>> tagsOf(const TiffBytes& bytes) {
    EXPECT_EQ(std::string(bytes.begin(), bytes.begin() + 4), std::string("II\x2A\0", 4));
    const auto directory = wordAt<std::uint32_t>(bytes, 4);
    EXPECT_EQ(directory % 2, 0u);
    std::map<int, std::vector<double>> tags;
    int last = 0;
    for (std::size_t i = 0; i < wordAt<std::uint16_t>(bytes, directory); ++i) {
        const std::size_t entry = directory + 2 + 12 * i;
        const int tag = wordAt<std::uint16_t>(bytes, entry), type = wordAt<std::uint16_t>(bytes, entry + 2);
        const auto count = wordAt<std::uint32_t>(bytes, entry + 4);
        EXPECT_GT(tag, last) << "tags ascend";
        last = tag;
        const std::size_t size = type == 2 ? 1 : type == 3 ? 2 : type == 4 ? 4 : 8;
        const std::size_t at = size * count <= 4 ? entry + 8 : wordAt<std::uint32_t>(bytes, entry + 8);
        for (std::size_t k = 0; k < count; ++k)
            tags[tag].push_back(size == 1   ? bytes[at + k]
                                : size == 2 ? wordAt<std::uint16_t>(bytes, at + 2 * k)
                                : size == 4 ? wordAt<std::uint32_t>(bytes, at + 4 * k)
                                            : wordAt<double>(bytes, at + 8 * k));
    }
    return tags;
}

class ImageTiff : public testing::Test {
protected:
    /// Writes pixels in two unequal parts.
    TiffBytes written(TiffSize size, const TiffBytes& pixels, std::optional<GeoReference> place) {
        const std::string path = folder.file("a.tif");
        TiffWriter writer(path, size, place);
        const std::size_t row = std::size_t{size.width} * size.channels, first = (size.height / 3) * row;
        writer.addRows(std::span(pixels).first(first));
        writer.addRows(std::span(pixels).subspan(first));
        writer.finish();
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }

    const test::TemporaryFolder folder;
};

TEST_F(ImageTiff, PixelsComeBack) {
    const TiffSize size{300, 700, 4};
    TiffBytes pixels(std::size_t{size.width} * size.height * 4);
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<std::uint8_t>(i * i >> 7);
    const TiffBytes bytes = written(size, pixels, {});
    auto tags = tagsOf(bytes);
    EXPECT_EQ(tags[256], std::vector<double>{300});
    EXPECT_EQ(tags[257], std::vector<double>{700});
    EXPECT_EQ(tags[258], std::vector<double>(4, 8));
    EXPECT_EQ(tags[277], std::vector<double>{4});
    EXPECT_EQ(tags[338], std::vector<double>{2}) << "straight alpha";
    EXPECT_EQ(tags.count(33550), 0u) << "no place";
    ASSERT_EQ(tags[273].size(), tags[279].size());
    TiffBytes read;
    for (std::size_t strip = 0; strip < tags[273].size(); ++strip) {
        TiffBytes rows(static_cast<std::size_t>(tags[278][0]) * 300 * 4);
        uLongf got = rows.size();
        ASSERT_EQ(uncompress(rows.data(), &got, bytes.data() + static_cast<std::size_t>(tags[273][strip]),
                             static_cast<uLong>(tags[279][strip])),
                  Z_OK);
        read.insert(read.end(), rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(got));
    }
    EXPECT_EQ(read, pixels);
}

TEST_F(ImageTiff, PlansHaveTheirPlace) {
    const GeoReference place{0.25, 2'635'800.5, 1'182'350, 2056};
    auto tags = tagsOf(written({4, 3, 3}, TiffBytes(36), place));
    EXPECT_EQ(tags[33550], (std::vector<double>{0.25, 0.25, 0}));
    EXPECT_EQ(tags[33922], (std::vector<double>{0, 0, 0, 2'635'800.5, 1'182'350, 0}));
    EXPECT_EQ(tags[34735], (std::vector<double>{1, 1, 1, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 2056}));
    tags = tagsOf(written({4, 3, 3}, TiffBytes(36), GeoReference{0.25, 0, 0, 0}));
    EXPECT_EQ(tags[34735], (std::vector<double>{1, 1, 1, 1, 1025, 0, 1, 1})) << "no coordinate system";
}

TEST(WorldFile, PlacesTheCentreOfTheFirstPixel) {
    EXPECT_EQ(worldFileText({0.25, 2'635'800.5, 1'182'350, 0}), "0.25\n0\n0\n-0.25\n2635800.625\n1182349.875\n");
    EXPECT_EQ(worldFilePath("out/plan.of.site.png"), "out/plan.of.site.pgw");
}

} // namespace
} // namespace pointrt
