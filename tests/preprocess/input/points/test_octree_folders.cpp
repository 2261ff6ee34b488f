// SPDX-License-Identifier: Apache-2.0
// Scans that other programs read: folders in folders, EPT, Potree 2, ESRI grids, headers that leave things out.
#include <brotli/encode.h>
#include <fstream>
#include <zstd.h>

#include "tests/preprocess/input/input_fixture.h"
#include "tests/support/las_file.h"

#include "format/pointio/laz.h"
#include "preprocess/input/detect.h"
#include "preprocess/input/folders.h"

namespace pointrt {
namespace {

struct FolderTest : InputTest {
    std::string writeIn(const std::string& path, const std::string& bytes) const {
        std::filesystem::create_directories((folder / path).parent_path());
        return write(path, bytes);
    }
    /// x, y, z and colour of points at whole coordinates.
    static std::string potreePoints(const std::vector<std::array<int, 3>>& points) {
        std::string bytes;
        for (const auto& point : points) {
            for (const int value : point) bytes += bytesOf(value * 100);
            bytes += bytesOf(std::uint16_t{7});
            for (const int value : point) bytes += bytesOf(static_cast<std::uint16_t>(value * 256));
        }
        return bytes;
    }
    static std::string potreeNode(int type, int children, std::uint32_t points, std::uint64_t at, std::uint64_t size) {
        return std::string{static_cast<char>(type), static_cast<char>(children)} + bytesOf(points) + bytesOf(at) +
               bytesOf(size);
    }
    /// Root with one point, its children 0 and 7 with one and two; the latter in a chunk of its own.
    std::string potree() const {
        const std::string octree = potreePoints({{4, 4, 4}, {1, 1, 1}, {6, 7, 5}, {7, 7, 7}});
        writeIn("p/octree.bin", octree);
        const std::string first =
            potreeNode(0, 0x81, 1, 0, 20) + potreeNode(1, 0, 1, 20, 20) + potreeNode(2, 0, 2, 66, 22);
        writeIn("p/hierarchy.bin", first + potreeNode(1, 0, 2, 40, 40));
        return writeIn(
            "p/metadata.json",
            R"({"version":"2.0","points":4,"projection":"","hierarchy":{"firstChunkSize":66,"stepSize":4},)"
            R"("offset":[1000,0,0],"scale":[0.01,0.01,0.01],"boundingBox":{"min":[1000,0,0],"max":[1008,8,8]},)"
            R"("encoding":"DEFAULT","attributes":[{"name":"position","numElements":3,"type":"int32"},)"
            R"({"name":"intensity","numElements":1,"type":"uint16"},{"name":"rgb","numElements":3,"type":"uint16"}]})");
    }
};

TEST_F(FolderTest, PotreeOctrees) {
    const std::string path = potree();
    EXPECT_EQ(filesOf({(folder / "p").string()}), std::vector{path});
    const Cloud cloud = read(path);
    ASSERT_EQ(cloud.positions.size(), 4u);
    EXPECT_EQ(world(cloud, 0), Vec3d(1004, 4, 4));
    EXPECT_EQ(world(cloud, 2), Vec3d(1006, 7, 5));
    EXPECT_EQ(cloud.colors.at(2), (Rgb8{6, 7, 5}));
    EXPECT_EQ(numbersOf(cloud, "intensity"), (Numbers{7, 7, 7, 7}));
    ReadOptions options;
    options.level = 0;
    EXPECT_EQ(read(path, options).positions.size(), 1u);
    options.level.reset();
    options.filter.bounds = Eigen::AlignedBox3d(Vec3d(1005, 5, 4.5), Vec3d(1006.5, 8, 8));
    EXPECT_EQ(read(path, options).positions.size(), 1u);
}

TEST_F(FolderTest, DamagedPotreeOctreesAreRefused) {
    const std::string path = potree();
    const auto with = [&](const char* name, const std::string& bytes) {
        potree();
        writeIn(std::string("p/") + name, bytes);
        return reasonOf(path);
    };
    EXPECT_HAS(with("octree.bin", "short"), "octree.bin: truncated");
    EXPECT_HAS(with("hierarchy.bin", potreeNode(2, 0, 2, 0, 22) + std::string(44, '\0')), "hierarchy.bin: *cyclic");
    EXPECT_HAS(with("hierarchy.bin", "short"), "hierarchy.bin: *outside");
    std::filesystem::remove(folder / "p/hierarchy.bin");
    EXPECT_HAS(reasonOf(path), "hierarchy.bin: no such file");
    EXPECT_HAS(reasonOf(writeIn(
                   "q/metadata.json",
                   R"({"hierarchy":{"firstChunkSize":22},"attributes":[],"boundingBox":{},"encoding":"BROTLI"})")),
               "metadata.json:scale");
    EXPECT_HAS(
        reasonOf(writeIn("r/metadata.json",
                         R"({"hierarchy":{"firstChunkSize":22},"attributes":[],"boundingBox":{},"encoding":"LZMA"})")),
        "'LZMA'");
}

std::uint64_t mortonOf(const std::array<std::uint32_t, 3>& values) {
    std::uint64_t code = 0;
    for (int bit = 0; bit < 16; ++bit)
        for (int axis = 0; axis < 3; ++axis)
            code |= std::uint64_t{values[static_cast<std::size_t>(axis)] >> bit & 1} << (3 * bit + axis);
    return code;
}

std::string brotli(const std::string& bytes) {
    std::size_t size = BrotliEncoderMaxCompressedSize(bytes.size());
    std::string packed(size, '\0');
    BrotliEncoderCompress(5, BROTLI_DEFAULT_WINDOW, BROTLI_DEFAULT_MODE, bytes.size(),
                          reinterpret_cast<const std::uint8_t*>(bytes.data()), &size,
                          reinterpret_cast<std::uint8_t*>(packed.data()));
    packed.resize(size);
    return packed;
}

TEST_F(FolderTest, PotreeOctreesWithBrotli) {
    // one node: Morton codes of the high and the low halves of positions, intensities, Morton codes of colours
    const std::array<std::uint32_t, 3> places[] = {{70000, 400, 65536}, {1, 2, 3}};
    std::string positions, colors;
    for (const auto& place : places) {
        positions += bytesOf(mortonOf({place[0] >> 16, place[1] >> 16, place[2] >> 16})) +
                     bytesOf(mortonOf({place[0] & 0xffff, place[1] & 0xffff, place[2] & 0xffff}));
        colors += bytesOf(mortonOf({65280, 256, place[2] & 255}));
    }
    const std::string node = brotli(positions + bytesOf(std::uint16_t{7}) + bytesOf(std::uint16_t{9}) + colors);
    potree();
    writeIn("p/octree.bin", node);
    writeIn("p/hierarchy.bin", potreeNode(1, 0, 2, 0, node.size()) + std::string(44, '\0'));
    std::ifstream file(folder / "p/metadata.json");
    std::string meta{std::istreambuf_iterator<char>(file), {}};
    meta.replace(meta.find("DEFAULT"), 7, "BROTLI");
    const std::string path = writeIn("p/metadata.json", meta);
    const Cloud cloud = read(path);
    ASSERT_EQ(cloud.positions.size(), 2u);
    EXPECT_TRUE(world(cloud, 0).isApprox(Vec3d(1700, 4, 655.36), 1e-6));
    EXPECT_EQ(cloud.colors.at(1), (Rgb8{255, 1, 0}));
    EXPECT_EQ(numbersOf(cloud, "intensity"), (Numbers{7, 9}));
    for (std::size_t i = 0; i < node.size(); ++i) {
        std::string changed = node;
        changed[i] ^= '\x55';
        writeIn("p/octree.bin", changed);
        try {
            read(path);
        } catch (const Error& error) {
            ASSERT_EQ(error.code, ExitCode::kBadInput) << error.what();
        }
    }
    writeIn("p/hierarchy.bin", potreeNode(1, 0, 4000000000, 0, node.size()) + std::string(44, '\0'));
    EXPECT_HAS(reasonOf(path), "hierarchy.bin: *4000000000");
}

TEST_F(FolderTest, EptFolders) {
    const auto node = [](std::vector<std::array<int, 3>> places) {
        test::LasParts parts;
        parts.scale = 1;
        for (const auto& [x, y, z] : places) parts.points.push_back(test::lasPoint(20, x, y, z, 0));
        return parts.bytes(); // uncompressed points are read as well
    };
    const std::string meta = writeIn(
        "e/ept.json", R"({"bounds":[0,0,0,8,8,8],"dataType":"laszip","hierarchyType":"json","points":4,"schema":[]})");
    EXPECT_HAS(reasonOf(meta), "ept.json: *ept-data");
    writeIn("e/ept-data/0-0-0-0.laz", node({{4, 4, 4}}));
    writeIn("e/ept-data/1-0-0-0.laz", node({{1, 1, 1}, {2, 2, 2}}));
    writeIn("e/ept-data/1-1-1-1.laz", node({{7, 7, 7}}));
    writeIn("e/ept-data/notes.txt", "x");
    EXPECT_EQ(filesOf({(folder / "e").string()}), std::vector{meta});
    const Cloud cloud = read(meta);
    EXPECT_EQ(cloud.positions.size(), 4u);
    EXPECT_EQ(cloud.scans.size(), 1u);
    EXPECT_EQ(world(cloud, 3), Vec3d(7, 7, 7));
    ReadOptions options;
    options.level = 0;
    EXPECT_EQ(read(meta, options).positions.size(), 1u);
    options.level.reset();
    options.filter.bounds = Eigen::AlignedBox3d(Vec3d(6, 6, 6), Vec3d(9, 9, 9));
    EXPECT_EQ(read(meta, options).positions.size(), 1u);
    options.filter.bounds = Eigen::AlignedBox3d(Vec3d(60, 6, 6), Vec3d(90, 9, 9));
    EXPECT_HAS(reasonOf(meta, options), "ept.json: none of its 3 nodes");
    EXPECT_HAS(reasonOf(writeIn("f/ept.json",
                                R"({"bounds":[0,0,0,8,8,8],"dataType":"text","hierarchyType":"json","schema":[]})")),
               "f/ept.json: *'text'");
}

TEST_F(FolderTest, EptFoldersOfBareRecords) {
    const auto record = [](int x, std::uint8_t label) {
        return bytesOf(x) + bytesOf(200) + bytesOf(300) + bytesOf(label) + bytesOf(std::uint16_t{65280}) +
               bytesOf(std::uint16_t{0}) + bytesOf(std::uint16_t{256});
    };
    const std::string meta = R"({"bounds":[0,0,0,8,8,8],"dataType":"binary","hierarchyType":"json","schema":[)"
                             R"({"name":"X","type":"signed","size":4,"scale":0.01,"offset":1000},)"
                             R"({"name":"Y","type":"signed","size":4,"scale":0.01,"offset":0},)"
                             R"({"name":"Z","type":"signed","size":4,"scale":0.01,"offset":0},)"
                             R"({"name":"Classification","type":"unsigned","size":1},)"
                             R"({"name":"Red","type":"unsigned","size":2},{"name":"Green","type":"unsigned","size":2},)"
                             R"({"name":"Blue","type":"unsigned","size":2}]})";
    const std::string root = record(100, 2), child = record(500, 6);
    writeIn("b/ept-data/0-0-0-0.bin", root);
    writeIn("b/ept-data/1-0-0-0.bin", child);
    const auto expectRecords = [](const Cloud& cloud) {
        ASSERT_EQ(cloud.positions.size(), 2u);
        EXPECT_EQ(cloud.scans.size(), 1u);
        EXPECT_EQ(world(cloud, 1), Vec3d(1005, 2, 3));
        EXPECT_EQ(cloud.colors.at(1), (Rgb8{255, 0, 1}));
        EXPECT_EQ(numbersOf(cloud, "classification"), (Numbers{2, 6}));
    };
    expectRecords(read(writeIn("b/ept.json", meta)));
    std::string packed = meta;
    packed.replace(packed.find("binary"), 6, "zstandard");
    const auto packedNode = [](const std::string& bytes) {
        std::string out(ZSTD_compressBound(bytes.size()), '\0');
        out.resize(ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), 1));
        return out;
    };
    writeIn("z/ept-data/0-0-0-0.zst", packedNode(root));
    writeIn("z/ept-data/1-0-0-0.zst", packedNode(child));
    const std::string path = writeIn("z/ept.json", packed);
    expectRecords(read(path));
    writeIn("z/ept-data/1-0-0-0.zst", packedNode(child + "x"));
    EXPECT_HAS(reasonOf(path), "1-0-0-0.zst: *20 bytes");
    writeIn("z/ept-data/1-0-0-0.zst", "junk");
    EXPECT_HAS(reasonOf(path), "1-0-0-0.zst: *zstd");
}

