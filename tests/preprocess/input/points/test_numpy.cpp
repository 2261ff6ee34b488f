// SPDX-License-Identifier: Apache-2.0
// Arrays of NumPy, as numpy.save and numpy.savez write them.
#include "tests/preprocess/input/input_fixture.h"

namespace pointrt {
namespace {

using NumPyTest = InputTest;

std::string npy(const std::string& type, const std::string& shape, const std::string& data, bool fortran = false) {
    std::string header =
        fmt::format("{{'descr': {}, 'fortran_order': {}, 'shape': {}, }}", type, fortran ? "True" : "False", shape);
    header.resize((header.size() + 11 + 63) / 64 * 64 - 11, ' '); // the data starts at a multiple of 64 bytes
    header += '\n';
    return "\x93NUMPY" + std::string("\1\0", 2) + bytesOf(static_cast<std::uint16_t>(header.size())) + header + data;
}

template <typename Value>
std::string npyValues(const std::vector<Value>& list, bool reversed = false) {
    std::string bytes;
    for (const Value value : list) bytes += bytesOf(value, reversed);
    return bytes;
}

/// An archive of stored members.
std::string zip(const std::vector<std::pair<std::string, std::string>>& members) {
    std::string bytes, directory;
    for (const auto& [name, data] : members) {
        const std::string sizes = bytesOf(0u) + bytesOf(std::uint32_t(data.size())) +
                                  bytesOf(std::uint32_t(data.size())) + bytesOf(std::uint16_t(name.size()));
        const std::string fields = std::string("\x14\0\0\0\0\0\0\0\0\0", 10);
        directory += "PK\x01\x02" + std::string("\x14\0", 2) + fields + sizes + std::string(12, '\0') +
                     bytesOf(std::uint32_t(bytes.size())) + name;
        bytes += "PK\x03\x04" + fields + sizes + std::string(2, '\0') + name + data;
    }
    const auto count = static_cast<std::uint16_t>(members.size());
    return bytes + directory + "PK\x05\x06" + std::string(4, '\0') + bytesOf(count) + bytesOf(count) +
           bytesOf(std::uint32_t(directory.size())) + bytesOf(std::uint32_t(bytes.size())) + std::string(2, '\0');
}

const std::string kThreeRows = npy("'<f8'", "(2, 3)", npyValues<double>({1, 2, 3, 4, 5, 6}));

void expectTwoPoints(const Cloud& cloud) {
    ASSERT_EQ(cloud.positions.size(), 2u);
    EXPECT_EQ(world(cloud, 0), Vec3d(1, 2, 3));
    EXPECT_EQ(world(cloud, 1), Vec3d(4, 5, 6));
}

TEST_F(NumPyTest, RowsInEitherOrderOfBytesAndIndices) {
    expectTwoPoints(readText("a.npy", kThreeRows));
    expectTwoPoints(readText("b.npy", npy("'>f4'", "(2, 3)", npyValues<float>({1, 2, 3, 4, 5, 6}, true))));
    expectTwoPoints(readText("c.npy", npy("'<i8'", "(2, 3)", npyValues<std::int64_t>({1, 4, 2, 5, 3, 6}), true)));
    expectTwoPoints(readText("d.npy", npy("'<f4'", "(1, 2, 3)", npyValues<float>({1, 2, 3, 4, 5, 6}))));
}

TEST_F(NumPyTest, FewRowsOfManyColumnsAreTransposed) {
    std::vector<float> list(3 * 70);
    for (std::size_t i = 0; i < 70; ++i) list[i] = 1 + float(i), list[70 + i] = 2, list[140 + i] = 3;
    const Cloud cloud = readText("a.npy", npy("'<f4'", "(3, 70)", npyValues(list)));
    ASSERT_EQ(cloud.positions.size(), 70u);
    EXPECT_EQ(world(cloud, 69), Vec3d(70, 2, 3));
}

TEST_F(NumPyTest, FurtherColumnsByTheirValues) {
    const Cloud four = readText("a.npy", npy("'<f4'", "(2, 4)", npyValues<float>({1, 2, 3, 0.5, 4, 5, 6, 0.25})));
    EXPECT_EQ(numbersOf(four, "intensity"), (Numbers{0.5, 0.25}));
    const Cloud colors = readText("b.npy", npy("'<f4'", "(1, 6)", npyValues<float>({1, 2, 3, 255, 128, 0})));
    EXPECT_EQ(colors.colors.at(0), (Rgb8{255, 128, 0}));
    const Cloud normals = readText("c.npy", npy("'<f4'", "(1, 6)", npyValues<float>({1, 2, 3, 0, -0.6f, 0.8f})));
    EXPECT_EQ(normals.normals.at(0), Vec3f(0, -0.6f, 0.8f));
    EXPECT_HAS(notesOf(normals), "4 to 6 as normals");
    const Cloud other = readText("d.npy", npy("'<f4'", "(1, 6)", npyValues<float>({1, 2, 3, -7, 900, 5})));
    EXPECT_EQ(attributeNames(other), (Names{"column_4", "column_5", "column_6"}));
}

TEST_F(NumPyTest, StructuredTypesWithPadding) {
    const std::string type = "[('x', '<f4'), ('y', '<f4'), ('z', '<f4'), ('ring', '<u2'), ('', '|V2'), "
                             "('rgb', '|u1', (3,)), ('', '|V1')]";
    const std::string record =
        npyValues<float>({1, 2, 3}) + bytesOf(std::uint16_t{7}) + std::string(2, 'x') + "\x01\x02\xff" + "x";
    const Cloud cloud = readText("a.npy", npy(type, "(1,)", record));
    EXPECT_EQ(world(cloud, 0), Vec3d(1, 2, 3));
    EXPECT_EQ(numbersOf(cloud, "ring"), (Numbers{7}));
    EXPECT_EQ(cloud.colors.at(0), (Rgb8{1, 2, 255}));
}

TEST_F(NumPyTest, ArchivesByTheNamesOfArrays) {
    const std::string bytes = zip({{"colors.npy", npy("'|u1'", "(2, 3)", "\x01\x02\x03\x04\x05\x06")},
                                   {"points.npy", kThreeRows},
                                   {"time.npy", npy("'<f8'", "(2,)", npyValues<double>({10, 20}))},
                                   {"camera.npy", npy("'<f8'", "(4, 4)", npyValues<double>(std::vector<double>(16)))}});
    const Cloud cloud = readText("a.npz", bytes);
    expectTwoPoints(cloud);
    EXPECT_EQ(cloud.colors.at(1), (Rgb8{4, 5, 6}));
    EXPECT_EQ(numbersOf(cloud, "time"), (Numbers{10, 20}));
    EXPECT_HAS(notesOf(cloud), "camera");
    expectTwoPoints(readText("b.npz", zip({{"arr_0.npy", kThreeRows}})));
    EXPECT_HAS(reasonOfText("c.npz", zip({{"labels.npy", npy("'<f8'", "(2,)", npyValues<double>({10, 20}))}})),
               "labels");
}

TEST_F(NumPyTest, RefusesWhatIsNoPoints) {
    EXPECT_HAS(reasonOfText("a.npy", npy("'|O'", "(2, 3)", "")), "|O");
    EXPECT_HAS(reasonOfText("b.npy", npy("'<f8'", "(2, 2)", npyValues<double>({1, 2, 3, 4}))), "(2, 2)");
    EXPECT_HAS(reasonOfText("c.npy", npy("'<f8'", "(2, 3)", npyValues<double>({1, 2, 3, 4}))), "1 of 2");
    EXPECT_HAS(reasonOfText("d.npy", npy("[('a', '<f8')]", "(2,)", npyValues<double>({1, 2}))), "x, y and z");
    EXPECT_HAS(reasonOfText("e.npy", npy("'<f8'", "(9223372036854775807, 3)", "")), "shape");
}

TEST_F(NumPyTest, SalvagesWholeRows) {
    ReadOptions options;
    options.salvages = true;
    const Cloud cloud = read(write("a.npy", npy("'<f8'", "(9, 3)", npyValues<double>({1, 2, 3, 4, 5, 6, 7}))), options);
    expectTwoPoints(cloud);
}

TEST_F(NumPyTest, DamagedFilesAreReadOrRefused) {
    readPrefixes("a.npy", kThreeRows);
    readChangedBytes("a.npy", kThreeRows);
    const std::string archive = zip({{"xyz.npy", npy("'<f4'", "(1, 3)", npyValues<float>({1, 2, 3}))}});
    readPrefixes("a.npz", archive);
    readChangedBytes("a.npz", archive);
}

} // namespace
} // namespace pointrt
