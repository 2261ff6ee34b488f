// SPDX-License-Identifier: Apache-2.0
// pointrt-info --export FILE.las and FILE.laz: attributes in fields of LAS or in extra bytes.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <nlohmann/json.hpp>

#include "file_bytes.h"
#include "format/pointio/las_crs.h"
#include "format/pointio/las_fields.h"
#include "format/pointio/las_source_header.h"
#include "format/pointio/laz.h"
#include "tests/support/las_file.h"
#include "tests/support/temporary_folder.h"
#include "tiny_attributes.h"

namespace pointrt {
namespace {

using test::LasParts;

struct ExportLas : testing::Test {
    test::TemporaryFolder folder;
    std::string pro = folder.file("a.pro"), las = folder.file("a.las"), laz = folder.file("a.laz");
    std::string bytes, records;
    LasFile file;
    std::vector<LasField> fields;
    std::vector<std::uint32_t> order; ///< order of the exported points, as input indices; empty: input order

    static int run(const std::string& arguments) {
        const int status = std::system((std::string(POINTRT_INFO) + " " + arguments).c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

    /// Writes the tiny scene with attributes and metadata, and reads its export.
    void exportWith(test::TinyScan& said, const std::string& metadata, const std::string& path) {
        test::Scene scene = test::tinyScene();
        scene.metadata = metadata;
        scene.order = order;
        ASSERT_EQ(said.write(scene, pro), PRO_OK);
        ASSERT_EQ(run(pro + " --force --export " + path), 0);
        const test::Bytes read = test::readBytes(path);
        bytes.assign(reinterpret_cast<const char*>(read.data()), read.size());
        file = openLas(bytes);
        fields = lasFields(file);
        records.assign(file.header.point_count * file.header.record_bytes, '\0');
        if (file.header.packed) {
            const LazLayout layout = lazLayout(file);
            ASSERT_EQ(layout.chunks.size(), 1u);
            LazStream(layout, bytes, layout.chunks[0]).read(records.data(), file.header.point_count);
        } else {
            records = bytes.substr(file.header.point_offset, records.size());
        }
    }

    /// The values of a field, as bytes.
    std::string valuesOf(const std::string& name) const {
        for (const LasField& field : fields) {
            if (field.name != name) continue;
            std::string values(file.header.point_count * fieldBytes(field), '\0');
            unpackField(field, records.data(), file.header.record_bytes, file.header.point_count, values.data());
            return values;
        }
        return "no " + name;
    }
};

template <typename Array>
std::string bytesOf(const Array& array) {
    return {reinterpret_cast<const char*>(array.data()), sizeof array};
}

TEST_F(ExportLas, AttributesRoundTripToTheBit) {
    for (const std::string& path : {las, laz}) {
        if (path == laz && !hasLaz()) continue;
        test::TinyScan said;
        exportWith(said, "{}", path);
        EXPECT_EQ(file.header.point_format, 3);
        EXPECT_EQ(file.header.version_minor, 4) << "extra bytes are described since 1.4";
        EXPECT_EQ(valuesOf("intensity"), bytesOf(said.intensity));
        EXPECT_EQ(valuesOf("classification"), bytesOf(said.classification));
        EXPECT_EQ(valuesOf("gps_time"), bytesOf(said.gps_time));
        EXPECT_EQ(valuesOf("rgb16"), bytesOf(said.rgb16));
        EXPECT_EQ(valuesOf("größe in einer Einheit, 31 By"), bytesOf(said.wide));
        EXPECT_EQ(valuesOf("return_number"), std::string(5, '\1'));
    }
}

TEST_F(ExportLas, PointsAreInInputOrder) {
    test::TinyScan said;
    order = {3, 0, 7, 1, 2};
    exportWith(said, "{}", las);
    const std::array<std::uint8_t, 5> wanted{2, 5, 2, 2, 6};
    EXPECT_EQ(valuesOf("classification"), bytesOf(wanted));
}

TEST_F(ExportLas, PositionsAreExactToPositionSteps) {
    test::TinyScan said;
    exportWith(said, "{}", las);
    const ProFile scan(pro);
    const LasHeader& header = file.header;
    const double step = scan.info().scale / PRO_POSITION_STEPS;
    for (std::size_t i = 0; i < 5; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::int32_t whole;
            std::memcpy(&whole, records.data() + i * header.record_bytes + 4 * axis, sizeof whole);
            const double wanted = scan.info().origin[axis] + scan.info().scale * scan.splat(i).position[axis];
            EXPECT_NEAR(header.offset[axis] + header.scale[axis] * whole, wanted, step / 2);
            EXPECT_LE(header.scale[axis], step);
        }
}

/// For a scan from a LAS file, scale, version, records and extra bytes are kept.
TEST_F(ExportLas, TheSourceHeaderIsKept) {
    LasParts parts;
    parts.minor = 3;
    parts.format = 5;
    parts.scale = 0.25;
    parts.points = {test::lasPoint(63 + 8, 0, 0, 0, 0)};
    parts.records = {test::lasRecord("LASF_Spec", 4, test::extraBytes(8, "wide", 8, 1.0)),
                     test::lasRecord("LASF_Projection", 2112, "PROJCS[UNIT[\"metre\",1]]"),
                     test::lasRecord("someone", 12, "kept")};
    const std::string source = parts.bytes();
    LasFile source_file = openLas(source);
    const std::string metadata = "{\"source_header\":" + lasSourceHeader(source_file, false) + "}";
    test::TinyScan said;
    const std::array<double, 5> wide{5, -4, 3, -2, 1e15};
    said.attributes.pop_back();
    said.add("wide", PRO_TYPE_F64, 1, wide.data());
    exportWith(said, metadata, las);
    EXPECT_EQ(file.header.version_minor, 3);
    EXPECT_EQ(file.header.point_format, 3) << "without its waveforms";
    EXPECT_EQ(file.header.scale[0], 0.25);
    ASSERT_NE(findVlr(file, "someone", 12), nullptr);
    EXPECT_EQ(findVlr(file, "someone", 12)->data, "kept");
    EXPECT_EQ(lasCrs(file).kind, LasCrs::Kind::kProjected);
    EXPECT_EQ(fields.back().raw_type, unsigned{PRO_TYPE_I64}) << "the scaled numbers are stored as they were";
    EXPECT_EQ(valuesOf("wide"), bytesOf(wide));
}

/// Ten undescribed bytes become three attributes of a scan, which an export joins again.
TEST_F(ExportLas, UndescribedBytesAreJoinedAgain) {
    LasParts parts;
    parts.points = {test::lasPoint(20, 0, 0, 0, 0) + "0123456789"};
    parts.records = {test::lasRecord("LASF_Spec", 4, test::extraBytes(0, "bare", 10))};
    const std::string source = parts.bytes();
    LasFile source_file = openLas(source);
    test::TinyScan said;
    said.attributes.clear();
    const std::array<std::uint8_t, 20> four{1, 2, 3, 4}, next{5, 6, 7, 8};
    const std::array<std::uint8_t, 10> last{9, 10};
    said.add("bare", PRO_TYPE_U8, 4, four.data());
    said.add("bare_2", PRO_TYPE_U8, 4, next.data());
    said.add("bare_3", PRO_TYPE_U8, 2, last.data());
    exportWith(said, "{\"source_header\":" + lasSourceHeader(source_file, false) + "}", las);
    const LasVlr* const described = findVlr(file, kLasSpecUser, kExtraBytesRecord);
    ASSERT_NE(described, nullptr);
    EXPECT_EQ(described->data, test::extraBytes(0, "bare", 10));
    EXPECT_EQ(records.substr(lasRecordBytes(file.header.point_format), 10), "\1\2\3\4\5\6\7\x8\t\n");
}

TEST_F(ExportLas, AttributesThatDoNotFitBecomeExtraBytes) {
    test::TinyScan said;
    const std::array<float, 5> intensity{0.5f, 1, 2, 3, 4};
    const std::array<std::uint8_t, 5> number{1, 2, 3, 4, 9};
    const std::array<std::uint16_t, 20> four{1, 2, 3, 4, 5};
    said.attributes.erase(said.attributes.begin());
    said.add("intensity", PRO_TYPE_F32, 1, intensity.data());
    said.add("return_number", PRO_TYPE_U8, 1, number.data());
    said.add("four", PRO_TYPE_U16, 4, four.data());
    exportWith(said, "{}", las);
    EXPECT_EQ(file.header.point_format, 7) << "the ninth return needs a new format";
    EXPECT_EQ(valuesOf("return_number"), bytesOf(number));
    EXPECT_EQ(valuesOf("intensity_2"), bytesOf(intensity));
    const std::array<std::uint16_t, 5> scaled{0, 9362, 28086, 46811, 65535}; // two points 65535 steps apart
    EXPECT_EQ(valuesOf("intensity"), bytesOf(scaled));
    EXPECT_EQ(valuesOf("four") + valuesOf("four_2"), [&] {
        std::string halves[2];
        const std::string all = bytesOf(four);
        for (std::size_t i = 0; i < 5; ++i)
            for (std::size_t half : {0u, 1u}) halves[half] += all.substr(8 * i + 4 * half, 4);
        return halves[0] + halves[1];
    }());
}

TEST_F(ExportLas, IntegersOfAnyTypeFitByRange) {
    test::TinyScan said;
    const std::array<float, 5> intensity{0, 1, 2, 3, 65535};
    said.attributes.clear();
    said.add("intensity", PRO_TYPE_F32, 1, intensity.data());
    exportWith(said, R"({"world":{"crs":"EPSG:32610"}})", las);
    const std::array<std::uint16_t, 5> wanted{0, 1, 2, 3, 65535};
    EXPECT_EQ(valuesOf("intensity"), bytesOf(wanted));
    EXPECT_EQ(file.header.record_bytes, lasRecordBytes(file.header.point_format));
    EXPECT_EQ(lasCrs(file).name, "EPSG:32610");
}

} // namespace
} // namespace pointrt