TEST_F(FolderTest, FoldersInFolders) {
    const std::string b = writeIn("top/b/2.ply", "x"), a = writeIn("top/a/deep/1.xyz", "x");
    writeIn("top/.hidden/3.ply", "x");
    EXPECT_EQ(filesOf({(folder / "top").string()}), (std::vector{a, b}));
    writeIn("top/readme.txt", "Scans of the castle\n"); // no points: the files below are meant
    EXPECT_EQ(filesOf({(folder / "top").string()}), (std::vector{a, b}));
    writeIn("top/scene.bin", "x");                                               // may be a part of another file
    const std::string text = writeIn("about/scan.txt", "Scans of the castle\n"); // its reader says what is wrong
    EXPECT_EQ(filesOf({(folder / "about").string()}), std::vector{text});
    const std::string own = writeIn("top/0.ply", "x"); // then the folder itself is meant
    EXPECT_EQ(filesOf({(folder / "top").string()}), std::vector{own});
    std::filesystem::create_symlink(folder / "gone.ply", folder / "top/gone.ply"); // reported when opened
    EXPECT_EQ(filesOf({(folder / "top").string()}), (std::vector{own, (folder / "top/gone.ply").string()}));
    std::filesystem::create_directories(folder / "loop");
    std::filesystem::create_directory_symlink(folder / "loop", folder / "loop/again");
    EXPECT_THROW(filesOf({(folder / "loop").string()}), Error);
}

