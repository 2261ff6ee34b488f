// SPDX-License-Identifier: Apache-2.0
// Heights in GeoTIFF files, written here byte by byte.
#include "tests/preprocess/input/input_fixture.h"

namespace pointrt {
namespace {

using GeoTiffTest = InputTest;

/// A little-endian TIFF in the making: a directory of tags behind the values.
class TiffBytes {
public:
    void shorts(std::uint16_t tag, const std::vector<std::uint16_t>& values) { add(tag, 3, values); }
    void words(std::uint16_t tag, const std::vector<std::uint32_t>& values) { add(tag, 4, values); }
    void doubles(std::uint16_t tag, const std::vector<double>& values) { add(tag, 12, values); }
    void text(std::uint16_t tag, const std::string& value) {
        add(tag, 2, std::vector<char>(value.c_str(), value.c_str() + value.size() + 1));
    }
    /// Returns the place of the bytes.
    std::uint32_t data(const std::string& bytes) {
        const auto at = static_cast<std::uint32_t>(8 + values_.size());
        values_ += bytes + std::string(bytes.size() % 2, '\0');
        return at;
    }
    std::string bytes() const {
        std::string all = "II*" + std::string(1, '\0') + bytesOf(std::uint32_t(8 + values_.size())) + values_;
        all += bytesOf(std::uint16_t(entries_.size()));
        for (const auto& [tag, entry] : entries_) all += entry; // tags ascend
        return all + bytesOf(0u);
    }

private:
    template <typename Value>
    void add(std::uint16_t tag, std::uint16_t type, const std::vector<Value>& values) {
        std::string stored;
        for (const Value value : values) stored += bytesOf(value);
        if (stored.size() > 4) stored = bytesOf(data(stored));
        stored.resize(4, '\0');
        entries_[tag] = bytesOf(tag) + bytesOf(type) + bytesOf(std::uint32_t(values.size())) + stored;
    }

