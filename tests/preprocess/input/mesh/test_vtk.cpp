// SPDX-License-Identifier: Apache-2.0
// Files of VTK: legacy and XML.
#include "format/pointio/base64.h"
#include "tests/preprocess/input/input_fixture.h"

namespace pointrt {
namespace {

using VtkTest = InputTest;

std::string bigEndian(const std::vector<float>& list) {
    std::string bytes;
    for (const float value : list) bytes += bytesOf(value, true);
    return bytes;
}

const std::string kAscii =
    "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n0 0 0 1 0 0\n1 1 0 0 1 0\n"
    "POLYGONS 1 5\n4 0 1 2 3\nCELL_DATA 1\nSCALARS cells float 1\nLOOKUP_TABLE default\n7\n";

const std::string kBinary =
    "# vtk DataFile Version 5.1\ntitle\nBINARY\nDATASET POLYDATA\nPOINTS 2 float\n" + bigEndian({1, 2, 3, 4, 5, 6}) +
    "\nMETADATA\nINFORMATION 0\n\nVERTICES 3 2\nOFFSETS vtktypeint64\n" + bytesOf(std::int64_t{0}, true) +
    bytesOf(std::int64_t{1}, true) + bytesOf(std::int64_t{2}, true) + "\nCONNECTIVITY vtktypeint64\n" +
    bytesOf(std::int64_t{0}, true) + bytesOf(std::int64_t{1}, true) +
    "\nPOINT_DATA 2\nCOLOR_SCALARS RGB 3\n\x01\x02\x03\x04\x05\xff\nNORMALS n float\n" + bigEndian({0, 0, 1, 0, 1, 0}) +
    "\nFIELD FieldData 1\nintensity 1 2 float\n" + bigEndian({0.5, 0.25}) + "\n";

TEST_F(VtkTest, PolygonsOfLegacyText) {
    const Cloud cloud = readText("a.vtk", kAscii);
    EXPECT_EQ(cloud.positions.size(), 4u);
    ASSERT_EQ(cloud.triangles.size(), 2u); // triangulation of one polygon
    EXPECT_EQ(cloud.triangles[1], (std::array<std::uint32_t, 3>{0, 2, 3}));
}

void expectVtkPoints(const Cloud& cloud) {
    ASSERT_EQ(cloud.positions.size(), 2u);
    EXPECT_EQ(world(cloud, 1), Vec3d(4, 5, 6));
    EXPECT_EQ(cloud.colors.at(1), (Rgb8{4, 5, 255}));
    EXPECT_EQ(cloud.normals.at(1), Vec3f(0, 1, 0));
    EXPECT_EQ(numbersOf(cloud, "intensity"), (Numbers{0.5, 0.25}));
}

TEST_F(VtkTest, ArraysOfLegacyBinary) { expectVtkPoints(readText("a.vtk", kBinary)); }

template <typename Value>
std::string vtkValues(const std::vector<Value>& list) {
    std::string bytes;
    for (const Value value : list) bytes += bytesOf(value);
    return bytes;
}

struct XmlArrays {
    std::string points = vtkValues<float>({1, 2, 3, 4, 5, 6}), colors = "\x01\x02\x03\x04\x05\xff",
                normals = vtkValues<float>({0, 0, 1, 0, 1, 0}), intensity = vtkValues<float>({0.5, 0.25});
};

/// store(bytes) returns the attributes and the text of an array.
template <typename Store>
std::string xml(const std::string& file_attributes, const Store& store, const std::string& appended = "") {
    const auto array = [&](const char* what, const std::string& bytes) {
        const auto [attributes, text] = store(bytes);
        return fmt::format("<DataArray {} {}>{}</DataArray>\n", what, attributes, text);
    };
    const XmlArrays arrays;
    return fmt::format(
               "<?xml version=\"1.0\"?>\n<!-- <Piece> -->\n<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\""
               " {}>\n<PolyData>\n<Piece NumberOfPoints=\"2\" NumberOfPolys=\"0\">\n<PointData>\n",
               file_attributes) +
           array("type='UInt8' Name='RGB' NumberOfComponents='3'", arrays.colors) +
           array("type='Float32' Name='Normals' NumberOfComponents='3'", arrays.normals) +
           array("type='Float32' Name='intensity'", arrays.intensity) + "</PointData>\n<Points>\n" +
           array("type='Float32' NumberOfComponents='3'", arrays.points) + "</Points>\n</Piece>\n</PolyData>\n" +
           appended + "</VTKFile>\n";
}

using Stored = std::pair<std::string, std::string>;

std::string inBase64() {
    return xml("header_type='UInt32'", [](const std::string& bytes) {
        return Stored{"format='binary'", "\n" + toBase64(bytesOf(std::uint32_t(bytes.size())) + bytes) + "\n"};
    });
}

std::string deflated(const std::string& bytes) {
    uLongf size = compressBound(bytes.size());
    std::string packed(size, '\0');
    compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
             bytes.size());
    packed.resize(size);
    return packed;
}

/// Appended raw: a block of each array, with its sizes in front.
std::string appended() {
    std::string data;
    const std::string start =
        xml("header_type='UInt64' compressor='vtkZLibDataCompressor'", [&](const std::string& bytes) {
            const std::string packed = deflated(bytes);
            const Stored stored{fmt::format("format='appended' offset='{}'", data.size()), ""};
            data += vtkValues<std::uint64_t>({1, 32768, bytes.size(), packed.size()}) + packed;
            return stored;
        });
    const std::string end = "</VTKFile>\n";
    return start.substr(0, start.size() - end.size()) + "<AppendedData encoding=\"raw\">\n_" + data +
           "\n</AppendedData>\n" + end;
}

TEST_F(VtkTest, ArraysOfXmlInBase64) { expectVtkPoints(readText("a.vtp", inBase64())); }

TEST_F(VtkTest, ArraysOfXmlAppendedAndCompressed) { expectVtkPoints(readText("a.vtp", appended())); }

TEST_F(VtkTest, PolygonsOfXmlText) {
    const Cloud cloud = readText(
        "a.vtp", "<VTKFile type='PolyData'><PolyData><Piece NumberOfPoints='3' NumberOfPolys='1'><Points>"
                 "<DataArray type='Float64' NumberOfComponents='3' format='ascii'>0 0 0 1 0 0 0 1 0</DataArray>"
                 "</Points><Polys><DataArray type='Int64' Name='connectivity' format='ascii'>0 1 2</DataArray>"
                 "<DataArray type='Int64' Name='offsets' format='ascii'>3</DataArray></Polys></Piece>"
                 "</PolyData></VTKFile>");
    EXPECT_EQ(cloud.triangles.size(), 1u);
}

TEST_F(VtkTest, OtherDataSetsAndFalsePromisesAreRefused) {
    EXPECT_HAS(reasonOfText("a.vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_POINTS\n"),
               "STRUCTURED_POINTS");
    EXPECT_HAS(
        reasonOfText("b.vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 9999999999 float\n1"),
        "truncated");
    std::string outside = kAscii;
    outside.replace(outside.find("4 0 1 2 3"), 9, "4 0 1 2 4");
    EXPECT_HAS(reasonOfText("c.vtk", outside), "vertex index 4");
    EXPECT_HAS(reasonOfText("d.vti", "<VTKFile type=\"ImageData\"></VTKFile>"), "ImageData");
    EXPECT_HAS(reasonOfText("e.vtp", "<VTKFile type=\"PolyData\"></VTKFile>"), "no piece");
}

TEST_F(VtkTest, DamagedFilesAreReadOrRefused) {
    readChangedBytes("a.vtk", kAscii);
    readChangedBytes("b.vtk", kBinary);
    readChangedBytes("c.vtp", inBase64());
    readChangedBytes("d.vtp", appended());
}

} // namespace
} // namespace pointrt