TEST_F(FolderTest, EsriGrids) {
    const std::string header = "ncols 3\nnrows 2\nxllcorner 100\nyllcorner 200\ncellsize 2\nNODATA_value -9999\n";
    const Cloud cloud = readText("a.asc", header + "1 2 -9999\n4 5 6\n");
    ASSERT_EQ(cloud.positions.size(), 5u);
    EXPECT_EQ(world(cloud, 0), Vec3d(101, 203, 1)); // rows start in the north
    EXPECT_EQ(world(cloud, 1), Vec3d(103, 203, 2));
    EXPECT_EQ(world(cloud, 4), Vec3d(105, 201, 6));
    EXPECT_HAS(notesOf(cloud), "1 of 6 cells *no data");
    EXPECT_EQ(cloud.world.up, Vec3d(0, 0, 1));
    const Cloud centres = readText("b.txt", "NCOLS 1\nNROWS 2\nXLLCENTER 5\nYLLCENTER 7\nDX 1\nDY 3\n1 2");
    EXPECT_EQ(world(centres, 0), Vec3d(5, 10, 1));
    EXPECT_EQ(world(centres, 1), Vec3d(5, 7, 2));
    // ESRI's default
    EXPECT_HAS(notesOf(readText("e.asc", "ncols 3\nnrows 1\ncellsize 1\n1 -9999 2")), "1 of 3 cells *no data");
    EXPECT_EQ(world(readText("f.asc", "ncols 2\nnrows 1\nxllcorner 0,5\nyllcorner 0\ncellsize 1\n1,25 2\n"), 0),
              Vec3d(1, 0.5, 1.25)); // with commas
    EXPECT_HAS(reasonOfText("c.asc", header + "1 2 3 4"), "c.asc: *3 x 2 cells");
    EXPECT_HAS(reasonOfText("c.asc", header + "1 2 3 4 5        "), "c.asc: *5 of 6 ");
    EXPECT_HAS(reasonOfText("c.asc", header + "1 2 3 four 5 6"), "c.asc:7: 'four'");
    EXPECT_HAS(reasonOfText("c.asc", "ncols 3\nnrows 2\n1 2 3 4 5 6"), "c.asc: *cellsize");
    EXPECT_HAS(reasonOfText("c.asc", "ncols 99999999999\nnrows 99999999999\ncellsize 1\n1"), "c.asc: *cells");
    readPrefixes("d.asc", header + "1 2 -9999\n4 5 6\n");
}