    std::string values_;
    std::map<std::uint16_t, std::string> entries_;
};

template <typename Value>
std::string packedHeights(const std::vector<Value>& heights) {
    std::string bytes;
    for (const Value height : heights) bytes += bytesOf(height);
    return bytes;
}

enum class SampleKind : std::uint16_t { kUnsigned = 1, kSigned = 2, kReal = 3 };

/// A strip of `columns` cells a row.
TiffBytes grid(const std::string& heights, std::uint16_t bits, SampleKind kind, std::uint32_t columns,
               std::uint32_t rows) {
    TiffBytes tiff;
    tiff.words(256, {columns});
    tiff.words(257, {rows});
    tiff.shorts(258, {bits});
    tiff.shorts(259, {1}); // uncompressed
    tiff.shorts(262, {1});
    tiff.words(273, {tiff.data(heights)});
    tiff.shorts(277, {1});
    tiff.words(278, {rows});
    tiff.words(279, {std::uint32_t(heights.size())});
    tiff.shorts(339, {static_cast<std::uint16_t>(kind)});
    return tiff;
}

/// Cells of 2 units, whose upper left corner is at (100, 200).
void place(TiffBytes& tiff, std::uint16_t raster_type) {
    tiff.doubles(33550, {2, 2, 0});
    tiff.doubles(33922, {0, 0, 0, 100, 200, 0});
    tiff.shorts(34735, {1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, raster_type, 3072, 0, 1, 32633});
}

TEST_F(GeoTiffTest, CellsOfAStripInTheirCoordinateSystem) {
    TiffBytes tiff = grid(packedHeights<float>({1, 2, -9999, 4}), 32, SampleKind::kReal, 2, 2);
    place(tiff, 1);
    tiff.text(42113, "-9999");
    const Cloud cloud = readText("a.tif", tiff.bytes());
    ASSERT_EQ(cloud.positions.size(), 3u);
    EXPECT_EQ(world(cloud, 0), Vec3d(101, 199, 1));
    EXPECT_EQ(world(cloud, 1), Vec3d(103, 199, 2));
    EXPECT_EQ(world(cloud, 2), Vec3d(103, 197, 4));
    EXPECT_EQ(cloud.world.crs, "EPSG:32633");
    EXPECT_EQ(cloud.world.metres_per_unit, 1);
    EXPECT_TRUE(cloud.world.from_above);
    EXPECT_HAS(notesOf(cloud), "1 of 4 cells");
}

TEST_F(GeoTiffTest, PixelsThatArePointsLieAtTheirCorner) {
    TiffBytes tiff = grid(packedHeights<std::int16_t>({-5, 7}), 16, SampleKind::kSigned, 2, 1);
    place(tiff, 2);
    const Cloud cloud = readText("a.tif", tiff.bytes());
    EXPECT_EQ(world(cloud, 0), Vec3d(100, 200, -5));
    EXPECT_EQ(world(cloud, 1), Vec3d(102, 200, 7));
}

TEST_F(GeoTiffTest, TransformsOfPixels) {
    TiffBytes tiff = grid(packedHeights<double>({1, 2}), 64, SampleKind::kReal, 1, 2);
    tiff.doubles(34264, {0, 3, 0, 10, 4, 0, 0, 20, 0, 0, 0, 0, 0, 0, 0, 1}); // rows run east, columns north
    const Cloud cloud = readText("a.tif", tiff.bytes());
    EXPECT_EQ(world(cloud, 0), Vec3d(11.5, 22, 1));
    EXPECT_EQ(world(cloud, 1), Vec3d(14.5, 22, 2));
}

TEST_F(GeoTiffTest, TilesAreCroppedToTheImage) {
    std::vector<std::uint16_t> heights(2 * 16 * 16);
    heights[1] = 11;            // tile 0, row 0, column 1
    heights[256 + 16 + 0] = 22; // tile 1, row 1, column 0: column 16 of the image
    TiffBytes tiff;
    const std::string bytes = packedHeights(heights);
    const std::uint32_t at = tiff.data(bytes);
    tiff.words(256, {17});
    tiff.words(257, {2});
    tiff.shorts(258, {16});
    tiff.shorts(259, {1});
    tiff.shorts(262, {1});
    tiff.shorts(277, {1});
    tiff.words(322, {16});
    tiff.words(323, {16});
    tiff.words(324, {at, at + 512});
    tiff.words(325, {512, 512});
    const Cloud cloud = readText("a.tif", tiff.bytes());
    ASSERT_EQ(cloud.positions.size(), 34u);
    EXPECT_EQ(world(cloud, 1), Vec3d(1, 0, 11));
    EXPECT_EQ(world(cloud, 33), Vec3d(16, -1, 22));
    EXPECT_HAS(notesOf(cloud), "1 unit apart");
}

TEST_F(GeoTiffTest, PicturesAndFalsePromisesAreRefused) {
    EXPECT_HAS(reasonOfText("a.tif", grid("abcd", 8, SampleKind::kUnsigned, 2, 2).bytes()), "8 bits");
    const std::string four = packedHeights<float>({1, 2, 3, 4});
    EXPECT_HAS(reasonOfText("b.tif", grid(four, 32, SampleKind::kReal, 1u << 20, 1u << 20).bytes()),
               "1048576 x 1048576");
    EXPECT_HAS(reasonOfText("c.tif", grid(four, 32, SampleKind::kReal, 2, 1000).bytes()), "strip 0");
}

TEST_F(GeoTiffTest, DamagedFilesAreReadOrRefused) {
    TiffBytes tiff = grid(packedHeights<float>({1, 2, 3, 4}), 32, SampleKind::kReal, 2, 2);
    place(tiff, 1);
    tiff.text(42113, "-9999");
    readChangedBytes("a.tif", tiff.bytes());
    readPrefixes("a.tif", tiff.bytes());
}

} // namespace
} // namespace pointrt