TEST_F(FolderTest, PaddingOfPcdMayTakeNoBytes) {
    const std::string head =
        "VERSION 0.7\nFIELDS x y z _ i _\nSIZE 4 4 4 1 4 1\nTYPE F F F U U U\nCOUNT 1 1 1 0 1 3\nWIDTH "
        "2\nHEIGHT 1\nPOINTS 2\n";
    std::string body;
    for (const float value : {1.0f, 2.0f}) {
        for (int axis = 0; axis < 3; ++axis) body += bytesOf(value);
        body += bytesOf(std::uint32_t{9}) + "abc";
    }
    for (const Cloud& cloud : {readText("a.pcd", head + "DATA binary\n" + body),
                               readText("b.pcd", head + "DATA ascii\n1 1 1 9 0 0 0\n2 2 2 9 0 0 0\n")}) {
        ASSERT_EQ(cloud.positions.size(), 2u);
        EXPECT_EQ(world(cloud, 1), Vec3d(2, 2, 2));
        EXPECT_EQ(numbersOf(cloud, "i"), (Numbers{9, 9}));
    }
}

TEST_F(FolderTest, LasWithoutItsCountIsCountedByItsBytes) {
    test::LasParts parts;
    parts.minor = 4;
    parts.points = {test::lasPoint(20, 1, 2, 3, 0), test::lasPoint(20, 4, 5, 6, 0)};
    std::string bytes = parts.bytes();
    test::put(bytes, 247, std::uint64_t{0});
    EXPECT_EQ(readText("legacy.las", bytes).positions.size(), 2u); // only the count of 32 bits
    test::put(bytes, 107, std::uint32_t{0});
    const Cloud cloud = readText("none.las", bytes);
    EXPECT_EQ(cloud.positions.size(), 2u);
    EXPECT_HAS(notesOf(cloud), "none.las: *0 points *2 ");
    parts.extended_records = {test::lasRecord("x", 1, std::string(100, 'x'), true)};
    bytes = parts.bytes();
    test::put(bytes, 247, std::uint64_t{0});
    test::put(bytes, 107, std::uint32_t{0});
    EXPECT_EQ(readText("records.las", bytes).positions.size(), 2u);
}

TEST_F(FolderTest, Las15) {
    test::LasParts parts;
    parts.minor = 4;
    parts.format = 6;
    parts.points = {test::lasPoint(30, 1, 2, 3, 0), test::lasPoint(30, 4, 5, 6, 0)};
    std::string bytes = parts.bytes();
    test::put(bytes, 25, std::uint8_t{5});
    EXPECT_EQ(readText("a.las", bytes).positions.size(), 2u);
    test::put(bytes, 25, std::uint8_t{6});
    EXPECT_HAS(reasonOfText("b.las", bytes), "b.las: *1.6");
}

} // namespace
} // namespace pointrt
